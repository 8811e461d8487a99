// Text quoted as a field of a CSV file.
#pragma once

#include <string>

namespace stillpoint {

inline std::string quoted(const std::string& text) {
  std::string doubled;
  for (const char c : text) doubled += c == '"' ? std::string("\"\"") : std::string(1, c);
  return '"' + doubled + '"';
}

}  // namespace stillpoint
