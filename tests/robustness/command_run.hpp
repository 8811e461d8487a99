// The command as its user has it: arguments, exit status, what it prints and what it leaves.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/wait.h>

#include "files.hpp"
#include "temporary_folder.hpp"

namespace stillpoint::test {

/// The end of one run of the command, whose working folder is one of its own.
struct CommandRun {
  int status = -1;
  std::string output, standard_error;
  bool wrote = false;  // whether there is anything beside the scene file

  /// arguments go through the shell; SCENE and OUT in them stand for the scene file and an output folder.
  /// environment: NAME=VALUE …
  CommandRun(const std::string& scene, std::string arguments, const std::string& environment = "") {
    const TemporaryFolder own, printed;
    const auto file = own.write("scene.toml", scene);
    replace(arguments, "SCENE", file.string());
    replace(arguments, "OUT", (own.path() / "out").string());
    const std::string out = printed.path() / "output", errors = printed.path() / "errors";
    const std::string line =
        "cd " + own.path().string() + " && ( " + environment + " " STILLPOINT_BINARY " " + arguments + " ) >" + out;
    const int ended = std::system((line + " 2>" + errors).c_str());
    status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    output = contents(out);
    standard_error = contents(errors);
    replace(standard_error, file.string(), "scene.toml");
    std::filesystem::remove(file);
    wrote = !std::filesystem::is_empty(own.path());
  }

 private:
  static void replace(std::string& text, const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
};

}  // namespace stillpoint::test
