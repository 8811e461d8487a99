#include "output/vtu_writer.hpp"

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "output/vtk_xml.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* files_folder = "fields_vtu";
constexpr std::string_view collection_begin = R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">
  <Collection>
)";
constexpr std::string_view collection_end = "  </Collection>\n</VTKFile>\n";
constexpr std::string_view entry_begin = "    <DataSet ";

/// (rows × width) as (rows × 3), 0 beyond width.
std::vector<double> three_columns(std::span<const double> values, std::size_t width) {
  std::vector<double> columns(values.size() / width * 3, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) columns[k / width * 3 + k % width] = values[k];
  return columns;
}

/// Tensors with the components xx, yy, zz, xy and in space yz, zx, in full.
std::vector<double> full_tensors(std::span<const double> values, std::size_t components) {
  std::vector<double> tensors(values.size() / components * 9, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto [i, j] = tensor_places[k % components];
    double* const tensor = &tensors[k / components * 9];
    tensor[3 * i + j] = tensor[3 * j + i] = values[k];
  }
  return tensors;
}

void add_field(VtkXml& file, const PointField& field) {
  const auto width = static_cast<std::size_t>(field.components);
  if (width == 1) return file.add(field.name, 1, field.values, field.unit);
  if (width <= 3) return file.add(field.name, 3, three_columns(field.values, width), field.unit);
  file.add(field.name, 9, full_tensors(field.values, width), field.unit);
}

std::string points_file(const FieldFrame& frame) {
  VtkXml file(frame.points, frame.points, frame.t);
  file.begin_point_data();
  for (const PointField& field : frame.fields) add_field(file, field);
  if (!frame.material.empty()) file.add("material", frame.material);
  file.end_point_data();
  file.add_positions(three_columns(frame.position, static_cast<std::size_t>(frame.dim)));
  std::vector<std::int64_t> numbers(frame.points);
  std::iota(numbers.begin(), numbers.end(), 0);
  file.add_cells(VtkXml::Cell::vertex, numbers);
  return file.text();
}

/// Nodes and cells are counted along x first.
std::string grid_file(const std::vector<std::vector<double>>& lines) {
  constexpr std::array kinds = {VtkXml::Cell::line, VtkXml::Cell::quadrilateral, VtkXml::Cell::hexahedron};
  // A cell's corners in VTK's order: around its lower face, and around the upper one.
  constexpr std::array<std::array<std::size_t, 3>, 8> around{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  const std::size_t dim = lines.size(), corners = std::size_t{1} << dim;
  std::array<std::size_t, 3> nodes{1, 1, 1}, cells{1, 1, 1};
  for (std::size_t d = 0; d < dim; ++d) nodes[d] = lines[d].size(), cells[d] = nodes[d] - 1;

  std::vector<double> positions;
  positions.reserve(3 * nodes[0] * nodes[1] * nodes[2]);
  std::vector<std::int64_t> of_cells;
  of_cells.reserve(corners * cells[0] * cells[1] * cells[2]);
  for (std::size_t k = 0; k < nodes[2]; ++k)
    for (std::size_t j = 0; j < nodes[1]; ++j)
      for (std::size_t i = 0; i < nodes[0]; ++i) {
        positions.push_back(lines[0][i]);
        positions.push_back(dim > 1 ? lines[1][j] : 0);
        positions.push_back(dim > 2 ? lines[2][k] : 0);
      }
  for (std::size_t k = 0; k < cells[2]; ++k)
    for (std::size_t j = 0; j < cells[1]; ++j)
      for (std::size_t i = 0; i < cells[0]; ++i)
        for (std::size_t corner = 0; corner < corners; ++corner) {
          const auto [di, dj, dk] = around[corner];
          of_cells.push_back(static_cast<std::int64_t>(((k + dk) * nodes[1] + j + dj) * nodes[0] + i + di));
        }

  VtkXml file(positions.size() / 3, of_cells.size() / corners);
  file.add_positions(positions);
  file.add_cells(kinds[dim - 1], of_cells);
  return file.text();
}

std::string bytes_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Leaves nothing of a file that cannot be written whole.
void write_whole(const fs::path& path, std::string_view text) {
  try {
    write_file(path, text);
  } catch (...) {
    std::error_code ignored;
    fs::remove(partial_name(path), ignored);
    throw;
  }
}

}  // namespace

VtuWriter::VtuWriter(const fs::path& folder, std::size_t frames) : folder_(folder) {
  if (frames == 0) {
    fs::remove_all(folder / files_folder);
    for (const Collection* collection : {&points_, &grids_}) fs::remove(folder / collection->name);
  }
  fs::create_directories(folder / files_folder);
  for (Collection* collection : {&points_, &grids_}) keep(*collection, frames);
}

// Those of a run that went further than the checkpoint from which it is continued are written anew.
void VtuWriter::keep(Collection& collection, std::size_t frames) const {
  std::ifstream file(folder_ / collection.name);
  for (std::string line; std::getline(file, line) && collection.entries.size() < frames;)
    if (line.starts_with(entry_begin)) collection.entries.push_back(std::move(line));
  if (collection.entries.size() < frames)
    throw StateError(fmt::format("{}: frame {} is not there; the run goes on after {} of them",
                                 (folder_ / collection.name).string(), collection.entries.size(), frames));
}

void VtuWriter::add(Collection& collection, double t, const std::string& file) const {
  collection.entries.push_back(fmt::format("{}timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>", entry_begin, t, file));
  write_whole(folder_ / collection.name,
              fmt::format("{}{}\n{}", collection_begin, fmt::join(collection.entries, "\n"), collection_end));
}

// The file of a grid has no time in it, so that a run that is continued knows that of the frame before by its bytes.
std::string VtuWriter::write_grid(const std::vector<std::vector<double>>& lines, std::size_t k) const {
  const std::string text = grid_file(lines);
  if (!grids_.entries.empty()) {
    const std::string& entry = grids_.entries.back();
    const std::size_t from = entry.find(files_folder), to = entry.find('"', std::min(from, entry.size()));
    std::string before = entry.substr(std::min(from, entry.size()), to - from);
    if (bytes_in(folder_ / before) == text) return before;
  }
  std::string name = fmt::format("{}/grid_{:04}.vtu", files_folder, k);
  write_whole(folder_ / name, text);
  return name;
}

void VtuWriter::add(const FieldFrame& frame) {
  validate(frame);
  const std::size_t k = points_.entries.size();
  const std::string points = fmt::format("{}/points_{:04}.vtu", files_folder, k);
  write_whole(folder_ / points, points_file(frame));
  if (!frame.grid_lines.empty()) {
    if (frame.grid_lines != lines_) grid_ = write_grid(frame.grid_lines, k);
    lines_ = frame.grid_lines;
    add(grids_, frame.t, grid_);
  }
  add(points_, frame.t, points);
}

}  // namespace stillpoint
