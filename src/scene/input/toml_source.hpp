// A TOML file and the overrides laid over it, as one table in which every node knows where it was written.
#pragma once

#include <stillpoint/problem.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace stillpoint {

/// The location of a node or key: a location in the file, or the override that wrote it; empty in a text without a
/// name.
Location location_of(const toml::source_region& region);

/// The text of a file. Empty, with a problem, if there is none to be had.
std::optional<std::string> read_file(const std::filesystem::path& file, std::vector<Mistake>& problems);

/// Parses text, whose locations are called name, or are empty if the name is. Empty, with a problem, on a syntax error.
std::optional<toml::table> parse_toml(std::string_view text, const std::string& name, std::vector<Mistake>& problems);

/// Lays "dotted.key=value" over a table, making the tables on the way.
void apply_override(toml::table& table, const std::string& text, std::vector<Mistake>& problems);

/// Every key of a table, dotted ("support[0].at"), with the location of its value.
std::map<std::string, Location> locations_of(const toml::table& table);

}  // namespace stillpoint
