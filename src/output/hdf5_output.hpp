// The file that HDF5 writes into. HDF5 does not survive a file that it cannot write to its end, so it never learns of a
// failure: the bytes are written by calls of this class, and the first failure is thrown once HDF5 is done with the
// file.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>

#include "base/output_file.hpp"

namespace stillpoint {

class Hdf5Output {
 public:
  /// Replaces a file that is there; head: bytes at its beginning that are not HDF5's, 0 or a power of 2 from 512 on.
  /// The constructor and close() throw std::filesystem::filesystem_error.
  explicit Hdf5Output(const std::filesystem::path& path, std::uint64_t head = 0);
  ~Hdf5Output();
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;

  /// HDF5's identifier, a hid_t.
  std::int64_t id() const { return id_; }
  /// Takes the file from HDF5. Afterwards the file under `path` is complete, or this throws the first failure; the file
  /// need not be on the disk yet.
  OutputFile& close();
  /// Throws the first failure so far, if any.
  void throw_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  // For HDF5's calls, which do not throw:
  template <class Call>
  void guard(const Call& call) noexcept {
    try {
      if (!failure_) call(file_);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

 private:
  OutputFile file_;
  std::exception_ptr failure_;
  std::int64_t id_;  // negative when closed
};

}  // namespace stillpoint
