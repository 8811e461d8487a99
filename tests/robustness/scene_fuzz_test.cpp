// Whatever bytes a scene holds, loading it gives a scene, or a SceneError whose problems say what is wrong and where.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "broken_scene.hpp"
#include "files.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::broken;
using stillpoint::test::contents;
using stillpoint::test::kGoodPlane;
using stillpoint::test::kGoodScene;
using stillpoint::test::lines_of;
using stillpoint::test::TemporaryFolder;

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

/// Lines removed, doubled or swapped.
std::string with_lines_changed(const std::string& text, Random& random) {
  std::vector<std::string> lines = lines_of(text);
  for (std::size_t changes = 1 + below(3, random); changes > 0 && lines.size() > 1; --changes) {
    const std::size_t at = below(lines.size(), random);
    switch (below(3, random)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(below(lines.size(), random)), std::string(lines[at]));
        break;
      default:
        std::swap(lines[at], lines[below(lines.size(), random)]);
    }
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

/// Of some lines "key = value" either side is replaced by replacement(the other lines), which may be one of theirs.
template <class Replacement>
std::string with_sides_changed(const std::string& text, bool values, Random& random, const Replacement& replacement) {
  std::vector<std::string> lines = lines_of(text);
  for (std::size_t changes = 1 + below(3, random); changes > 0; --changes) {
    std::string& line = lines[below(lines.size(), random)];
    const auto equals = line.find(" = ");
    if (equals == std::string::npos) continue;
    line = values ? line.substr(0, equals) + " = " + replacement(lines) : replacement(lines) + line.substr(equals);
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

/// Values replaced by hard ones, or by those of other keys.
std::string with_values_changed(const std::string& text, Random& random) {
  static const std::vector<std::string> hard = {"nan",
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
  return with_sides_changed(text, true, random, [&](const std::vector<std::string>& lines) {
    const std::string& other = lines[below(lines.size(), random)];
    const auto equals = other.find(" = ");
    return below(3, random) > 0 || equals == std::string::npos ? hard[below(hard.size(), random)]
                                                               : other.substr(equals + 3);
  });
}

/// Keys replaced by misspelt or hard ones, or by those of other tables.
std::string with_keys_changed(const std::string& text, Random& random) {
  static const std::vector<std::string> hard = {"\"\"", "\"a b\"",      "\"\\n\"", "a.b.c", "\"\\u0000\"",
                                                "-1",   "grid.min.min", "'a\tb'",  "min.x", "\"é\""};
  return with_sides_changed(text, false, random, [&](const std::vector<std::string>& lines) {
    if (below(4, random) == 0) return hard[below(hard.size(), random)];
    std::string key = lines[below(lines.size(), random)];
    key = key.substr(0, key.find(" = "));
    if (!key.empty() && below(2, random) == 0) key.erase(below(key.size(), random), 1);
    return key;
  });
}

std::string mutation(const std::string& text, std::size_t kind, Random& random) {
  switch (kind) {
    case 0:
      return with_bytes_changed(text, random);
    case 1:
      return with_lines_changed(text, random);
    case 2:
      return with_values_changed(text, random);
    default:
      return with_keys_changed(text, random);
  }
}

/// One line of printable characters that says at which line and column of which file what is wrong.
bool is_clear(const Mistake& problem) {
  const auto printable = [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; };
  const auto& [where, message, key] = problem;
  const bool overridden = where.file.starts_with("--set ");
  return !message.empty() && std::ranges::all_of(message, printable) && !where.file.empty() &&
         (overridden || (where.line > 0 && where.column > 0));
}

/// True if loading ends as it may: with a scene, or with clear problems.
bool ends_well(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
  try {
    load_scene(file, overrides);
    return true;
  } catch (const SceneError& error) {
    return !error.problems().empty() && std::ranges::all_of(error.problems(), is_clear);
  }  // any other exception fails the test
}

/// Scenes with everything that a scene can hold.
std::vector<std::string> scenes_to_break() {
  const std::string with_loads = broken(
      "[body_force]",
      "[[traction]]\nface = \"top\"\npressure = 1\n[[support]]\nat = [8, 4]\ncomponent = 1\n[body_force]", kGoodPlane);
  std::vector<std::string> scenes = {kGoodScene, with_loads,
                                     broken("max = [8, 3]", "polygon = [[0, 0], [8, 0], [8, 3], [0, 2]]", kGoodPlane),
                                     broken("max = [8, 3]\nmaterial = \"sand\"\npoints_per_cell = 4",
                                            "material = \"sand\"\nfile = \"points.csv\"", kGoodPlane)};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(STILLPOINT_PROBLEMS))
    if (entry.path().extension() == ".toml" && entry.path().stem() != "map" && entry.path().stem() != "ladder")
      scenes.push_back(contents(entry.path()));
  for (const char* const rigid : {"rigid_plane.toml", "rigid_space.toml"})
    scenes.push_back(contents(std::string(STILLPOINT_TEST_DATA) + "/fuzz/corpus/scene/" + rigid));
  std::sort(scenes.begin(), scenes.end());  // in one order on every machine
  return scenes;
}

}  // namespace

TEST_CASE("5000 mutations of scenes either load or are refused with what is wrong and where") {
  const TemporaryFolder folder;
  folder.write("points.csv", "x,y,volume\n1,1,1\n");
  const std::vector<std::string> scenes = scenes_to_break();
  REQUIRE(scenes.size() > 40);
  Random random(20111);
  for (std::size_t k = 0; k < 5000; ++k) {
    const std::string text = mutation(scenes[below(scenes.size(), random)], k % 4, random);
    INFO("mutation " << k << ":\n" << text);
    REQUIRE(ends_well(folder.write("scene.toml", text)));
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
