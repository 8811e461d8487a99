#include "files.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace stillpoint::test {

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

Json parsed(const std::string& json) { return Json::parse(json); }

}  // namespace stillpoint::test
