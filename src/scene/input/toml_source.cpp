#include "scene/input/toml_source.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"

namespace stillpoint {
namespace {

constexpr std::string_view kOverride = "--set ";

/// toml++ destroys a table by recursion, so that a key like a.a.a.… with a million parts would overrun the stack.
/// Returns the offset of a dot that no scene needs, if there is one.
std::optional<std::size_t> too_deep_a_key(std::string_view text) {
  constexpr int most = 200;
  int dots = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (std::string_view("\n,=[]{}#").find(text[k]) != std::string_view::npos) dots = 0;
    if (text[k] == '.' && (k == 0 || text[k - 1] != '.') && ++dots > most) return k;
  }
  return std::nullopt;
}

/// True if a text may hold more values than fit into a GB or two once they are parsed: each has one of these characters
/// before it.
bool holds_too_many_values(std::string_view text) {
  constexpr std::ptrdiff_t most = 4'000'000;
  return std::ranges::count_if(text, [](char c) { return c == '[' || c == '{' || c == '.' || c == '=' || c == ','; }) >
         most;
}

/// A TOML string that holds text.
std::string quoted(const std::string& text) {
  std::ostringstream result;
  result << toml::value<std::string>(text);
  return result.str();
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The fault of a dotted key; empty if there is none.
std::string fault_of_key(std::string_view key) {
  if (key.empty()) return "the key before '=' is missing";
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const std::string_view part = key.substr(begin, end - begin);
    if (part.empty()) return fmt::format("the key {} has an empty part", in_quotes(key));
    const bool bare = std::all_of(part.begin(), part.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    if (!bare) return fmt::format("{} is not a key that --set can change", in_quotes(part));
    begin = end + 1;
  }
  return {};
}

/// Moves all of over into base; nodes keep the locations where they were written.
void merge(toml::table& base, toml::table&& over, const std::string& prefix, const Location& where,
           std::vector<Mistake>& problems) {
  for (auto&& [key, node] : over) {
    toml::node* const below = base.get(key.str());
    toml::table* const table = node.as_table();
    const std::string path = prefix + std::string(key.str());
    if (below && below->is_table() && table) {
      merge(*below->as_table(), std::move(*table), path + ".", where, problems);
    } else if (below && below->is_array() && table) {
      problems.push_back(
          {where, fmt::format("{}: is an array; --set can replace it, or reach into it with an index", path)});
    } else {
      // An insertion that replaces keeps the old key with its location, so the old entry goes first.
      base.erase(key.str());
      std::move(node).visit(
          [&, &name = key](auto&& value) { base.insert_or_assign(name, std::forward<decltype(value)>(value)); });
    }
  }
}

/// The table that the indexed parts of a key lead to ("probe[0]." of probe[0].name), and what of the key is left.
struct Target {
  toml::table* table;
  std::string_view rest;
  std::string fault;  // empty if there is such a table
};

Target follow_indices(toml::table& root, std::string_view key) {
  Target target{&root, key, {}};
  for (auto open = key.find('['); open != std::string_view::npos; open = target.rest.find('[')) {
    const auto close = target.rest.find(']', open);
    const std::string_view name = target.rest.substr(0, open);
    std::size_t index = 0;
    const char* const digits = target.rest.data() + open + 1;
    const bool closed = close != std::string_view::npos && close > open + 1 && close + 2 < target.rest.size() &&
                        target.rest[close + 1] == '.';
    const auto [end, error] =
        closed ? std::from_chars(digits, target.rest.data() + close, index) : std::from_chars_result{};
    if (!closed || error != std::errc() || end != target.rest.data() + close) {
      target.fault = fmt::format("{} is not a key; expected, for example, probe[0].name", in_quotes(key));
      return target;
    }
    const toml::array* const array = target.table->get_as<toml::array>(name);
    const std::size_t count = array ? array->size() : 0;
    if (index >= count || !array->get(index)->is_table()) {
      target.fault =
          fmt::format("there is no {}[{}] in the scene, which has {} of them", in_quotes(name), index, count);
      return target;
    }
    target.table = target.table->get_as<toml::array>(name)->get_as<toml::table>(index);
    target.rest = target.rest.substr(close + 2);
  }
  return target;
}

/// path is that of the node, and again what it was when this is done.
void collect(const toml::node& node, std::string& path, std::vector<std::pair<std::string, Location>>& found) {
  found.emplace_back(path, location_of(node.source()));
  const std::size_t length = path.size();
  if (const auto* table = node.as_table()) {
    for (auto&& [key, value] : *table) {
      path += '.';
      path += key.str();
      collect(value, path, found);
      path.resize(length);
    }
  } else if (const auto* array = node.as_array()) {
    for (std::size_t k = 0; k < array->size(); ++k) {
      fmt::format_to(std::back_inserter(path), "[{}]", k);
      collect(*array->get(k), path, found);
      path.resize(length);
    }
  }
}

}  // namespace

Location location_of(const toml::source_region& region) {
  if (!region.path) return {};
  const std::string& name = *region.path;
  if (name.starts_with(kOverride)) return {name, 0, 0};
  return {name, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

std::optional<std::string> read_file(const std::filesystem::path& file, std::vector<Mistake>& problems) {
  constexpr std::size_t largest = std::size_t{16} << 20;  // bytes; also ends the reading of /dev/zero
  const auto refuse = [&](const std::string& why) -> std::optional<std::string> {
    problems.push_back({{file.string(), 0, 0}, why});
    return std::nullopt;
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) return refuse("there is no such file");
  if (std::filesystem::is_directory(status)) return refuse("is a directory, not a scene file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return refuse("cannot be opened for reading");
  std::string text;
  std::vector<char> block(std::size_t{1} << 16);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest) return refuse("is larger than 16 MiB: not a scene file");
  }
  if (stream.bad()) return refuse("cannot be read");
  return text;
}

std::optional<toml::table> parse_toml(std::string_view text, const std::string& name, std::vector<Mistake>& problems) {
  if (holds_too_many_values(text)) {
    problems.push_back({{name, 1, 1}, "holds more than 4 million values: not a scene"});
    return std::nullopt;
  }
  if (const auto dot = too_deep_a_key(text)) {
    const auto line_start = text.substr(0, *dot).rfind('\n') + 1;  // npos + 1 = 0: the first line
    const int line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(*dot), '\n'));
    problems.push_back({{name, line, static_cast<int>(*dot - line_start) + 1}, "a key with too many dots"});
    return std::nullopt;
  }
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    Location where = location_of(error.source());
    if (where.file.empty()) where.file = name;
    problems.push_back({where, fmt::format("not valid TOML: {}", error.description())});
    return std::nullopt;
  }
}

void apply_override(toml::table& table, const std::string& text, std::vector<Mistake>& problems) {
  // The name holds the literal text; a message is one line of printable characters.
  const std::string shown = in_quotes(text);
  const std::string name = std::string(kOverride) + shown.substr(1, shown.size() - 2);
  const Location where{name, 0, 0};
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    problems.push_back({where, "expected key=value, for example --set damping.c=0.5"});
    return;
  }
  const Target target = follow_indices(table, trimmed(std::string_view(text).substr(0, equals)));
  const std::string_view key = target.rest;
  if (const std::string fault = target.fault.empty() ? fault_of_key(key) : target.fault; !fault.empty()) {
    problems.push_back({where, fault});
    return;
  }
  // A value that is not one line of TOML is a string: pi/10 needs no quotes.
  const std::string value(trimmed(std::string_view(text).substr(equals + 1)));
  std::vector<Mistake> not_toml;
  std::optional<toml::table> over;
  if (value.find_first_of("\n\r") == std::string::npos)
    over = parse_toml(fmt::format("{} = {}", key, value), name, not_toml);
  if (!over) over = parse_toml(fmt::format("{} = {}", key, quoted(value)), name, problems);
  if (over) merge(*target.table, std::move(*over), "", where, problems);
}

std::map<std::string, Location> locations_of(const toml::table& table) {
  std::vector<std::pair<std::string, Location>> found;
  for (auto&& [key, value] : table) {
    std::string path(key.str());
    collect(value, path, found);
  }
  // A map of what is sorted is made in a time that is proportional to its size.
  std::ranges::sort(found, {}, &std::pair<std::string, Location>::first);
  return {std::make_move_iterator(found.begin()), std::make_move_iterator(found.end())};
}

}  // namespace stillpoint
