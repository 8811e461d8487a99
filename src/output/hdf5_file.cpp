#include "output/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "output/hdf5_handle.hpp"

namespace stillpoint {

using hdf5::Handle, hdf5::Quiet;

// Checks a return code of the library: a negative one means failure.
template <class Code>
Code Hdf5File::check(Code code, const char* failed) const {
  if (output_) output_->throw_failure();
  if (code >= 0) return code;
  const int number = errno != 0 ? errno : EIO;
  throw std::filesystem::filesystem_error(fmt::format("{}: {}", failed, hdf5::error_text()), path_,
                                          std::error_code(number, std::generic_category()));
}

Hdf5File::Hdf5File(std::filesystem::path path)
    : path_(std::move(path)), output_(std::in_place, path_), file_(output_->id()) {
  const Quiet quiet;
  can_deflate_ = check(H5Zfilter_avail(H5Z_FILTER_DEFLATE)) > 0;
}

Hdf5File::Hdf5File(Existing existing) : path_(std::move(existing.path)), file_(H5I_INVALID_HID) {
  const Quiet quiet;
  file_ = check(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "cannot read");
}

Hdf5File::~Hdf5File() {
  const Quiet quiet;
  if (!output_ && file_ >= 0) H5Fclose(file_);
}

void Hdf5File::make_group(const std::string& name) {
  const Quiet quiet;
  Handle group(check(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)), H5Gclose);
  check(group.close());
}

void Hdf5File::copy(const Hdf5File& from, const std::string& name) {
  const Quiet quiet;
  check(H5Ocopy(from.file_, name.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
  const Quiet quiet;
  std::vector<std::string> names;
  const auto keep = [](hid_t, const char* name, const H5L_info_t*, void* kept) -> herr_t {
    static_cast<std::vector<std::string>*>(kept)->emplace_back(name);
    return 0;
  };
  check(H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, keep, &names, H5P_DEFAULT));
  return names;
}

void Hdf5File::write_attribute(const std::string& group, const std::string& name, double value) {
  write_attribute(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::write_attribute(const std::string& group, const std::string& name, int value) {
  write_attribute(group, name, H5T_STD_I32LE, H5T_NATIVE_INT, &value);
}

// Of any length, which h5py reads as a str and not as bytes.
void Hdf5File::write_attribute(const std::string& group, const std::string& name, const std::string& value) {
  const Quiet quiet;
  const Handle type(check(H5Tcopy(H5T_C_S1)), H5Tclose);
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  const char* const text = value.c_str();
  write_attribute(group, name, type, type, static_cast<const void*>(&text));
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

// Chunks are smaller than the library's cache of 1 MiB. They are compressed at the cheapest level, after bytes of equal
// weight were put side by side, since the leading bytes of neighbours are alike. The rows are copied through a block as
// large as a chunk: from selected columns of a large array HDF5 would first make a list as large as that.
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

std::vector<double> Hdf5File::read(const std::string& name) const {
  const Quiet quiet;
  const Handle dataset(check(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), "cannot read"), H5Dclose);
  const Handle space(check(H5Dget_space(dataset), "cannot read"), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(check(H5Sget_simple_extent_npoints(space), "cannot read")));
  check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "cannot read");
  return values;
}

std::size_t Hdf5File::rows_of(const std::string& name) const {
  const Quiet quiet;
  const Handle dataset(check(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), "cannot read"), H5Dclose);
  const Handle space(check(H5Dget_space(dataset), "cannot read"), H5Sclose);
  std::array<hsize_t, 2> size{};
  if (check(H5Sget_simple_extent_ndims(space), "cannot read") > 2) return 0;
  check(H5Sget_simple_extent_dims(space, size.data(), nullptr), "cannot read");
  return size[0];
}

double Hdf5File::read_attribute(const std::string& group, const std::string& name) const {
  const Quiet quiet;
  const Handle attribute(
      check(H5Aopen_by_name(file_, group.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), "cannot read"), H5Aclose);
  double value = 0;
  check(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "cannot read");
  return value;
}

void Hdf5File::close() {
  const Quiet quiet;
  if (!output_) return static_cast<void>(check(H5Fclose(std::exchange(file_, H5I_INVALID_HID))));
  OutputFile& file = output_->close();
  file.bring_to_disk();
  file.close();
}

}  // namespace stillpoint
