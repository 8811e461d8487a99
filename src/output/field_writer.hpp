// fields.h5 and fields.xdmf: the material points at some times of a run, for ParaView and for scripts.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

/// A field at the points, (points × components) row by row. ParaView sees 1 component as a scalar, 2 or 3 as a vector,
/// and the 4 of a stress in the plane or the 6 of one in space, xx, yy, zz, xy, yz, zx, as scalars NAME_xx, NAME_yy, ….
struct PointField {
  std::string name;  // letters, digits and _
  int components;
  std::vector<double> values;
};

/// What the points are like at time t [s].
struct FieldFrame {
  double t;
  int dim;
  std::size_t points;            // > 0
  std::vector<double> position;  // (points × dim) [m], deformed
  std::vector<PointField> fields;
  std::vector<int> material;  // (points), or empty: not written
};

/// Writes frame by frame. Frame k of fields.h5 is the group /frame_000k with the attributes t and dim: `place` and
/// every vector in 3 columns (0 beyond dim), scalars in one; /vertex/P counts 0 … P − 1 for frames of P points.
/// fields.xdmf makes each dataset an attribute of the same name. Equal frames give equal bytes.
///
/// Until finish() each frame is a file of its own below fields.partial/, whole or not there, so that a killed process
/// or a full disk leaves all frames before. The constructor creates the folder if need be. It, add() and finish() throw
/// std::filesystem::filesystem_error if a file cannot be written, in HDF5's words if it is HDF5 that cannot.
class FieldWriter {
 public:
  /// frames: those of a run that goes on, which are there; what comes after them is written anew. StateError if they
  /// are not.
  explicit FieldWriter(const std::filesystem::path& folder, std::size_t frames = 0);
  ~FieldWriter();
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  /// Throws std::invalid_argument for a frame whose parts are not of the shapes above; nothing is written then.
  void add(const FieldFrame& frame);
  std::size_t frames() const;
  /// Joins the frames. To be called at the end of every run, and of one that went wrong, too.
  void finish();

 private:
  class Files;
  std::unique_ptr<Files> files_;  // none after finish()
};

}  // namespace stillpoint
