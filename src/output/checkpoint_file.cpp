#include "output/checkpoint_file.hpp"

#include <array>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "base/checksum.hpp"
#include "output/hdf5_handle.hpp"
#include "output/hdf5_output.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle, hdf5::Quiet;

constexpr std::size_t head_size = 512;  // the least that HDF5 allows
constexpr const char* head_format =
    "Stillpoint checkpoint, format 1\nCRC-32 %" PRIx64 " of the %" PRIu64 " bytes after these 512\n";

// --- the head --------------------------------------------------------------------------------------------------------

constexpr const char* scan_format =
    "Stillpoint checkpoint, format 1\nCRC-32 %" SCNx64 " of the %" SCNu64 " bytes after these 512\n";

struct Head {
  std::uint64_t crc = 0;
  std::uint64_t size = 0;
};

// Of what follows the head.
Head head_of(std::istream& file) {
  Head head;
  std::vector<char> block(1 << 20);
  file.seekg(head_size);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    const auto count = static_cast<std::size_t>(file.gcount());
    head.crc = checksum(head.crc, block.data(), count);
    head.size += count;
  }
  return head;
}

void write_head(OutputFile& file) {
  std::ifstream written(file.path(), std::ios::binary);
  const Head head = head_of(written);
  std::string text(head_size, '\n');
  const int length = std::snprintf(text.data(), text.size(), head_format, head.crc, head.size);
  text[static_cast<std::size_t>(length)] = '\n';
  file.write(text, 0);
}

// Why the file is not to be read; empty: it is whole.
std::string fault_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return "cannot be read";
  std::array<char, head_size + 1> text{};
  file.read(text.data(), head_size);
  Head told;
  if (file.gcount() != head_size || std::sscanf(text.data(), scan_format, &told.crc, &told.size) != 2)
    return "is no checkpoint of this format";
  const Head found = head_of(file);
  if (found.size < told.size) return fmt::format("is cut short: {} bytes of {}", found.size, told.size);
  if (found.size > told.size || found.crc != told.crc) return "was altered: its checksum is another";
  return "";
}

// --- the datasets ----------------------------------------------------------------------------------------------------

class Writer {
 public:
  explicit Writer(const fs::path& path) : output_(path, head_size), path_(path) {}

  void write(const SavedState& state) {
    const Quiet quiet;
    const Handle links(check(H5Pcreate(H5P_LINK_CREATE)), H5Pclose);
    check(H5Pset_create_intermediate_group(links, 1));
    for (const auto& [name, value] : state) {
      std::visit([&, &path = name](const auto& of_kind) { write(links, path, of_kind); }, value);
    }
  }
  void finish() {
    OutputFile& file = output_.close();
    write_head(file);
    file.bring_to_disk();
    file.close();
  }

 private:
  void write(hid_t links, const std::string& name, const std::vector<double>& values) {
    write(links, name, H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  void write(hid_t links, const std::string& name, const std::vector<std::int64_t>& values) {
    write(links, name, H5T_NATIVE_INT64, values.size(), values.data());
  }
  // As its bytes: a text may be empty, and may hold any.
  void write(hid_t links, const std::string& name, const std::string& text) {
    write(links, name, H5T_NATIVE_UCHAR, text.size(), text.data());
  }
  void write(hid_t links, const std::string& name, hid_t type, hsize_t size, const void* data) {
    const Handle space(check(H5Screate_simple(1, &size, nullptr)), H5Sclose);
    Handle dataset(check(H5Dcreate2(output_.id(), name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT)),
                   H5Dclose);
    if (size > 0) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
    check(dataset.close());
  }

  template <class Code>
  Code check(Code code) const {
    output_.throw_failure();
    if (code >= 0) return code;
    throw fs::filesystem_error(fmt::format("cannot write: {}", hdf5::error_text()), path_,
                               std::make_error_code(std::errc::io_error));
  }

  Hdf5Output output_;
  const fs::path& path_;
};

class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path) {}

  SavedState read() {
    const Quiet quiet;
    const Handle file(check(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)), H5Fclose);
    std::vector<std::string> names;
    const auto keep_dataset = [](hid_t, const char* name, const H5O_info_t* info, void* kept) -> herr_t {
      if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(kept)->emplace_back(name);
      return 0;
    };
    check(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, keep_dataset, &names));
    SavedState state;
    for (const std::string& name : names) state.emplace(name, value(file, name));
    return state;
  }

 private:
  SavedValue value(hid_t file, const std::string& name) {
    const Handle dataset(check(H5Dopen2(file, name.c_str(), H5P_DEFAULT)), H5Dclose);
    const Handle space(check(H5Dget_space(dataset)), H5Sclose), type(check(H5Dget_type(dataset)), H5Tclose);
    const auto size = static_cast<std::size_t>(check(H5Sget_simple_extent_npoints(space)));
    const bool is_real = H5Tget_class(type) == H5T_FLOAT, is_text = H5Tget_size(type) == 1;
    if (is_real) return read<std::vector<double>>(dataset, H5T_NATIVE_DOUBLE, size);
    if (is_text) return read<std::string>(dataset, H5T_NATIVE_UCHAR, size);
    return read<std::vector<std::int64_t>>(dataset, H5T_NATIVE_INT64, size);
  }
  template <class Values>
  Values read(hid_t dataset, hid_t type, std::size_t size) {
    Values values(size, {});
    if (size > 0) check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    return values;
  }

  template <class Code>
  Code check(Code code) const {
    if (code < 0) throw StateError(fmt::format("{}: cannot be read: {}", path_.string(), hdf5::error_text()));
    return code;
  }

  const fs::path& path_;
};

// There is a checkpoint at any moment: the one before gets its second name while it has the first.
void keep_previous(const fs::path& file) {
  std::error_code no_links;
  const fs::path link = partial_name(previous_checkpoint(file));
  fs::remove(link, no_links);
  if (!fs::exists(file)) return;
  fs::create_hard_link(file, link, no_links);
  fs::rename(no_links ? file : link, previous_checkpoint(file));
}

}  // namespace

fs::path previous_checkpoint(const fs::path& file) {
  return file.parent_path() / (file.stem().string() + "-previous" + file.extension().string());
}

void write_checkpoint(const fs::path& file, const SavedState& state) {
  const fs::path partial = partial_name(file);
  try {
    Writer writer(partial);
    writer.write(state);
    writer.finish();
    keep_previous(file);
    fs::rename(partial, file);
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw;
  }
}

SavedState read_checkpoint(const fs::path& file) {
  if (const std::string fault = fault_of(file); !fault.empty())
    throw StateError(fmt::format("{}: {}", file.string(), fault));
  return Reader(file).read();
}

}  // namespace stillpoint
