// Users' own words inside messages.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace stillpoint {

/// 'word' for a message: control characters are escaped, so that no scene can drive a terminal, and the end of a very
/// long word is left out.
inline std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 80;
  const bool cut = word.size() > longest;
  if (cut) {
    word = word.substr(0, longest);
    // Never in the middle of a UTF-8 character.
    while (!word.empty() && (static_cast<unsigned char>(word.back()) & 0xC0) == 0x80) word.remove_suffix(1);
    if (!word.empty() && static_cast<unsigned char>(word.back()) >= 0xC0) word.remove_suffix(1);
  }
  std::string result = "'";
  for (const char letter : word) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7f) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\x%02x", static_cast<unsigned>(code));
      result += escape;
    } else {
      result += letter;
    }
  }
  return result + (cut ? "…'" : "'");
}

}  // namespace stillpoint
