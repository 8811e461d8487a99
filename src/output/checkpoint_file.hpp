// checkpoint.h5: the state of a run on disk, complete or absent.
//
// A block of 512 bytes of text comes first, with the length and the CRC-32 of all that follows, so that a truncated or
// altered file is recognised. Then comes the table of the values. These two are HDF5's user block; behind them is a
// dataset for each value of the state, at its path, which h5dump and h5py read. This program reads by the table and
// without HDF5, which a malicious file could crash.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <filesystem>

namespace stillpoint {

/// Writes NAME.partial, brings it to the disk and renames it; the former file is kept as checkpoint-previous.h5 beside
/// it. Throws std::filesystem::filesystem_error, and leaves the former files as they were.
void write_checkpoint(const std::filesystem::path& file, const SavedState& state);

/// Reads a state. Throws StateError with the file and the reason.
SavedState read_checkpoint(const std::filesystem::path& file);

/// The file in which the former checkpoint is kept.
std::filesystem::path previous_checkpoint(const std::filesystem::path& file);

}  // namespace stillpoint
