// The subcommands of `stillpoint`. Each returns the exit status.
#pragma once

#include <stillpoint/compare.hpp>
#include <stillpoint/converge.hpp>
#include <stillpoint/safety.hpp>

#include <filesystem>
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

int run(const RunArguments& arguments);
int compare(const CompareArguments& arguments);
int converge(const ConvergeArguments& arguments);
int safety(const SafetyArguments& arguments);
int check(const SceneArguments& arguments);
int spectrum(const SceneArguments& arguments);
/// topic: integrators, dampings, relaxations, solvers, materials, bases, keys, or empty for all. format: text, or for
/// keys alone markdown or schema.
int list(const std::string& topic, const std::string& format = "text");

}  // namespace stillpoint::command
