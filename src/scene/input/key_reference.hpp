// The table of keys in other forms: a list for the terminal, a reference in Markdown, and a JSON schema for editors.
#pragma once

#include <stillpoint/catalogue.hpp>

#include <string>

namespace stillpoint {

std::string key_list(const Catalogue& catalogue);
/// The second half of problems/README.md, after a head that is written by hand.
std::string key_reference(const Catalogue& catalogue);
std::string key_schema(const Catalogue& catalogue);

}  // namespace stillpoint
