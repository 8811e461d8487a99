// What the table of keys tells: a list for the terminal, a reference in Markdown, and a JSON schema for editors.
#pragma once

#include <stillpoint/catalogue.hpp>

#include <string>

namespace stillpoint {

std::string key_list(const Catalogue& catalogue);
/// Ends the head, written by hand, of problems/README.md.
std::string key_reference(const Catalogue& catalogue);
std::string key_schema(const Catalogue& catalogue);

}  // namespace stillpoint
