// CRC-32 of bytes, to tell whether a file is still what was written.
#pragma once

#include <cstddef>
#include <cstdint>

#include <zlib.h>

namespace stillpoint {

/// Of `size` bytes that follow those of which it was `before`; 0 if there were none.
inline std::uint64_t checksum(std::uint64_t before, const void* bytes, std::size_t size) {
  return crc32_z(before, static_cast<const Bytef*>(bytes), size);
}

}  // namespace stillpoint
