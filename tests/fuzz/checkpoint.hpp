// Checkpoints as somebody makes them who knows the format and means harm: whole, by their head.
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "temporary_folder.hpp"

namespace stillpoint::fuzz {

/// Writes a checkpoint: the table and the values, under a head that goes with them.
inline std::filesystem::path write_checkpoint_of(const std::string& rest) {
  static const test::TemporaryFolder folder;
  std::string head = fmt::format("Stillpoint checkpoint, format 2\nCRC-32 {:x} of the {} bytes after these 512\n",
                                 checksum(0, rest.data(), rest.size()), rest.size());
  head.resize(512, '\n');
  return folder.write("checkpoint.h5", head + rest);
}

}  // namespace stillpoint::fuzz
