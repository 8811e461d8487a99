// Permanent storage of texts for rows that only refer to their words.
#pragma once

#include <string>
#include <string_view>

namespace stillpoint {

/// A copy of the text that stays to the end of the process.
std::string_view kept_for_good(const std::string& text);

}  // namespace stillpoint
