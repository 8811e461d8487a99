// An XML file of VTK's with an unstructured grid [The VTK User's Guide, file formats]. Its arrays are compressed by
// zlib in blocks, and stand in base64 behind the description of the grid, so that any reader of XML takes the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stillpoint {

class VtkXml {
 public:
  /// The kinds of cells, by VTK's numbers.
  enum class Cell : std::uint8_t { vertex = 1, line = 3, quadrilateral = 9, hexahedron = 12 };

  /// A grid of so many points and cells; t: its time [s].
  VtkXml(std::size_t points, std::size_t cells, std::optional<double> t = {});

  /// What follows is a field at the points. In this order: fields, positions, cells.
  void begin_point_data() { text_ += "      <PointData>\n"; }
  void add(std::string_view name, int components, std::span<const double> values, std::string_view unit = {});
  void add(std::string_view name, std::span<const std::int32_t> values);
  void end_point_data() { text_ += "      </PointData>\n"; }
  /// (points × 3) [m].
  void add_positions(std::span<const double> positions);
  /// All of one kind; corners: the numbers of their points, (cells × corners of the kind).
  void add_cells(Cell kind, std::span<const std::int64_t> corners);

  /// The whole file.
  std::string text() const;

 private:
  void add_array(std::string_view attributes, std::string_view bytes, std::string_view unit = {});

  std::size_t cells_;
  std::string text_, appended_;
};

}  // namespace stillpoint
