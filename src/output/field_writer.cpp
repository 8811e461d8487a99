#include "output/field_writer.hpp"

#include <array>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "output/hdf5_file.hpp"

namespace stillpoint {
namespace {

constexpr std::array plane_tensor = {"xx", "yy", "zz", "xy"};

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("a frame of fields: " + what); }

bool is_word(const std::string& name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return !name.empty() && name.find_first_not_of(letters) == std::string::npos;
}

void validate(const FieldFrame& frame) {
  if (frame.points == 0) refuse("no points");
  if (frame.dim < 1 || frame.dim > 3) refuse(fmt::format("dimension {}", frame.dim));
  const auto expect = [](const std::string& name, std::size_t size, std::size_t expected) {
    if (size != expected) refuse(fmt::format("{} has {} values, expected {}", name, size, expected));
  };
  expect("place", frame.position.size(), frame.points * static_cast<std::size_t>(frame.dim));
  if (!frame.material.empty()) expect("material", frame.material.size(), frame.points);
  std::set<std::string> names = {"place", "material"};
  for (const PointField& field : frame.fields) {
    if (!is_word(field.name)) refuse(fmt::format("'{}' is no name of a field", field.name));
    if (!names.insert(field.name).second) refuse(fmt::format("there is more than one '{}'", field.name));
    if (field.components < 1 || field.components > 4) {
      refuse(fmt::format("{} has {} components, expected 1 to 4", field.name, field.components));
    }
    expect(field.name, field.values.size(), frame.points * static_cast<std::size_t>(field.components));
  }
}

// --- the text of fields.xdmf ---------------------------------------------------------------------

constexpr std::string_view head = R"(<?xml version="1.0"?>
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

// A frame's grid: single points, and their attributes.
class GridText {
 public:
  GridText(std::string group, double t, std::size_t points, const std::string& vertices)
      : group_(std::move(group)), rows_(fmt::format("{}", points)) {
    text_ = fmt::format(R"(      <Grid Name="{}" GridType="Uniform">
        <Time Value="{:.17g}"/>
        <Topology TopologyType="Polyvertex" NumberOfElements="{}" NodesPerElement="1">{}</Topology>
        <Geometry GeometryType="XYZ">{}</Geometry>
)",
                        group_.substr(1), t, rows_, data_item(rows_, int32, vertices),
                        data_item(rows_ + " 3", float64, group_ + "/place"));
  }
  void add_scalar(const std::string& name, std::string_view number = float64) { add(name, "Scalar", rows_, number); }
  void add_vector(const std::string& name) { add(name, "Vector", rows_ + " 3", float64); }
  std::string text() const { return text_ + "      </Grid>\n"; }

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

// Removed at the end, unless it got its final name.
class Temporary {
 public:
  explicit Temporary(std::filesystem::path path) : path_(std::move(path)) {}
  ~Temporary() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  const std::filesystem::path& path() const { return path_; }
  void keep() { path_.clear(); }

 private:
  std::filesystem::path path_;
};

}  // namespace

// The temporaries stand before the files, which are closed before those are removed.
class FieldWriter::Files {
 public:
  explicit Files(const std::filesystem::path& folder)
      : hdf5_name_(folder / "fields.h5"),
        xdmf_partial_(partial_name(folder / "fields.xdmf")),
        xdmf_(folder / "fields.xdmf"),  // before the other: what is wrong with the folder shows here
        hdf5_partial_(partial_name(hdf5_name_)),
        hdf5_(hdf5_partial_.path()) {
    hdf5_.make_group("/vertex");
    xdmf_.write(head);
  }

  // A frame is there as a whole or not at all.
  void add(const FieldFrame& frame) {
    const std::string group = fmt::format("/frame_{:04}", frames_);
    try {
      xdmf_.write(write(frame, group));
    } catch (...) {
      hdf5_.remove(group);
      if (!counted_.contains(frame.points)) hdf5_.remove(vertices_name(frame.points));
      throw;
    }
    ++frames_;
  }

  void finish() {
    xdmf_.write(foot);
    hdf5_.close();
    std::filesystem::rename(hdf5_partial_.path(), hdf5_name_);  // before the other, which refers to it
    hdf5_partial_.keep();
    xdmf_.finish();
    xdmf_partial_.keep();
  }

 private:
  std::string write(const FieldFrame& frame, const std::string& group) {
    hdf5_.make_group(group);
    hdf5_.write_attribute(group, "t", frame.t);
    hdf5_.write_attribute(group, "dim", frame.dim);
    GridText grid(group, frame.t, frame.points, vertices(frame.points));
    const auto dim = static_cast<std::size_t>(frame.dim);
    hdf5_.write(group + "/place", frame.position, {dim, 0, dim, 3});
    for (const PointField& field : frame.fields) write(field, group, grid);
    if (!frame.material.empty()) {
      hdf5_.write(group + "/material", frame.material);
      grid.add_scalar("material", int32);
    }
    hdf5_.flush();
    return grid.text();
  }

  // A stress becomes scalars. As a Tensor6 its components would have the right names in ParaView's reader of XDMF 2,
  // and one another's in those of XDMF 3: these take xx, xy, xz, yy, yz, zz for xx, yy, zz, xy, yz, xz.
  void write(const PointField& field, const std::string& group, GridText& grid) {
    const auto width = static_cast<std::size_t>(field.components);
    const auto in_group = [&](const std::string& name) { return fmt::format("{}/{}", group, name); };
    if (width == 1) {
      hdf5_.write(in_group(field.name), field.values, {1, 0, 1, 1});
      grid.add_scalar(field.name);
    } else if (width <= 3) {
      hdf5_.write(in_group(field.name), field.values, {width, 0, width, 3});
      grid.add_vector(field.name);
    } else {
      for (std::size_t k = 0; k < width; ++k) {
        const std::string name = fmt::format("{}_{}", field.name, plane_tensor[k]);
        hdf5_.write(in_group(name), field.values, {width, k, 1, 1});
        grid.add_scalar(name);
      }
    }
  }

  // 0 … points − 1. ParaView's readers of XDMF 3 show no points without it.
  static std::string vertices_name(std::size_t points) { return fmt::format("/vertex/{}", points); }
  std::string vertices(std::size_t points) {
    std::string name = vertices_name(points);
    if (!counted_.contains(points)) {
      std::vector<int> numbers(points);
      std::iota(numbers.begin(), numbers.end(), 0);
      hdf5_.write(name, numbers);
      counted_.insert(points);
    }
    return name;
  }

  std::filesystem::path hdf5_name_;
  Temporary xdmf_partial_;
  AtomicFile xdmf_;
  Temporary hdf5_partial_;
  Hdf5File hdf5_;
  std::size_t frames_ = 0;
  std::set<std::size_t> counted_;  // the numbers of points that /vertex has
};

FieldWriter::FieldWriter(const std::filesystem::path& folder) : files_(std::make_unique<Files>(folder)) {}

FieldWriter::~FieldWriter() = default;

void FieldWriter::add(const FieldFrame& frame) {
  if (!files_) throw std::logic_error("add() after finish()");
  validate(frame);
  files_->add(frame);
}

void FieldWriter::finish() {
  if (!files_) return;
  files_->finish();
  files_.reset();
}

}  // namespace stillpoint
