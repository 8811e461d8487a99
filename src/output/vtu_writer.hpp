// fields.pvd and grid.pvd: the material points and the background grid at some times of a run, each in a file of VTK's,
// for ParaView, VTK and meshio.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "output/field_frame.hpp"

namespace stillpoint {

/// Writes frame by frame. The points of frame k are fields_vtu/points_000k.vtu, vertices with the fields of FieldFrame
/// by name: scalars, vectors of 3 components (0 beyond dim), and tensors of 9, row by row. The grid is
/// fields_vtu/grid_000k.vtu where it differs from that of the frame before. Equal frames give equal bytes.
///
/// Each file is complete or absent, and the two collections list those that are there, so that a killed process or a
/// full disk leaves all earlier frames. The constructor creates the folder if need be. The constructor and add() throw
/// std::filesystem::filesystem_error if a file cannot be written.
class VtuWriter {
 public:
  /// frames: the number of frames that a continued run keeps; later ones are removed. Throws StateError if they are
  /// absent.
  explicit VtuWriter(const std::filesystem::path& folder, std::size_t frames = 0);
  VtuWriter(const VtuWriter&) = delete;
  VtuWriter& operator=(const VtuWriter&) = delete;

  /// Throws std::invalid_argument for a frame whose parts have other shapes; nothing is written then.
  void add(const FieldFrame& frame);

 private:
  /// A collection's entries, a line each.
  struct Collection {
    std::string name;
    std::vector<std::string> entries{};
  };
  void keep(Collection& collection, std::size_t frames) const;
  void add(Collection& collection, double t, const std::string& file) const;
  std::string write_grid(const std::vector<std::vector<double>>& lines, std::size_t k) const;

  std::filesystem::path folder_;
  Collection points_{"fields.pvd"}, grids_{"grid.pvd"};
  std::vector<std::vector<double>> lines_;  // of the grid in the last frame
  std::string grid_;                        // and its file
};

}  // namespace stillpoint
