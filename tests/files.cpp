#include "files.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace stillpoint::test {

std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  if (!(text << std::ifstream(file, std::ios::binary).rdbuf()))
    throw std::runtime_error(file.string() + ": no contents");
  return text.str();
}

Json parsed(const std::string& json) { return Json::parse(json); }

}  // namespace stillpoint::test
