// Without libFuzzer: gives a target every file of some folders, once each.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "files.hpp"
#include "fuzz_target.hpp"

namespace fs = std::filesystem;

int main(int count, char** folders) {
  std::vector<fs::path> files;
  for (int k = 1; k < count; ++k) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folders[k]))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    std::fprintf(stderr, "%s\n", file.c_str());  // the last one is what a crash is of
    const std::string bytes = stillpoint::test::contents(file);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu files\n", files.size());
  return files.empty() ? 1 : 0;
}
