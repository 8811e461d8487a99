// stillpoint plot: draws what a run or a study has left, by the programs of src/python/stillpoint/plots, which need a
// Python but nothing of this library.
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "command/commands.hpp"

namespace stillpoint::command {
namespace {

namespace fs = std::filesystem;

constexpr int nothing_drawn = 2;

// Where the program was built, what draws lies beside it in the Python package; if installed, it is in the folder of
// data or in that package again, wherever they were put.
fs::path folder_of_plots() {
  std::error_code ignored;
  const fs::path own = fs::canonical("/proc/self/exe", ignored).parent_path();
  const fs::path name = "stillpoint/plots", up = "..";
  const std::array candidates{own / "python" / name, own / up / STILLPOINT_DATADIR / name,
                              own / up / STILLPOINT_PYTHON_DIR / name, fs::path(STILLPOINT_FULL_DATADIR) / name};
  for (const fs::path& candidate : candidates)
    if (fs::exists(candidate / "__main__.py", ignored)) return candidate;
  return {};
}

// What goes with another kind of picture; empty if all is well.
std::string wrong_use(const PlotArguments& plot) {
  const bool is_of_fields = plot.kind == "fields";
  const auto only_of_fields = [&](const char* option, bool is_given) {
    return is_given && !is_of_fields ? fmt::format("{}: goes with `plot fields` alone", option) : std::string();
  };
  for (const std::string& wrong :
       {only_of_fields("--field", !plot.field.empty()), only_of_fields("--cut", !plot.cuts.empty()),
        only_of_fields("--stages", plot.stages.has_value())})
    if (!wrong.empty()) return wrong;
  const bool draws_one = !is_of_fields && plot.kind != "history";
  if (draws_one && plot.folders.size() > 1) return fmt::format("plot {}: expected one DIR", plot.kind);
  return {};
}

std::vector<std::string> words_of(const PlotArguments& plot, const std::string& python, const fs::path& program) {
  std::vector<std::string> words{python, "-B", program.string(), plot.kind};  // -B: nothing is written where that lies
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.push_back(fmt::format("{}={}", option, value));
  };
  add("--out", plot.out.string());
  add("--field", plot.field);
  for (const std::string& cut : plot.cuts) add("--cut", cut);
  if (plot.stages) add("--stages", std::to_string(*plot.stages));
  if (plot.shows) words.emplace_back("--show");
  words.emplace_back("--");
  for (const fs::path& folder : plot.folders) words.push_back(folder.string());
  return words;
}

// Becomes the program that these words start; returns if that cannot be.
void become(std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  execvp(arguments.front(), arguments.data());
}

}  // namespace

int plot(const PlotArguments& arguments) {
  if (const std::string wrong = wrong_use(arguments); !wrong.empty()) {
    fmt::print(stderr, "{}\n", wrong);
    return nothing_drawn;
  }
  const fs::path program = folder_of_plots();
  if (program.empty()) {
    fmt::print(stderr, "plot: what draws is not installed; expected it in {}/stillpoint/plots\n",
               STILLPOINT_FULL_DATADIR);
    return nothing_drawn;
  }
  const char* const asked = std::getenv("STILLPOINT_PYTHON");
  const std::string python = asked && *asked ? asked : "/usr/bin/python3";
  std::vector<std::string> words = words_of(arguments, python, program);
  become(words);
  fmt::print(stderr,
             "plot: {} cannot be started: {}; install Debian's package python3, or let the variable STILLPOINT_PYTHON "
             "name a Python\n",
             python, std::strerror(errno));
  return nothing_drawn;
}

}  // namespace stillpoint::command
