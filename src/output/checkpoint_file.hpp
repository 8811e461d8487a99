// checkpoint.h5: the state of a run on disk, whole or not there.
//
// A block of 512 bytes of text comes first, with the length and the CRC-32 of all that follows: a file that was cut
// short or altered is told. Then the table of the values, and behind these two, which are HDF5's user block, a dataset
// for each value of the state, at its path; h5dump and h5py read them. This program reads by the table and leaves HDF5
// out of it, which a file that was made to harm could crash.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <filesystem>

namespace stillpoint {

/// Written as NAME.partial, brought to the disk, renamed; the file that was there before is kept as
/// checkpoint-previous.h5 beside it. Throws std::filesystem::filesystem_error, and leaves what there was.
void write_checkpoint(const std::filesystem::path& file, const SavedState& state);

/// Throws StateError with the file and the reason.
SavedState read_checkpoint(const std::filesystem::path& file);

/// Where the one before is kept.
std::filesystem::path previous_checkpoint(const std::filesystem::path& file);

}  // namespace stillpoint
