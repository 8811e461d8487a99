#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "output/report/run_report.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t most_cells = 40'000;  // about eight bytes each

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::size_t from = 0;
  for (std::size_t comma; (comma = line.find(',', from)) != std::string::npos; from = comma + 1)
    words.push_back(line.substr(from, comma - from));
  words.push_back(line.substr(from));
  return words;
}

using Row = std::vector<double>;

Row row_of(const std::string& line, std::size_t columns) {
  Row row;
  row.reserve(columns);
  const char* at = line.c_str();
  while (row.size() < columns) {
    char* end = nullptr;
    row.push_back(std::strtod(at, &end));
    if (*end != ',') break;
    at = end + 1;
  }
  row.resize(columns, 0.0);
  return row;
}

// Writes the rows of extreme values among some consecutive rows.
void write_extremes(const std::vector<Row>& rows, std::string& text) {
  std::set<std::size_t> kept;
  for (std::size_t k = 0; !rows.empty() && k < rows.front().size(); ++k) {
    const auto [least, most] = std::ranges::minmax_element(rows, {}, [k](const Row& row) { return row[k]; });
    kept.insert(static_cast<std::size_t>(least - rows.begin()));
    kept.insert(static_cast<std::size_t>(most - rows.begin()));
  }
  for (const std::size_t number : kept) {
    for (const double value : rows[number]) fmt::format_to(std::back_inserter(text), "{:.8g},", value);
    text.back() = '\n';
  }
}

}  // namespace

Json history_excerpt(const std::filesystem::path& history_csv) {
  std::ifstream file(history_csv);
  std::string line;
  if (!std::getline(file, line)) return nullptr;
  const std::vector<std::string> columns = words_of(line);
  const std::streampos begin = file.tellg();
  std::size_t all = 0;
  while (std::getline(file, line)) ++all;
  file.clear();
  file.seekg(begin);

  const bool has_room = all * columns.size() <= most_cells;
  const std::size_t groups = std::max<std::size_t>(1, most_cells / (2 * columns.size() * columns.size()));
  const std::size_t at_once = has_room ? 1 : (all + groups - 1) / groups;
  std::string text;
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    rows.push_back(row_of(line, columns.size()));
    if (rows.size() < at_once) continue;
    write_extremes(rows, text);
    rows.clear();
  }
  write_extremes(rows, text);
  return {{"columns", columns}, {"rows", text}, {"of", all}};
}

}  // namespace stillpoint
