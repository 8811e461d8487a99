// Checkpoints that are not whole, of something else, or spoilt: none is gone on from without a word.
#include <cmath>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "files.hpp"
#include "output/checkpoint_file.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::contents;
using stillpoint::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("a checkpoint that is not whole is refused with what is wrong, and so is a foreign one") {
  const Scene scene = scenes::load("inclusion", {"grid.cells=[8, 8]"});
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  Simulation(scene).save(file);
  const std::string whole = contents(file);
  const auto refusal = [&](const std::string& bytes) {
    folder.write("checkpoint.h5", bytes);
    try {
      load_scene_of(file);
    } catch (const StateError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK(refusal(whole) == "taken");
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{600}})
    CHECK_THAT(refusal(whole.substr(0, size)), Catch::Contains("checkpoint.h5: is cut short: "));
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{511}})
    CHECK_THAT(refusal(whole.substr(0, size)), Catch::Contains("is no checkpoint of this format"));
  for (std::size_t at = 512; at < whole.size(); at += whole.size() / 97) {
    std::string altered = whole;
    altered[at] ^= 1;
    CHECK_THAT(refusal(altered), Catch::Contains("was altered"));
  }
  CHECK_THAT(refusal(whole + "x"), Catch::Contains("was altered"));
  CHECK_THAT(refusal("t,steps\n0,0\n" + std::string(600, '0')), Catch::Contains("is no checkpoint of this format"));
  CHECK_THROWS_WITH(load_scene_of(folder.path() / "none.h5"), Catch::Contains("none.h5: cannot be read"));
}

TEST_CASE("a checkpoint of another scene, other settings, another body or another version is refused") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  Simulation(scenes::load("inclusion", {"grid.cells=[8, 8]"})).save(file);
  const auto go_on = [&](const Scene& scene) { Simulation(scene, {.resume = file}); };
  CHECK_THROWS_WITH(go_on(scenes::bar()), Catch::Contains("it is of another scene than"));
  CHECK_THROWS_WITH(go_on(scenes::load("inclusion", {"grid.cells=[8, 9]"})),
                    Catch::Contains("it is of the scene with --set grid.cells=[8, 8], expected one with --set"));
  Scene moved = scenes::load("inclusion", {"grid.cells=[8, 8]"});
  moved.bodies.front().points_per_cell = {3, 3};
  CHECK_THROWS_WITH(go_on(moved), Catch::Contains("another body"));

  SavedState state = read_checkpoint(file);
  state["origin/version"] = "0.0.1";
  write_checkpoint(file, state);
  CHECK_THROWS_WITH(load_scene_of(file), Catch::Contains("it is of version 0.0.1, expected "));
}

TEST_CASE("a checkpoint that lacks a value, or has one of another kind or size, is refused with its name") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  const Scene scene = scenes::load("inclusion", {"grid.cells=[8, 8]"});
  Simulation(scene).save(file);
  const SavedState whole = read_checkpoint(file);
  for (const auto& [name, value] : whole) {
    CAPTURE(name);
    SavedState spoilt = whole;
    spoilt.erase(name);
    write_checkpoint(file, spoilt);
    CHECK_THROWS_WITH(Simulation(scene, {.resume = file}), Catch::Contains("it has no '" + name + "'"));
    spoilt[name] = std::holds_alternative<std::string>(value) ? SavedValue(std::vector<double>()) : SavedValue("?");
    write_checkpoint(file, spoilt);
    CHECK_THROWS_WITH(Simulation(scene, {.resume = file}), Catch::Contains("'" + name + "' is of another kind"));
  }
}

TEST_CASE("a checkpoint whose table is not that of its values is refused, whatever it asks for") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  const auto read = [&](const std::string& rest) {  // under a head that goes with it
    std::string head = fmt::format("Stillpoint checkpoint, format 2\nCRC-32 {:x} of the {} bytes after these 512\n",
                                   checksum(0, rest.data(), rest.size()), rest.size());
    head.resize(512, '\n');
    folder.write("checkpoint.h5", head + rest);
    return read_checkpoint(file);
  };
  const SavedState whole = read("text 539 2 a b\ntext 0 0 c\n\nhi!");
  REQUIRE(whole.size() == 2);
  CHECK(std::get<std::string>(whole.at("a b")) == "hi");
  CHECK(std::get<std::string>(whole.at("c")).empty());
  for (const char* table :
       {"text 520 9 a\n\n", "real 512 1000000000000 a\n\n", "real 512 2305843009213693953 a\n\n",
        "whole 512 18446744073709551617 a\n\n", "text 18446744073709551615 1 a\n\n", "text -1 1 a\n\n", "text 512 1",
        "text 512 1 a\ntext 512 1 a\n\n", "word 512 1 a\n\n", "real 512\n\n", "text 512 300 a\ntext 512 300 b\n\n"}) {
    CAPTURE(table);
    CHECK_THROWS_WITH(read(table), Catch::Contains("checkpoint.h5: cannot be read: its table is not that of"));
  }
}

TEST_CASE("a state with spoilt values is refused, or gone on from as far as that goes, and crashes nothing") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  // Points that change cells beside a wall that they rub against.
  const Scene scene = scenes::load("slope", {"grid.cells=[8, 4]", "stop.steps=60", "phase.max_motion=0.001"});
  Simulation first(scene);
  while (first.steps() < 40) first.step();
  first.save(file);
  const SavedState whole = read_checkpoint(file);
  std::mt19937 random(1);
  const std::vector<double> hard = {0, -1, 1, 2, 1e300, -1e300, 1e9, -1e9, std::nan(""), HUGE_VAL, 255, 2147483648.0};
  int refused = 0;
  for (int k = 0; k < 400; ++k) {
    SavedState spoilt = whole;
    const auto entry = std::next(spoilt.begin(), static_cast<std::ptrdiff_t>(random() % spoilt.size()));
    const double value = hard[random() % hard.size()];
    const std::uint32_t way = random() % 4;
    std::visit(
        [&]<class Values>(Values& values) {
          using Number = typename Values::value_type;
          constexpr bool real = std::is_same_v<Number, double>;
          const auto number = [&]() -> Number {
            if constexpr (real) return value;
            return static_cast<Number>(std::abs(value) < 1e18 ? static_cast<std::int64_t>(value) : -7);
          }();
          if (way == 0) values.resize(values.size() + random() % 3);
          if (way == 1) values.resize(values.size() / 2);
          if (way == 2 && !values.empty()) values[random() % values.size()] = number;
          if (way == 3) std::ranges::fill(values, number);
        },
        entry->second);
    CAPTURE(k, entry->first, value, way);
    write_checkpoint(file, spoilt);
    try {
      Simulation second(scene, {.resume = file});
      for (int step = 0; step < 10; ++step) second.step();
      CHECK(second.steps() >= 0);
    } catch (const StateError&) {
      ++refused;
    } catch (const std::exception& error) {  // which the command reports
      CHECK(!std::string(error.what()).empty());
    }
  }
  CHECK(refused > 50);
}
