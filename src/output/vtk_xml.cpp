#include "output/vtk_xml.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "base/base64.hpp"

namespace stillpoint {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class Number>
std::string_view bytes_of(std::span<const Number> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

/// Blocks by themselves, at the cheapest level; before them their number, the size of a block and of a last one that is
/// smaller, or 0, and the size of each when compressed.
void append_compressed(std::string& text, std::string_view bytes) {
  constexpr std::size_t block = 1 << 15;
  std::vector<std::uint64_t> sizes = {(bytes.size() + block - 1) / block, block, bytes.size() % block};
  std::string all;
  std::vector<Bytef> compressed(compressBound(block));
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    uLongf size = compressed.size();
    if (compress2(compressed.data(), &size, reinterpret_cast<const Bytef*>(bytes.data()) + at,
                  std::min(block, bytes.size() - at), Z_BEST_SPEED) != Z_OK)
      throw std::runtime_error("zlib cannot compress");
    sizes.push_back(size);
    all.append(reinterpret_cast<const char*>(compressed.data()), size);
  }
  append_base64(text, bytes_of(std::span<const std::uint64_t>(sizes)));
  append_base64(text, all);
}

}  // namespace

VtkXml::VtkXml(std::size_t points, std::size_t cells, std::optional<double> t) : cells_(cells) {
  text_ = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
  <UnstructuredGrid>
)";
  if (t) {
    text_ += "    <FieldData>\n";
    add_array(R"(type="Float64" Name="TimeValue" NumberOfTuples="1")", bytes_of(std::span<const double>(&*t, 1)), "s");
    text_ += "    </FieldData>\n";
  }
  text_ += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, cells);
}

void VtkXml::add_array(std::string_view attributes, std::string_view bytes, std::string_view unit) {
  text_ += fmt::format(R"(        <DataArray {} format="appended" offset="{}")", attributes, appended_.size());
  text_ += unit.empty() ? "/>\n"
                        : fmt::format(
                              "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}"
                              "</InformationKey></DataArray>\n",
                              unit);
  append_compressed(appended_, bytes);
}

void VtkXml::add(std::string_view name, int components, std::span<const double> values, std::string_view unit) {
  add_array(fmt::format(R"(type="Float64" Name="{}" NumberOfComponents="{}")", name, components), bytes_of(values),
            unit);
}

void VtkXml::add(std::string_view name, std::span<const std::int32_t> values) {
  add_array(fmt::format(R"(type="Int32" Name="{}" NumberOfComponents="1")", name), bytes_of(values));
}

void VtkXml::add_positions(std::span<const double> positions) {
  text_ += "      <Points>\n";
  add("position", 3, positions, "m");
  text_ += "      </Points>\n";
}

void VtkXml::add_cells(Cell kind, std::span<const std::int64_t> corners) {
  std::vector<std::int64_t> ends(cells_);
  for (std::size_t k = 0; k < cells_; ++k) ends[k] = static_cast<std::int64_t>((k + 1) * (corners.size() / cells_));
  const std::vector<std::uint8_t> kinds(cells_, static_cast<std::uint8_t>(kind));
  text_ += "      <Cells>\n";
  add_array(R"(type="Int64" Name="connectivity")", bytes_of(corners));
  add_array(R"(type="Int64" Name="offsets")", bytes_of(std::span<const std::int64_t>(ends)));
  add_array(R"(type="UInt8" Name="types")", bytes_of(std::span<const std::uint8_t>(kinds)));
  text_ += "      </Cells>\n";
}

std::string VtkXml::text() const {
  return fmt::format(
      "{}    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"base64\">\n_{}\n  </AppendedData>\n"
      "</VTKFile>\n",
      text_, appended_);
}

}  // namespace stillpoint
