#include "files.hpp"

#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace stillpoint::test {

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

std::map<std::string, std::vector<double>> columns_of(const std::filesystem::path& csv) {
  const std::vector<std::string> all = lines(csv);
  std::vector<std::string> names;
  std::string cell;
  for (std::istringstream header(all.at(0)); std::getline(header, cell, ',');) names.push_back(cell);
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t k = 1; k < all.size(); ++k) {
    std::istringstream row(all[k]);
    for (const std::string& name : names) {
      cell.clear();
      std::getline(row, cell, ',');
      columns[name].push_back(cell.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(cell));
    }
  }
  return columns;
}

Json parsed(const std::string& json) { return Json::parse(json); }

}  // namespace stillpoint::test
