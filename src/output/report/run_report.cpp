#include "output/report/run_report.hpp"

#include <new>
#include <string>
#include <utility>
#include <vector>

#include "output/hdf5_file.hpp"
#include "output/report/report_page.hpp"

namespace stillpoint {
namespace {

Json stored_picture(const GridSpec& grid, const std::filesystem::path& fields_h5) {
  const Hdf5File fields(Hdf5File::Existing{fields_h5});
  std::vector<std::string> frames = fields.names_in("/");
  std::erase_if(frames, [](const std::string& name) { return !name.starts_with("frame_"); });
  if (frames.empty()) return nullptr;
  const BodyMoment first = moment_of(fields, frames.front());
  const std::vector<std::size_t> drawn = drawn_moments(first, frames.size());
  std::vector<std::vector<double>> at = {first.field("position")};
  if (first.dim == 3) at.push_back(moment_of(fields, frames.back()).field("position"));
  BodyPicture picture(grid, first, drawn.size(), at);
  for (const std::size_t k : drawn) picture.add(moment_of(fields, frames[k]));
  Json json = picture.json();
  json["of_moments"] = frames.size();
  return json;
}

}  // namespace

RunReport::RunReport(const Scene& scene, std::filesystem::path folder) : scene_(scene), folder_(std::move(folder)) {}

bool RunReport::looks_at_body() const {
  return !folder_.empty() && scene_.output.snapshots.empty() && scene_.output.fields_every <= 0;
}

// A run that has reached its end must not fail because there is no memory for a picture.
template <class Draw>
void RunReport::draw_if_memory_is_left(const Draw& draw) {
  try {
    if (!lacks_memory_) draw();
  } catch (const std::bad_alloc&) {
    lacks_memory_ = true;
    picture_.reset();
  }
}

void RunReport::begin(const BodyMoment& moment) {
  draw_if_memory_is_left([&] {
    picture_.emplace(scene_.grid, moment, 2, std::vector<std::vector<double>>{moment.field("position")});
    picture_->add(moment);
  });
}

void RunReport::end(const BodyMoment& moment) {
  draw_if_memory_is_left([&] { picture_->add(moment); });
}

Json RunReport::picture() const {
  if (picture_) return picture_->json();
  if (lacks_memory_) return nullptr;
  const std::filesystem::path fields_h5 = folder_ / "fields.h5";
  return std::filesystem::exists(fields_h5) ? stored_picture(scene_.grid, fields_h5) : Json();
}

std::string RunReport::page(const Summary& summary) const {
  const StopSpec& stop = scene_.stop;
  return report_page(
      summary.title.empty() ? summary.scene : summary.title,
      {{"kind", "run"},
       {"summary", Json::parse(to_json(summary))},
       {"goals", {{"residual", stop.residual}, {"distance", stop.distance.value()}, {"time", stop.time}}},
       {"history", history_excerpt(folder_ / "history.csv")},
       {"picture", picture()},
       {"lacks_memory", lacks_memory_},
       {"scene", {{"text", scene_.text}, {"set", scene_.overrides}}}});
}

}  // namespace stillpoint
