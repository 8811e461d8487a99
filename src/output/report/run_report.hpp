// The report of a run: its verdict, the picture of its body, its history, its model and its scene.
#pragma once

#include <stillpoint/scene.hpp>
#include <stillpoint/summary.hpp>

#include <filesystem>
#include <optional>
#include <string>

#include "base/json.hpp"
#include "output/report/body_picture.hpp"

namespace stillpoint {

/// The part of history.csv that a report draws: {columns: […], rows: "t,steps,…\n…", of: number of all rows}, or null
/// if there is no file. If there are more rows than a report has room for, it has those at which some column is largest
/// or smallest among its neighbours, so that oscillating columns keep their envelope.
Json history_excerpt(const std::filesystem::path& history_csv);

/// Draws the frames of fields.h5 if there are any, otherwise the first and the last state of the run. Of a run with
/// stages the frames of the last one, or its last state.
class RunReport {
 public:
  /// folder: the folder of the run; empty if there is no report. The scene has to outlive this object.
  RunReport(const Scene& scene, std::filesystem::path folder);

  /// Whether begin() and end() are to be called.
  bool looks_at_body() const;
  void begin(const BodyMoment& moment);
  void end(const BodyMoment& moment);
  /// The text of report.html, once history.csv and the fields are there. Throws std::filesystem::filesystem_error if
  /// they cannot be read.
  std::string page(const Summary& summary) const;

 private:
  Json picture(const Summary& summary) const;
  template <class Draw>
  void draw_if_memory_is_left(const Draw& draw);

  const Scene& scene_;
  std::filesystem::path folder_;
  std::optional<BodyPicture> picture_;
  bool lacks_memory_ = false;
};

}  // namespace stillpoint
