// Whether a file has room on its disk.
#pragma once

#include <cstdint>
#include <filesystem>

namespace stillpoint {

/// Throws std::filesystem::filesystem_error unless a file of that name, which must not be one that is needed, can grow
/// to so many bytes. HDF5 does not survive a file that it cannot write to its end.
void require_room(const std::filesystem::path& file, std::uint64_t bytes);

}  // namespace stillpoint
