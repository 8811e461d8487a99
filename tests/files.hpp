// What a test finds in a file, read and parsed in one place.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/json.hpp"

namespace stillpoint::test {

/// All bytes of a file; throws std::runtime_error if it cannot be read.
std::string contents(const std::filesystem::path& file);
std::vector<std::string> lines_of(const std::string& text);
inline std::vector<std::string> lines(const std::filesystem::path& file) { return lines_of(contents(file)); }
/// The columns of a table of numbers, by the names in its first line; an empty entry counts as NaN.
std::map<std::string, std::vector<double>> columns_of(const std::filesystem::path& csv);
Json parsed(const std::string& json);
inline Json json_of(const std::filesystem::path& file) { return parsed(contents(file)); }

}  // namespace stillpoint::test
