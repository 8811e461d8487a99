// stillpoint_yardsticks [--quick] [--check] [NAME…]: how fast a step could be here, written by hand for one case, on
// one thread. Prints JSON: the processor, the width of its vectors as far as this is compiled for them, and of each
// yardstick (all, or the named ones) the ns a point and step, of some repetitions the least. --check compares a step of
// each with a naive one instead. Exit status: 0, 1 if a check failed, 2 for bad input.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lanes.hpp"
#include "yardstick.hpp"

namespace {

using yardsticks::Yardstick;

struct Named {
  std::string_view name;
  std::unique_ptr<Yardstick> (*make)();
};
constexpr std::array all{Named{"space", yardsticks::make_space}, Named{"plane_linear", yardsticks::make_plane_linear},
                         Named{"plane_quadratic", yardsticks::make_plane_quadratic},
                         Named{"stream_space", yardsticks::make_stream_space},
                         Named{"stream_plane", yardsticks::make_stream_plane}};

struct Options {
  bool quick = false, check = false;
  std::vector<Named> wanted;
};

bool read(int argc, char** argv, Options& options) {
  for (int k = 1; k < argc; ++k) {
    const std::string_view word = argv[k];
    const auto* const named = std::ranges::find(all, word, &Named::name);
    if (word == "--quick") {
      options.quick = true;
    } else if (word == "--check") {
      options.check = true;
    } else if (named != all.end()) {
      options.wanted.push_back(*named);
    } else {
      std::fprintf(stderr, "stillpoint_yardsticks: no yardstick or option '%s'; there are --quick, --check", argv[k]);
      for (const Named& one : all) std::fprintf(stderr, ", %s", one.name.data());
      std::fprintf(stderr, "\n");
      return false;
    }
  }
  if (options.wanted.empty()) options.wanted.assign(all.begin(), all.end());
  return true;
}

// In JSON's quotes.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    std::string name = line.substr(std::min(line.size(), line.find(':') + 2));
    std::erase_if(name, [](char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < ' '; });
    return name;
  }
  return "an unknown processor";
}

double seconds_of(Yardstick& yardstick, int steps) {
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < steps; ++k) yardstick.step();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// The least time a step takes [s], each time over about as many steps as take 20 ms, or 5 if quick.
double seconds_a_step(Yardstick& yardstick, bool quick) {
  const int repetitions = quick ? 5 : 20;
  double least = std::min(seconds_of(yardstick, 1), seconds_of(yardstick, 1));
  for (int k = 0; k < repetitions; ++k) {
    const int steps = std::clamp(static_cast<int>((quick ? 0.005 : 0.02) / least), 1, 1000);
    least = std::min(least, seconds_of(yardstick, steps) / steps);
  }
  return least;
}

int check(const Options& options) {
  int status = 0;
  for (const auto& [name, make] : options.wanted) {
    std::fprintf(stderr, "%s: ", name.data());
    const std::string wrong = make()->wrong();
    std::fprintf(stderr, "%s\n", wrong.empty() ? "as it should be" : wrong.c_str());
    if (!wrong.empty()) status = 1;
  }
  return status;
}

void measure(const Options& options) {
  std::printf("{\n  \"processor\": \"%s\",\n  \"vector_bits\": %d,\n  \"yardsticks\": {", processor().c_str(),
              yardsticks::vector_bits);
  const char* separator = "\n";
  for (const auto& [name, make] : options.wanted) {
    const auto yardstick = make();
    const double ns = 1e9 * seconds_a_step(*yardstick, options.quick) / static_cast<double>(yardstick->points());
    std::printf("%s    \"%s\": {\"points\": %zu, \"bytes_per_point_step\": %zu, \"ns_per_point_step\": %.4g}",
                separator, name.data(), yardstick->points(), yardstick->bytes_per_point(), ns);
    separator = ",\n";
  }
  std::printf("\n  }\n}\n");
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  if (!read(argc, argv, options)) return 2;
  if (options.check) return check(options);
  measure(options);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "stillpoint_yardsticks: %s\n", error.what());
  return 1;
}
