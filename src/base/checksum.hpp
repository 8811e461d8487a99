// CRC-32 of bytes, to detect whether a file has changed since it was written.
#pragma once

#include <cstddef>
#include <cstdint>

#include <zlib.h>

namespace stillpoint {

/// The checksum after `size` more bytes; before: the checksum of the bytes that precede them, 0 if there are none.
inline std::uint64_t checksum(std::uint64_t before, const void* bytes, std::size_t size) {
  return crc32_z(before, static_cast<const Bytef*>(bytes), size);
}

}  // namespace stillpoint
