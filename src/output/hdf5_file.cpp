#include "output/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <system_error>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>

namespace stillpoint {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>);

// The innermost entry of the library's error stack says most: "…, errno = 28, error message = 'No space left on
// device'".
std::string error_text() {
  std::string text = "HDF5 gives no reason";
  const auto keep_first = [](unsigned number, const H5E_error2_t* entry, void* kept) -> herr_t {
    if (number == 0 && entry->desc) *static_cast<std::string*>(kept) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  return text;
}

// While one lives, the library prints nothing of its own, and an errno is one of this time.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    errno = 0;
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// An identifier that is given back at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*give_back)(hid_t)) : id_(id), give_back_(give_back) {}
  ~Handle() {
    if (id_ >= 0) give_back_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  // Gives it back now: that a last chunk cannot be written shows only here.
  [[nodiscard]] herr_t close() { return give_back_(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  hid_t id_;
  herr_t (*give_back_)(hid_t);
};

}  // namespace

// Every return code of the library comes here: a negative one is its failure.
template <class Code>
Code Hdf5File::check(Code code) const {
  if (code >= 0) return code;
  const int number = errno != 0 ? errno : EIO;
  throw std::filesystem::filesystem_error(fmt::format("cannot write: {}", error_text()), path_,
                                          std::error_code(number, std::generic_category()));
}

Hdf5File::Hdf5File(std::filesystem::path path) : path_(std::move(path)), file_(H5I_INVALID_HID) {
  const Quiet quiet;
  const Handle access(check(H5Pcreate(H5P_FILE_ACCESS)), H5Pclose);
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));  // closed is closed, even after a failure
  can_deflate_ = check(H5Zfilter_avail(H5Z_FILTER_DEFLATE)) > 0;
  file_ = check(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
}

Hdf5File::~Hdf5File() {
  const Quiet quiet;
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::make_group(const std::string& name) {
  const Quiet quiet;
  Handle group(check(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)), H5Gclose);
  check(group.close());
}

void Hdf5File::remove(const std::string& name) noexcept {
  const Quiet quiet;
  H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
}

void Hdf5File::write_attribute(const std::string& group, const std::string& name, double value) {
  write_attribute(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::write_attribute(const std::string& group, const std::string& name, int value) {
  write_attribute(group, name, H5T_STD_I32LE, H5T_NATIVE_INT, &value);
}

void Hdf5File::write_attribute(const std::string& group, const std::string& name, hid_t type, hid_t native_type,
                               const void* value) {
  const Quiet quiet;
  const Handle space(check(H5Screate(H5S_SCALAR)), H5Sclose);
  Handle attribute(
      check(H5Acreate_by_name(file_, group.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
      H5Aclose);
  check(H5Awrite(attribute, native_type, value));
  check(attribute.close());
}

void Hdf5File::write(const std::string& name, const std::vector<double>& values, const Columns& columns) {
  write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values, columns);
}

void Hdf5File::write(const std::string& name, const std::vector<int>& values) {
  write(name, H5T_STD_I32LE, H5T_NATIVE_INT, values, {1, 0, 1, 1});
}

// Chunks are within the library's cache of 1 MiB. They are compressed at the level that costs least, after bytes of
// equal weight were put side by side, since it is the leading ones of neighbours that are alike. The rows go by way of
// a block as large as a chunk: from selected columns of a large array HDF5 would first make a list as large as that.
template <class Number>
void Hdf5File::write(const std::string& name, hid_t type, hid_t native_type, const std::vector<Number>& values,
                     const Columns& columns) {
  const std::size_t rows = values.size() / columns.width;
  assert(rows > 0 && columns.first + columns.count <= columns.width && columns.count <= columns.columns);
  const Quiet quiet;
  const std::array<hsize_t, 2> size = {rows, columns.columns};
  const std::array<hsize_t, 2> chunk = {std::min<std::size_t>(rows, 16384), columns.columns};
  const int rank = columns.columns == 1 ? 1 : 2;
  const Handle layout(check(H5Pcreate(H5P_DATASET_CREATE)), H5Pclose);
  check(H5Pset_obj_track_times(layout, false));
  check(H5Pset_chunk(layout, rank, chunk.data()));
  if (can_deflate_) {
    check(H5Pset_shuffle(layout));
    check(H5Pset_deflate(layout, 1));
  }
  const Handle space(check(H5Screate_simple(rank, size.data(), nullptr)), H5Sclose);
  Handle dataset(check(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT)), H5Dclose);

  std::vector<Number> block(chunk[0] * chunk[1], 0);
  for (std::size_t begin = 0; begin < rows; begin += chunk[0]) {
    const std::array<hsize_t, 2> start = {begin, 0}, extent = {std::min<hsize_t>(rows - begin, chunk[0]), chunk[1]};
    for (std::size_t row = 0; row < extent[0]; ++row) {
      const auto from = values.begin() + static_cast<std::ptrdiff_t>((begin + row) * columns.width + columns.first);
      std::copy_n(from, columns.count, block.begin() + static_cast<std::ptrdiff_t>(row * columns.columns));
    }
    const Handle memory(check(H5Screate_simple(rank, extent.data(), nullptr)), H5Sclose);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr));
    check(H5Dwrite(dataset, native_type, memory, space, H5P_DEFAULT, block.data()));
  }
  check(dataset.close());
}

void Hdf5File::flush() {
  const Quiet quiet;
  check(H5Fflush(file_, H5F_SCOPE_LOCAL));
}

void Hdf5File::close() {
  const Quiet quiet;
  check(H5Fclose(std::exchange(file_, H5I_INVALID_HID)));
}

}  // namespace stillpoint
