// A scene that is too large is refused before it takes time or memory, and a message of any is short.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "broken_scene.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("no message carries a control character or the whole of a long word") {
  const TemporaryFolder folder;
  const std::string word = "\\u001b[2J\\n" + std::string(10000, 'a');
  const std::vector<std::string> scenes = {broken("\"steel\"", '"' + word + '"'),
                                           broken("c = 0.3", '"' + word + "\" = 1"),
                                           broken("P0 = 1.0", '"' + word + "\" = 1"),
                                           broken("time = 0.0", "time = in\n"),
                                           broken("[stop]", "[material.\"" + word + "\"]\nlaw = \"none\"\n[stop]"),
                                           broken("[stop]", "[\"" + word + "\"]\n[stop]")};
  for (const std::string& scene : scenes) {
    CAPTURE(scene);
    const auto problems = problems_of(folder.write("bad.toml", scene));
    REQUIRE(!problems.empty());
    CHECK(std::ranges::none_of(problems[0].message, [](char c) { return c == '\x1b' || c == '\n'; }));
    CHECK(problems[0].message.size() < 500);
  }
}

TEST_CASE("of a scene with many faults 200 are told, and that there are more") {
  const TemporaryFolder folder;
  std::string scene = kGoodScene;
  for (int k = 0; k < 1000; ++k) scene += "[[probe]]\nnme = 1\n";
  const auto problems = problems_of(folder.write("bad.toml", scene));
  REQUIRE(problems.size() == 201);
  CHECK(problems.front().message == "probe[1]: the key 'name' is missing");
  CHECK(std::ranges::count(problems, std::string("from here on, more is wrong than is listed"), &Mistake::message) ==
        1);
}

TEST_CASE("a hundred thousand constants are computed in the order of their needs") {
  const TemporaryFolder folder;
  constexpr int count = 100'000;
  std::string chain = fmt::format("c{} = 7\n", count), circle;
  for (int k = 0; k < count; ++k) {
    chain += fmt::format("c{} = \"c{}\"\n", k, k + 1);
    circle += fmt::format("c{} = \"c{}\"\n", k, (k + 1) % count);
  }
  const auto with = [&](const std::string& constants) {
    return folder.write("many.toml", broken("P0 = 1.0", "P0 = \"c0\"\n" + constants));
  };
  CHECK(load_scene(with(chain)).constants.at("P0") == 7);
  const auto problems = problems_of(with(circle));
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message, Catch::Contains("constants.c0: is defined by itself: c0 → c1 →"));
  CHECK_THAT(problems[0].message, Catch::Contains("(100000 in all)"));
}

TEST_CASE("a support at the position of another is refused, also among a hundred thousand") {
  const TemporaryFolder folder;
  std::string scene = kGoodScene;
  for (int k = 1; k <= 100'000; ++k) scene += fmt::format("[[support]]\nat = {}e-5\n", k);
  const auto problems = problems_of(folder.write("many.toml", scene + "[[support]]\nat = 0.5\n"));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].message == "support[100001].at: support[50000] holds this position already");
}

TEST_CASE("more bodies than can be compared two by two are refused") {
  const TemporaryFolder folder;
  std::string bodies;
  for (int k = 0; k <= 10'000; ++k)
    bodies += fmt::format("[[body]]\nmin = {}e-4\nmax = {}e-4\nmaterial = \"steel\"\n", 10 * k, 10 * k + 5);
  const auto problems =
      problems_of(folder.write("bad.toml", broken("[body]\nmaterial = \"steel\"\npoints_per_cell = 3\n", bodies)));
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].message == "body: 10001 bodies are more than this program takes (10000)");
}

TEST_CASE("more values than a scene has are refused before they take memory") {
  const TemporaryFolder folder;
  std::string deep, wide = "stages = [";
  for (int k = 0; deep.size() < 15'000'000; ++k) {
    deep += fmt::format("[k{}", k);
    for (int part = 0; part < 199; ++part) deep += ".a";
    deep += "]\n";
  }
  for (int k = 0; k < 5'000'000; ++k) wide += "[],";
  for (const std::string& many : {deep, wide + "]\n"}) {
    const auto problems = problems_of(folder.write("bad.toml", kGoodScene + many));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].message == "holds more than 4 million values: not a scene");
  }
}

TEST_CASE("a scene with many variants is read no more often than is done in seconds") {
  const TemporaryFolder folder;
  std::string scene = kGoodScene + "#" + std::string(100'000, ' ') + "\n";
  for (int k = 0; k < 1000; ++k) scene += fmt::format("[[variant]]\nname = \"{0}\"\nset = [\"damping.c={0}\"]\n", k);
  const auto problems = problems_of(folder.write("bad.toml", scene));
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message, Catch::Contains("are more than this program reads"));
}

TEST_CASE("a key with a million parts is refused and does not overrun the stack") {
  const TemporaryFolder folder;
  std::string key = "a";
  for (int k = 0; k < 1'000'000; ++k) key += ".a";
  const auto problems = problems_of(folder.write("bad.toml", kGoodScene + key + " = 1\n"));
  REQUIRE(problems.size() == 1);
  REQUIRE_THAT(problems[0].message, Catch::Contains("too many dots"));
}
