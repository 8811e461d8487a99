// The output folder of a study, and its progress.
#pragma once

#include <stillpoint/study_progress.hpp>

#include <filesystem>
#include <memory>

#include "output/run_folder.hpp"

namespace stillpoint::command {

/// "[3/40] what is done  about 12 s left": one line that rewrites itself on a terminal, occasional plain lines
/// elsewhere.
class CountLine {
 public:
  CountLine();
  void show(const StudyProgress& progress);
  /// Clears the line on a terminal.
  void finish() const;

 private:
  bool terminal_;
  double next_plain_line_ = 10;  // [s]
};

/// The output folder, made before anything runs, since a folder that cannot be made is bad input. It is removed again
/// if it stays empty, and locked against other runs meanwhile.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  const std::filesystem::path& path_;
  std::shared_ptr<FolderLock> lock_;
};

}  // namespace stillpoint::command
