// A driver of HDF5's virtual file layer [The HDF Group, HDF5 Virtual File Layer, 2011].
#include "output/hdf5_output.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "output/hdf5_handle.hpp"

namespace stillpoint {
namespace {

using hdf5::Handle, hdf5::Quiet;

// HDF5's view of the file; HDF5 takes a pointer to the first member for one to the whole.
struct OpenFile {
  H5FD_t of_library;
  Hdf5Output* output;
  haddr_t allocated, end;
};
OpenFile& own(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& own(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

struct Settings {
  Hdf5Output* output;
};

H5FD_t* open_file(const char* /*name*/, unsigned /*flags*/, hid_t access, haddr_t /*most*/) {
  const auto* settings = static_cast<const Settings*>(H5Pget_driver_info(access));
  return settings ? &(new OpenFile{{}, settings->output, 0, 0})->of_library : nullptr;
}

herr_t close_file(H5FD_t* file) {
  delete &own(file);
  return 0;
}

herr_t query(const H5FD_t* /*file*/, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t /*type*/) { return own(file).allocated; }

herr_t allocate(H5FD_t* file, H5FD_mem_t /*type*/, haddr_t end) {
  own(file).allocated = end;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t /*type*/) { return own(file).end; }

herr_t read(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t at, std::size_t size, void* to) {
  std::memset(to, 0, size);
  own(file).output->guard([&](const OutputFile& output) { output.read(static_cast<char*>(to), size, at); });
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t at, std::size_t size, const void* from) {
  own(file).output->guard([&](OutputFile& output) { output.write({static_cast<const char*>(from), size}, at); });
  own(file).end = std::max(own(file).end, at + size);
  return 0;
}

// The file is brought to its allocated size: its last part need not have been written.
herr_t truncate(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  OpenFile& mine = own(file);
  if (mine.end == mine.allocated) return 0;
  mine.output->guard([&](OutputFile& output) { output.resize(mine.allocated); });
  mine.end = mine.allocated;
  return 0;
}

hid_t driver() {
  static const hid_t registered = [] {
    H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
    driver.version = H5FD_CLASS_VERSION;
    driver.value = static_cast<H5FD_class_value_t>(512);  // values from 512 on are free for use
#endif
    driver.name = "checked";
    driver.maxaddr = (haddr_t{1} << 62) - 1;
    driver.fc_degree = H5F_CLOSE_STRONG;  // closing always succeeds, even after a failure
    driver.fapl_size = sizeof(Settings);
    driver.open = open_file;
    driver.close = close_file;
    driver.query = query;
    driver.get_eoa = allocated;
    driver.set_eoa = allocate;
    driver.get_eof = end_of_file;
    driver.read = read;
    driver.write = write;
    driver.truncate = truncate;
    constexpr std::array<H5FD_mem_t, H5FD_MEM_NTYPES> all_alike = H5FD_FLMAP_DICHOTOMY;
    std::ranges::copy(all_alike, driver.fl_map);
    return H5FDregister(&driver);
  }();
  return registered;
}

template <class Code>
Code check(Code code, const std::filesystem::path& path) {
  if (code >= 0) return code;
  throw std::filesystem::filesystem_error(fmt::format("cannot write: {}", hdf5::error_text()), path,
                                          std::make_error_code(std::errc::io_error));
}

}  // namespace

Hdf5Output::Hdf5Output(const std::filesystem::path& path, std::uint64_t head)
    : file_(path, OutputFile::Contents::none), id_(H5I_INVALID_HID) {
  const Quiet quiet;
  const Handle creation(check(H5Pcreate(H5P_FILE_CREATE), path), H5Pclose);
  check(H5Pset_userblock(creation, head), path);
  const Handle access(check(H5Pcreate(H5P_FILE_ACCESS), path), H5Pclose);
  const Settings settings{this};
  check(H5Pset_driver(access, check(driver(), path), &settings), path);
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), path);
  id_ = check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), path);
}

Hdf5Output::~Hdf5Output() {
  const Quiet quiet;
  if (id_ >= 0) H5Fclose(id_);
}

OutputFile& Hdf5Output::close() {
  const Quiet quiet;
  const herr_t closed = H5Fclose(std::exchange(id_, H5I_INVALID_HID));
  throw_failure();
  check(closed, file_.path());
  return file_;
}

}  // namespace stillpoint
