// The subcommands of `stillpoint`. Each returns the exit status.
#pragma once

#include <stillpoint/compare.hpp>
#include <stillpoint/converge.hpp>
#include <stillpoint/safety.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stillpoint::command {

struct SceneArguments {
  std::filesystem::path file;
  std::vector<std::string> overrides;  // "key=value"
};

struct RunArguments {
  SceneArguments scene;
  std::filesystem::path resume;  // a run's folder or a checkpoint to continue, instead of a scene
  std::filesystem::path out;     // empty: out/<scene's stem>
  int threads = 0;               // 0: OpenMP's own choice
  bool quiet = false;
};

struct CompareArguments {
  SceneArguments scene;
  std::filesystem::path out;  // empty: out/<scene's stem>-compare
  CompareOptions options;
  bool quiet = false;
};

struct ConvergeArguments {
  SceneArguments scene;
  std::filesystem::path out;                // empty: out/<scene's stem>-converge
  std::vector<std::string> refine = {"h"};  // names of refinements
  std::vector<std::string> vary;            // "key=value,value"
  ConvergeOptions options;
  bool quiet = false;
};

struct SafetyArguments {
  SceneArguments scene;
  std::filesystem::path out;  // empty: out/<scene's stem>-safety
  SafetyOptions options;
  bool quiet = false;
};

struct PlotArguments {
  std::string kind;                            // history, fields, compare or converge
  std::vector<std::filesystem::path> folders;  // of runs, or of one study
  std::filesystem::path out;                   // empty: <first folder>/<kind>.png
  std::string field;                           // empty: chosen
  std::vector<std::string> cuts;               // "axis=value"
  std::optional<int> stages;                   // at most
  bool shows = false;                          // in a window
};

int run(const RunArguments& arguments);
int compare(const CompareArguments& arguments);
int converge(const ConvergeArguments& arguments);
int safety(const SafetyArguments& arguments);
int check(const SceneArguments& arguments);
int spectrum(const SceneArguments& arguments);
/// Returns only if nothing is drawn: else the process becomes that of the program that draws.
int plot(const PlotArguments& arguments);
/// topic: integrators, dampings, relaxations, solvers, materials, bases, keys, or empty for all. format: text, or for
/// keys alone markdown or schema.
int list(const std::string& topic, const std::string& format = "text");

}  // namespace stillpoint::command
