#include "files.hpp"

#include <fstream>
#include <iterator>
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

Json parsed(const std::string& json) { return Json::parse(json); }

}  // namespace stillpoint::test
