#include "output/report/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "output/hdf5_file.hpp"
#include "output/report/report_page.hpp"
#include "output/snapshots.hpp"

namespace stillpoint {
namespace {

// Of a run with stages the frames from when the last one began, whose points are the same.
Json stored_picture(const GridSpec& grid, const std::filesystem::path& fields_h5, double from) {
  const Hdf5File fields(Hdf5File::Existing{fields_h5});
  std::vector<std::string> frames = fields.names_in("/");
  std::erase_if(frames, [](const std::string& name) { return !name.starts_with("frame_"); });
  std::erase_if(frames, [&](const std::string& name) { return fields.read_attribute(name, "t") < from; });
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

constexpr std::size_t most_cells = 40'000;  // about eight bytes each

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::size_t from = 0;
  for (std::size_t comma; (comma = line.find(',', from)) != std::string::npos; from = comma + 1)
    words.push_back(line.substr(from, comma - from));
  words.push_back(line.substr(from));
  return words;
}

using Row = std::vector<double>;

Row row_of(const std::string& line, std::size_t columns) {
  Row row;
  row.reserve(columns);
  const char* at = line.c_str();
  while (row.size() < columns) {
    char* end = nullptr;
    row.push_back(std::strtod(at, &end));
    if (*end != ',') break;
    at = end + 1;
  }
  row.resize(columns, 0.0);
  return row;
}

// Writes the rows of extreme values among some consecutive rows.
void write_extremes(const std::vector<Row>& rows, std::string& text) {
  std::set<std::size_t> kept;
  for (std::size_t k = 0; !rows.empty() && k < rows.front().size(); ++k) {
    const auto [least, most] = std::ranges::minmax_element(rows, {}, [k](const Row& row) { return row[k]; });
    kept.insert(static_cast<std::size_t>(least - rows.begin()));
    kept.insert(static_cast<std::size_t>(most - rows.begin()));
  }
  for (const std::size_t number : kept) {
    for (const double value : rows[number]) fmt::format_to(std::back_inserter(text), "{:.8g},", value);
    text.back() = '\n';
  }
}

}  // namespace

RunReport::RunReport(const Scene& scene, std::filesystem::path folder) : scene_(scene), folder_(std::move(folder)) {}

bool RunReport::looks_at_body() const { return !folder_.empty() && !writes_fields(scene_.output, "xdmf"); }

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
  if (!scene_.stages.empty()) return begin(moment);  // the points of the first stage are others
  draw_if_memory_is_left([&] { picture_->add(moment); });
}

Json RunReport::picture(const Summary& summary) const {
  if (picture_) return picture_->json();
  if (lacks_memory_) return nullptr;
  const std::filesystem::path fields_h5 = folder_ / "fields.h5";
  // A frame at the end of a stage is the last one with its points.
  const double none = -std::numeric_limits<double>::infinity();
  const double from = summary.stages.empty() ? none : std::nextafter(summary.stages.back().end, summary.t);
  return std::filesystem::exists(fields_h5) ? stored_picture(scene_.grid, fields_h5, from) : Json();
}

std::string RunReport::page(const Summary& summary) const {
  const StopSpec& stop = scene_.stop;
  return report_page(
      summary.title.empty() ? summary.scene : summary.title,
      {{"kind", "run"},
       {"summary", Json::parse(to_json(summary))},
       {"goals", {{"residual", stop.residual}, {"distance", stop.distance.value()}, {"time", stop.time}}},
       {"history", history_excerpt(folder_ / "history.csv")},
       {"picture", picture(summary)},
       {"lacks_memory", lacks_memory_},
       {"scene", {{"text", scene_.text}, {"set", scene_.overrides}}}});
}

Json history_excerpt(const std::filesystem::path& history_csv) {
  std::ifstream file(history_csv);
  std::string line;
  if (!std::getline(file, line)) return nullptr;
  const std::vector<std::string> columns = words_of(line);
  const std::streampos begin = file.tellg();
  std::size_t all = 0;
  while (std::getline(file, line)) ++all;
  file.clear();
  file.seekg(begin);

  const bool has_room = all * columns.size() <= most_cells;
  const std::size_t groups = std::max<std::size_t>(1, most_cells / (2 * columns.size() * columns.size()));
  const std::size_t at_once = has_room ? 1 : (all + groups - 1) / groups;
  std::string text;
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    rows.push_back(row_of(line, columns.size()));
    if (rows.size() < at_once) continue;
    write_extremes(rows, text);
    rows.clear();
  }
  write_extremes(rows, text);
  return {{"columns", columns}, {"rows", text}, {"of", all}};
}

}  // namespace stillpoint
