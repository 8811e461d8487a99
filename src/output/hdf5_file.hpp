// An HDF5 file that is written, dataset by dataset, or read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/hdf5_output.hpp"

namespace stillpoint {

/// The columns of an array (rows × width) that make a dataset: `count` of them from `first` on become the first of the
/// dataset's `columns`, and the others are 0. A dataset of one column is of rank 1.
struct Columns {
  std::size_t width, first, count, columns;
};

/// Every function throws std::filesystem::filesystem_error, with the library's message, if the library fails. Numbers
/// are little-endian float64 and int32. Equal calls make equal files: no times are stored.
class Hdf5File {
 public:
  /// Creates the file, replacing one that is there.
  explicit Hdf5File(std::filesystem::path path);
  /// Opens an existing file for reading.
  struct Existing {
    std::filesystem::path path;
  };
  explicit Hdf5File(Existing existing);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void make_group(const std::string& name);
  /// Copies a group or a dataset of another file, with all below it, as it is stored there.
  void copy(const Hdf5File& from, const std::string& name);
  std::vector<std::string> names_in(const std::string& group) const;
  void write_attribute(const std::string& group, const std::string& name, double value);
  void write_attribute(const std::string& group, const std::string& name, int value);
  void write_attribute(const std::string& group, const std::string& name, const std::string& value);
  /// Writes a dataset of at least one row. Chunked, and compressed if the library can, a chunk at a time.
  void write(const std::string& name, const std::vector<double>& values, const Columns& columns);
  void write(const std::string& name, const std::vector<int>& values);

  /// A dataset of numbers, row by row; its number of rows; and an attribute of a group.
  std::vector<double> read(const std::string& name) const;
  std::size_t rows_of(const std::string& name) const;
  double read_attribute(const std::string& group, const std::string& name) const;

  /// Closes the file. Any failure to write is thrown here at the latest; afterwards the file is on the disk.
  void close();

 private:
  template <class Code>
  Code check(Code code, const char* failed = "cannot write") const;
  void write_attribute(const std::string& group, const std::string& name, std::int64_t type, std::int64_t native_type,
                       const void* value);
  template <class Number>
  void write(const std::string& name, std::int64_t type, std::int64_t native_type, const std::vector<Number>& values,
             const Columns& columns);

  std::filesystem::path path_;
  std::optional<Hdf5Output> output_;  // only while writing
  std::int64_t file_;                 // HDF5's hid_t; negative when closed
  bool can_deflate_ = false;
};

}  // namespace stillpoint
