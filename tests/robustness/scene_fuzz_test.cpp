// Whatever bytes a scene holds, loading it gives a scene or a SceneError with a problem.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "broken_scene.hpp"
#include "files.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::contents;
using stillpoint::testing::broken;
using stillpoint::testing::kGoodPlane;
using stillpoint::testing::TemporaryFolder;

namespace {

using Random = std::mt19937;  // its numbers are the same on every machine, unlike the distributions'

std::size_t below(std::size_t n, Random& random) { return random() % n; }

/// A few bytes changed, inserted or removed.
std::string with_bytes_changed(std::string text, Random& random) {
  static const std::string likely = "\"'[]{}=.,#\n\\-+*/^()?:<>&|e0123456789xtP \t\xff\xc4";
  const std::size_t changes = 1 + below(4, random);
  for (std::size_t k = 0; k < changes; ++k) {
    const std::size_t at = below(text.size(), random);
    const char byte = below(4, random) == 0 ? static_cast<char>(random() & 0xff) : likely[below(likely.size(), random)];
    switch (below(3, random)) {
      case 0:
        text[at] = byte;
        break;
      case 1:
        text.insert(at, 1, byte);
        break;
      default:
        text.erase(at, 1 + below(8, random));
    }
  }
  return text;
}

/// Lines removed, doubled or swapped, and values replaced by hard ones.
std::string with_lines_changed(const std::string& text, Random& random) {
  static const std::vector<std::string> values = {"nan",
                                                  "-inf",
                                                  "1e308",
                                                  "-1e308",
                                                  "1e-320",
                                                  "0",
                                                  "-1",
                                                  "9223372036854775807",
                                                  "-9223372036854775808",
                                                  "true",
                                                  "[]",
                                                  "[[]]",
                                                  "{}",
                                                  "\"\"",
                                                  "\"1/0\"",
                                                  "\"x\"",
                                                  "\"t\"",
                                                  "\"sin(\"",
                                                  "{a=1}",
                                                  "[1,2,3]",
                                                  "\"pi\"",
                                                  "07:32:00",
                                                  "[nan]",
                                                  "\"é\"",
                                                  "\"1,2\"",
                                                  "\"x=1\"",
                                                  "[1, 2]",
                                                  "[[0, 0], [1, 0], [0, 1]]",
                                                  "\"none\"",
                                                  "\"/dev/zero\"",
                                                  "\"critical\""};
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  const std::size_t changes = 1 + below(3, random);
  for (std::size_t k = 0; k < changes && lines.size() > 1; ++k) {
    const std::size_t at = below(lines.size(), random);
    switch (below(4, random)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size(), random)), std::string(lines[at]));
        break;
      case 2:
        std::swap(lines[at], lines[below(lines.size(), random)]);
        break;
      default:
        if (const auto equals = lines[at].find('='); equals != std::string::npos)
          lines[at] = lines[at].substr(0, equals + 1) + " " + values[below(values.size(), random)];
    }
  }
  std::string result;
  for (const std::string& line : lines) result += line + "\n";
  return result;
}

/// True if loading ends as it may: with a scene, or with at least one problem.
bool ends_well(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
  try {
    load_scene(file, overrides);
    return true;
  } catch (const SceneError& error) {
    return !error.problems().empty() &&
           std::all_of(error.problems().begin(), error.problems().end(),
                       [](const Problem& problem) { return !problem.message.empty() && !problem.where.file.empty(); });
  }  // any other exception fails the test
}

}  // namespace

TEST_CASE("3000 mutations of the bar either load or are refused with a reason") {
  const TemporaryFolder folder;
  const std::string bar = contents(std::filesystem::path(STILLPOINT_PROBLEMS) / "bar.toml");
  REQUIRE(bar.size() > 500);
  Random random(20111);
  for (int k = 0; k < 3000; ++k) {
    const std::string text = k % 2 == 0 ? with_bytes_changed(bar, random) : with_lines_changed(bar, random);
    INFO("mutation " << k << ":\n" << text);
    REQUIRE(ends_well(folder.write("bar.toml", text)));
  }
}

TEST_CASE("3000 mutations of a plane scene either load or are refused with a reason") {
  const TemporaryFolder folder;
  folder.write("points.csv", "x,y,volume\n1,1,1\n");
  const std::string bodies = broken(
      "[body_force]",
      "[[traction]]\nface = \"top\"\npressure = 1\n[[support]]\nat = [8, 4]\ncomponent = 1\n[body_force]", kGoodPlane);
  const std::vector<std::string> scenes = {
      bodies, broken("max = [8, 3]", "polygon = [[0, 0], [8, 0], [8, 3], [0, 2]]", kGoodPlane),
      broken("max = [8, 3]\nmaterial = \"sand\"\npoints_per_cell = 4", "material = \"sand\"\nfile = \"points.csv\"",
             kGoodPlane)};
  Random random(20113);
  for (std::size_t k = 0; k < 3000; ++k) {
    const std::string& scene = scenes[k % 3];
    const std::string text = k % 2 == 0 ? with_bytes_changed(scene, random) : with_lines_changed(scene, random);
    INFO("mutation " << k << ":\n" << text);
    REQUIRE(ends_well(folder.write("plane.toml", text)));
  }
}

TEST_CASE("a thousand random overrides of the bar either load or are refused with a reason") {
  static const std::vector<std::string> pieces = {
      "damping", "grid", ".", "c",  "=",     "cells", "pi", "/",   "10", "[",    "]", "{",         "}",
      "\"",      "'",    "#", "\n", "probe", "-",     "e",  "nan", " ",  "\x01", "é", "constants", "P0"};
  Random random(20112);
  for (int k = 0; k < 1000; ++k) {
    std::string text = below(2, random) == 0 ? "constants.P0=" : "";
    for (std::size_t n = below(8, random); n > 0; --n) text += pieces[below(pieces.size(), random)];
    INFO("override " << k << ": " << text);
    REQUIRE(ends_well(std::filesystem::path(STILLPOINT_PROBLEMS) / "bar.toml", {text}));
  }
}
