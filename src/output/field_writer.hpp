// fields.h5 and fields.xdmf: the material points at some times of a run, for ParaView and for scripts.
#pragma once

#include <cstddef>
#include <filesystem>

#include "output/field_frame.hpp"

namespace stillpoint {

/// Writes frame by frame. Frame k of fields.h5 is the group /frame_000k with the attributes t and dim: `place` and
/// every vector in 3 columns (0 beyond dim), scalars in one, and a tensor's components as scalars NAME_xx, NAME_yy, …,
/// each with the attribute `unit` where it has one; /vertex/P counts 0 … P − 1 for frames of P points. fields.xdmf
/// makes each dataset an attribute of the same name. Equal frames give equal bytes.
///
/// Until finish() each frame is a file of its own below fields.partial/, complete or absent, so that a killed process
/// or a full disk leaves all earlier frames. The constructor creates the folder if need be. The constructor, add() and
/// finish() throw std::filesystem::filesystem_error if a file cannot be written, with HDF5's message if it comes from
/// HDF5.
class FieldWriter {
 public:
  /// frames: the number of frames that a continued run keeps; later ones are written anew. Throws StateError if they
  /// are absent.
  explicit FieldWriter(const std::filesystem::path& folder, std::size_t frames = 0);
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  /// Throws std::invalid_argument for a frame whose parts do not have the shapes above; nothing is written then.
  void add(const FieldFrame& frame);
  /// Joins the frames. Has to be called at the end of every run, also of one that failed.
  void finish();

 private:
  // Each frame has a file of its own, with its text for ParaView beside it. These are not touched again before all of
  // them are joined: whatever happens then, they are there.
  std::filesystem::path parts() const { return folder_ / "fields.partial"; }
  std::filesystem::path part(std::size_t k) const;
  void join(const std::filesystem::path& name) const;
  void split(std::size_t k) const;

  std::filesystem::path folder_;
  std::size_t frames_;
  bool finished_ = false;
};

}  // namespace stillpoint
