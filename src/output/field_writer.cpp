#include "output/field_writer.hpp"

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "output/hdf5_file.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

// --- the text of fields.xdmf ---------------------------------------------------------------------

constexpr std::string_view xdmf_head = R"(<?xml version="1.0"?>
<Xdmf Version="3.0">
  <Domain>
    <Grid Name="run" GridType="Collection" CollectionType="Temporal">
)";
constexpr std::string_view foot = R"(    </Grid>
  </Domain>
</Xdmf>
)";
constexpr std::string_view float64 = R"(NumberType="Float" Precision="8")";
constexpr std::string_view int32 = R"(NumberType="Int" Precision="4")";

std::string grid_begin(std::string_view frame) { return fmt::format(R"(      <Grid Name="{}")", frame); }
constexpr std::string_view grid_end = "      </Grid>\n";

// The text of a frame's grid: single points, and their attributes.
class GridText {
 public:
  GridText(std::string group, double t, std::size_t points, const std::string& vertices)
      : group_(std::move(group)), rows_(fmt::format("{}", points)) {
    text_ = fmt::format(R"({} GridType="Uniform">
        <Time Value="{:.17g}"/>
        <Topology TopologyType="Polyvertex" NumberOfElements="{}" NodesPerElement="1">{}</Topology>
        <Geometry GeometryType="XYZ">{}</Geometry>
)",
                        grid_begin(group_.substr(1)), t, rows_, data_item(rows_, int32, vertices),
                        data_item(rows_ + " 3", float64, group_ + "/place"));
  }
  void add_scalar(const std::string& name, std::string_view number = float64) { add(name, "Scalar", rows_, number); }
  void add_vector(const std::string& name) { add(name, "Vector", rows_ + " 3", float64); }
  std::string text() const { return text_ + std::string(grid_end); }

 private:
  static std::string data_item(const std::string& size, std::string_view number, const std::string& dataset) {
    return fmt::format(R"(<DataItem Dimensions="{}" {} Format="HDF">fields.h5:{}</DataItem>)", size, number, dataset);
  }
  void add(const std::string& name, std::string_view type, const std::string& size, std::string_view number) {
    text_ += fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", name,
                         type, data_item(size, number, fmt::format("{}/{}", group_, name)));
  }

  std::string group_, rows_, text_;
};

std::string frame_name(std::size_t k) { return fmt::format("frame_{:04}", k); }

// Writes the numbers 0 … points − 1, without which ParaView's readers of XDMF 3 show no points.
std::string write_vertices(std::size_t points, Hdf5File& file) {
  std::string name = fmt::format("/vertex/{}", points);
  std::vector<int> numbers(points);
  std::iota(numbers.begin(), numbers.end(), 0);
  file.make_group("/vertex");
  file.write(name, numbers);
  return name;
}

// A tensor becomes scalars. As a Tensor6 its components would have the right names in ParaView's reader of XDMF 2, but
// permuted ones in those of XDMF 3: these take xx, xy, xz, yy, yz, zz for xx, yy, zz, xy, yz, xz.
void write(const PointField& field, const std::string& group, Hdf5File& file, GridText& grid) {
  const auto width = static_cast<std::size_t>(field.components);
  const auto add = [&](const std::string& name, const Columns& columns) {
    const std::string in_group = fmt::format("{}/{}", group, name);
    file.write(in_group, field.values, columns);
    if (!field.unit.empty()) file.write_attribute(in_group, "unit", field.unit);
  };
  if (width == 1) {
    add(field.name, {1, 0, 1, 1});
    grid.add_scalar(field.name);
  } else if (width <= 3) {
    add(field.name, {width, 0, width, 3});
    grid.add_vector(field.name);
  } else {
    const std::vector<std::string> components = stress_names(field.components);
    for (std::size_t k = 0; k < width; ++k) {
      const std::string name = fmt::format("{}_{}", field.name, components[k]);
      add(name, {width, k, 1, 1});
      grid.add_scalar(name);
    }
  }
}

// Writes a frame to the file; returns its text in fields.xdmf.
std::string write(const FieldFrame& frame, const std::string& group, Hdf5File& file) {
  file.make_group(group);
  file.write_attribute(group, "t", frame.t);
  file.write_attribute(group, "t_unit", std::string("s"));
  file.write_attribute(group, "dim", frame.dim);
  GridText grid(group, frame.t, frame.points, write_vertices(frame.points, file));
  const auto dim = static_cast<std::size_t>(frame.dim);
  file.write(group + "/place", frame.position, {dim, 0, dim, 3});
  file.write_attribute(group + "/place", "unit", std::string("m"));
  for (const PointField& field : frame.fields) write(field, group, file, grid);
  if (!frame.material.empty()) {
    file.write(group + "/material", frame.material);
    grid.add_scalar("material", int32);
  }
  return grid.text();
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw fs::filesystem_error("cannot read", path, std::make_error_code(std::errc::io_error));
  return text;
}

void remove_quietly(const fs::path& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

}  // namespace

FieldWriter::FieldWriter(const fs::path& folder, std::size_t frames) : folder_(folder), frames_(frames) {
  if (frames == 0) fs::remove_all(parts());
  fs::create_directories(parts());
  // A run that is killed while it removes the parts may leave only one of a frame's two files.
  for (std::size_t k = 0; k < frames; ++k) {
    if (!fs::exists(part(k)) || !fs::exists(part(k).replace_extension(".xdmf"))) split(k);
  }
}

fs::path FieldWriter::part(std::size_t k) const { return parts() / (frame_name(k) + ".h5"); }

void FieldWriter::add(const FieldFrame& frame) {
  if (finished_) throw std::logic_error("add() after finish()");
  validate(frame);
  const fs::path partial = partial_name(part(frames_));
  try {
    Hdf5File file(partial);
    const std::string text = write(frame, "/" + frame_name(frames_), file);
    file.close();
    AtomicFile xdmf(part(frames_).replace_extension(".xdmf"));
    xdmf.write(text);
    xdmf.finish();
  } catch (...) {
    remove_quietly(partial);
    throw;
  }
  fs::rename(partial, part(frames_));
  ++frames_;
}

void FieldWriter::finish() {
  if (finished_) return;
  const fs::path whole = folder_ / "fields.h5";
  try {
    join(partial_name(whole));
    AtomicFile xdmf(folder_ / "fields.xdmf");
    xdmf.write(xdmf_head);
    for (std::size_t k = 0; k < frames_; ++k) xdmf.write(text_of(part(k).replace_extension(".xdmf")));
    xdmf.write(foot);
    fs::rename(partial_name(whole), whole);  // before fields.xdmf, which refers to it
    xdmf.finish();
  } catch (...) {
    remove_quietly(partial_name(whole));
    throw;
  }
  remove_quietly(parts());
  finished_ = true;
}

void FieldWriter::join(const fs::path& name) const {
  Hdf5File whole(name);
  whole.make_group("/vertex");
  std::set<std::string> vertices;
  for (std::size_t k = 0; k < frames_; ++k) {
    const Hdf5File of_frame(Hdf5File::Existing{part(k)});
    whole.copy(of_frame, "/" + frame_name(k));
    for (const std::string& points : of_frame.names_in("/vertex")) {
      if (vertices.insert(points).second) whole.copy(of_frame, "/vertex/" + points);
    }
  }
  whole.close();
}

// Takes frame k out of the joined files again, for a run that has joined its frames and is continued.
void FieldWriter::split(std::size_t k) const {
  const std::string begin = grid_begin(frame_name(k)), xdmf = text_of(folder_ / "fields.xdmf");
  const std::size_t from = xdmf.find(begin), to = xdmf.find(grid_end, std::min(from, xdmf.size()));
  if (to == std::string::npos)
    throw StateError(fmt::format("{}: frame {} is not there; the run goes on after {} of them",
                                 (folder_ / "fields.xdmf").string(), k, frames_));
  AtomicFile text(part(k).replace_extension(".xdmf"));
  text.write(std::string_view(xdmf).substr(from, to + grid_end.size() - from));
  text.finish();
  const Hdf5File whole(Hdf5File::Existing{folder_ / "fields.h5"});
  const fs::path partial = partial_name(part(k));
  Hdf5File of_frame(partial);
  of_frame.make_group("/vertex");
  of_frame.copy(whole, "/" + frame_name(k));
  const std::size_t vertex = xdmf.find("/vertex/", from);
  of_frame.copy(whole, xdmf.substr(vertex, xdmf.find('<', vertex) - vertex));
  of_frame.close();
  fs::rename(partial, part(k));
}

}  // namespace stillpoint
