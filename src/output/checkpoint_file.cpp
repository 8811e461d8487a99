#include "output/checkpoint_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "output/hdf5_handle.hpp"
#include "output/hdf5_output.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle, hdf5::Quiet;

constexpr std::size_t head_size = 512;  // at most the smallest user block of HDF5
constexpr const char* head_format =
    "Stillpoint checkpoint, format 2\nCRC-32 %" PRIx64 " of the %" PRIu64 " bytes after these 512\n";

// --- the head --------------------------------------------------------------------------------------------------------

constexpr const char* scan_format =
    "Stillpoint checkpoint, format 2\nCRC-32 %" SCNx64 " of the %" SCNu64 " bytes after these 512\n";

struct Head {
  std::uint64_t crc = 0;
  std::uint64_t size = 0;
};

// Computes the head for the bytes that follow it in the file.
Head head_of(std::istream& file) {
  Head head;
  std::vector<char> block(1 << 16);
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

// Why the file is not to be read; empty if it is complete.
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

// --- the table -------------------------------------------------------------------------------------------------------

// The table has a line for each value: its kind, the byte of the file at which it begins, how many numbers it has, its
// name.
enum class Kind { real, whole, text };
constexpr std::array<std::string_view, 3> kind_names = {"real", "whole", "text"};

Kind kind_of(const SavedValue& value) {
  return std::holds_alternative<std::string>(value)           ? Kind::text
         : std::holds_alternative<std::vector<double>>(value) ? Kind::real
                                                              : Kind::whole;
}

std::string line_of(Kind kind, std::uint64_t begin, std::uint64_t count, const std::string& name) {
  return fmt::format("{} {} {} {}\n", kind_names[static_cast<std::size_t>(kind)], begin, count, name);
}

// The size of HDF5's user block, a power of two: room for the head, the table with any numbers, and an empty line.
std::uint64_t bytes_before(const SavedState& state) {
  constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t bytes = head_size + 1;
  for (const auto& [name, value] : state) bytes += line_of(Kind::whole, largest, largest, name).size();
  return std::bit_ceil(bytes);
}

// --- writing, by HDF5 ------------------------------------------------------------------------------------------------

class Writer {
 public:
  Writer(const fs::path& path, const SavedState& state)
      : path_(path), before_(bytes_before(state)), output_(path, before_) {
    const Quiet quiet;
    const Handle links(check(H5Pcreate(H5P_LINK_CREATE)), H5Pclose);
    check(H5Pset_create_intermediate_group(links, 1));
    for (const auto& [name, value] : state) {
      if (name.find('\n') != std::string::npos) throw std::logic_error("the name of a value of a state has two lines");
      table_ += std::visit(
          [&, &path_of_value = name, kind = kind_of(value)](const auto& values) {
            const std::uint64_t begin = write(links, path_of_value, kind, values.size(), values.data());
            return line_of(kind, begin, values.size(), path_of_value);
          },
          value);
    }
  }
  void finish() {
    OutputFile& file = output_.close();
    table_.resize(before_ - head_size, '\n');
    file.write(table_, head_size);
    write_head(file);
    file.bring_to_disk();
    file.close();
  }

 private:
  // Returns the byte at which the numbers begin in the file. A text is written as its bytes: it may be empty, and may
  // hold any bytes.
  std::uint64_t write(hid_t links, const std::string& name, Kind kind, hsize_t count, const void* data) {
    const hid_t type = kind == Kind::real    ? H5T_NATIVE_DOUBLE
                       : kind == Kind::whole ? H5T_NATIVE_INT64
                                             : H5T_NATIVE_UCHAR;
    const Handle space(check(H5Screate_simple(1, &count, nullptr)), H5Sclose);
    Handle dataset(check(H5Dcreate2(output_.id(), name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT)),
                   H5Dclose);
    std::uint64_t begin = 0;
    if (count > 0) {
      check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data));
      begin = H5Dget_offset(dataset);
      if (begin == HADDR_UNDEF) fail();
    }
    check(dataset.close());
    return begin;
  }

  template <class Code>
  Code check(Code code) const {
    output_.throw_failure();
    if (code < 0) fail();
    return code;
  }
  [[noreturn]] void fail() const {
    throw fs::filesystem_error(fmt::format("cannot write: {}", hdf5::error_text()), path_,
                               std::make_error_code(std::errc::io_error));
  }

  const fs::path& path_;
  std::uint64_t before_;  // bytes of the user block, before those of HDF5
  Hdf5Output output_;
  std::string table_;
};

// --- reading, without HDF5, which trusts what it reads ---------------------------------------------------------------

class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path), file_(path, std::ios::binary), left_(fs::file_size(path)) {}

  SavedState read() {
    std::vector<std::string> lines;
    file_.seekg(head_size);
    for (std::string line; std::getline(file_, line) && !line.empty();) lines.push_back(std::move(line));
    if (!file_) fail();
    SavedState state;
    for (const std::string& line : lines)
      if (!std::apply([&](auto&&... entry) { return state.emplace(std::move(entry)...).second; }, entry_of(line)))
        fail();
    return state;
  }

 private:
  std::pair<std::string, SavedValue> entry_of(std::string_view line) {
    const auto next_word = [&] {
      const std::string_view word = line.substr(0, line.find(' '));
      line.remove_prefix(std::min(word.size() + 1, line.size()));
      return word;
    };
    const auto next_number = [&] {
      const std::string_view word = next_word();
      std::uint64_t number = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || end != word.data() + word.size()) fail();
      return number;
    };
    const auto kind = static_cast<std::size_t>(std::ranges::find(kind_names, next_word()) - kind_names.begin());
    if (kind == kind_names.size()) fail();
    const std::uint64_t begin = next_number(), count = next_number();
    const std::string name(line);
    if (static_cast<Kind>(kind) == Kind::real) return {name, values<std::vector<double>>(begin, count)};
    if (static_cast<Kind>(kind) == Kind::whole) return {name, values<std::vector<std::int64_t>>(begin, count)};
    return {name, values<std::string>(begin, count)};
  }

  // No byte belongs to two values, so that together they are no larger than the file, whatever the table says.
  template <class Values>
  Values values(std::uint64_t begin, std::uint64_t count) {
    constexpr std::size_t size = sizeof(typename Values::value_type);
    if (count > left_ / size) fail();
    left_ -= count * size;
    Values read(count, {});
    if (count > 0) {
      file_.seekg(static_cast<std::streamoff>(begin));
      file_.read(reinterpret_cast<char*>(read.data()), static_cast<std::streamsize>(count * size));
    }
    if (!file_) fail();
    return read;
  }

  [[noreturn]] void fail() const {
    throw StateError(fmt::format("{}: cannot be read: its table is not that of its values", path_.string()));
  }

  const fs::path& path_;
  std::ifstream file_;
  std::uint64_t left_;  // bytes of the file that no value has claimed yet
};

// There is a checkpoint at any moment: the former one gets its second name while it still has the first.
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
    Writer writer(partial, state);
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
