#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "output/report/body_picture.hpp"
#include "output/report/report_page.hpp"
#include "output/report/run_report.hpp"
#include "scene/grid_lines.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

// A cube of points, `side` of them along each axis and two in a cell, that is drawn out along x.
BodyMoment cube(int side, double stretch) {
  std::vector<double> x;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k)
        for (const int along : {i, j, k}) x.push_back(0.25 + 0.5 * along);
  const std::size_t points = x.size() / 3;
  return {.t = stretch, .dim = 3, .points = points, .history_names = {}, .field = [=](const std::string& name) {
            if (name == "stress") return std::vector<double>(6 * points, std::nan(""));
            std::vector<double> values(3 * points, 0.0);
            if (name == "v") return values;
            for (std::size_t p = 0; p < points; ++p) values[3 * p] = stretch * x[3 * p];
            if (name == "position") std::ranges::transform(values, x, values.begin(), std::plus<>());
            return values;
          }};
}

GridSpec grid(int cells) {
  return {.min = {0, 0, 0}, .max = std::vector<double>(3, cells), .cells = std::vector<int>(3, cells), .follow = ""};
}

// What the page makes of a column of numbers.
std::vector<double> decoded(const std::string& text, double min, double max) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<double> values;
  for (std::size_t k = 0; k < text.size(); k += 2) {
    const auto code = 64 * digits.find(text[k]) + digits.find(text[k + 1]);
    values.push_back(code == 4095 ? std::nan("") : min + (max - min) * static_cast<double>(code) / 4094);
  }
  return values;
}

}  // namespace

TEST_CASE(
    "the picture of a report has positions and fields to a four-thousandth of their range, and what is no number") {
  BodyPicture picture(grid(1), cube(2, 0), 2, {cube(2, 0).field("position")});
  for (const double stretch : {0.0, 0.3}) picture.add(cube(2, stretch));
  const Json json = picture.json();
  const auto& x = json["x"][0];
  const std::vector<double> along = decoded(x["values"], x["min"], x["max"]);
  const auto& field = json["fields"][0];
  REQUIRE(field["name"] == "u.x");
  const std::vector<double> u = decoded(json["moments"][1]["values"][0], field["min"], field["max"]);
  REQUIRE(u.size() == 8);
  for (std::size_t p = 0; p < 8; ++p) {
    CHECK(along[p] == Approx(p < 4 ? 0.25 : 0.75).margin(0.5 / 4094));
    CHECK(u[p] == Approx(0.3 * (p < 4 ? 0.25 : 0.75)).margin(0.225 / 4094));
  }
  REQUIRE(json["fields"][4]["name"] == "stress.xx");
  CHECK(json["fields"][4]["min"].is_null());
  CHECK(json["moments"][0]["values"][4] == "////////////////");
}

TEST_CASE("where cells are unequal the points of a picture are drawn as large as those that they are in") {
  GridSpec unequal;
  unequal.pieces = {{{{0, 1, 2}, {1, 2, 1}}, {{0, 2, 2}}, {{0, 2, 4}}}};  // along x 0.5, 0.5 and 1, the mean 2/3
  take_extent_of_pieces(unequal);
  const BodyMoment body = cube(4, 0);
  BodyPicture picture(unequal, body, 1, {body.field("position")});
  picture.add(body);
  const Json json = picture.json();
  REQUIRE(json["sizes"].size() == 3);
  const auto column = [&](const char* name, std::size_t k) {
    const auto& coded = json[name][k];
    return decoded(coded["values"], coded["min"], coded["max"]);
  };
  const std::vector<double> x = column("x", 0), along_x = column("sizes", 0), along_y = column("sizes", 1);
  REQUIRE(x.size() == 64);
  for (std::size_t p = 0; p < x.size(); ++p) {
    CHECK(along_x[p] == Approx(x[p] < 1 ? 0.75 : 1.5).margin(1e-3));
    CHECK(along_y[p] == Approx(1));
  }
  BodyPicture plain(grid(2), body, 1, {body.field("position")});
  CHECK_FALSE(plain.json().contains("sizes"));
}

TEST_CASE("in space the picture of a report has the points of the cells at the surface alone") {
  const BodyMoment body = cube(10, 0);  // 5 cells along each axis, of which 3 are inside
  const BodyPicture picture(grid(5), body, 1, {body.field("position")});
  CHECK(picture.json()["points"] == 1000);
  CHECK(picture.json()["drawn"] == 1000 - 216);
}

TEST_CASE("the picture of a large body is thinned out evenly, so that a report stays below 3 MB") {
  const BodyMoment body = cube(100, 0);
  BodyPicture picture(grid(50), body, 6, {body.field("position")});
  for (int k = 0; k < 6; ++k) picture.add(body);
  const Json json = picture.json();
  CHECK(json["drawn"] > 10'000);
  CHECK(json.dump().size() < 2'500'000);
  const auto& x = json["x"][0];
  const std::vector<double> along = decoded(x["values"], x["min"], x["max"]);
  const auto middle = std::ranges::count_if(along, [](double value) { return value < 25; });
  CHECK(std::abs(static_cast<double>(middle) / static_cast<double>(along.size()) - 0.5) < 0.01);
}

TEST_CASE("of many stages a report draws some, evenly, with the first and the last among them") {
  const std::vector<std::size_t> of_few = drawn_moments(cube(2, 0), 1000), of_many = drawn_moments(cube(40, 0), 1000);
  CHECK(of_few.size() == 60);
  CHECK(of_many == std::vector<std::size_t>{0, 199, 399, 599, 799, 999});
  CHECK(of_few.back() == 999);
  CHECK(drawn_moments(cube(40, 0), 3) == std::vector<std::size_t>{0, 1, 2});
  CHECK(drawn_moments(cube(40, 0), 1) == std::vector<std::size_t>{0});
}

TEST_CASE("a short history is whole in a report, and a long one keeps the extremes of all columns") {
  const TemporaryFolder folder;
  folder.write("short.csv", "t,residual\n0,1\n1,0.50000000000000011\n2,nan\n");
  CHECK(history_excerpt(folder.path() / "short.csv")["rows"] == "0,1\n1,0.5\n2,nan\n");
  CHECK(history_excerpt(folder.path() / "missing.csv").is_null());

  std::string text = "t,residual\n";
  for (int k = 0; k < 100'000; ++k) text += std::to_string(k) + (k == 70'001 ? ",9\n" : k % 2 == 0 ? ",1\n" : ",2\n");
  folder.write("long.csv", text);
  const Json json = history_excerpt(folder.path() / "long.csv");
  const std::string rows = json["rows"];
  CHECK(json["of"] == 100'000);
  CHECK(std::ranges::count(rows, '\n') < 25'000);
  for (const char* row : {"0,1\n", "70001,9\n", "99999,2\n"}) CHECK_THAT(rows, Catch::Contains(row));
}

TEST_CASE("what a scene is called and says cannot break out of its report") {
  const std::string nasty = "</title><script>alert(1)</script><!-- & \xff";
  const std::string page = report_page(nasty, {{"kind", "run"}, {"text", nasty}});
  CHECK_THAT(page, !Catch::Contains("<script>alert") && !Catch::Contains("</title><script>") &&
                       Catch::Contains("&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;&lt;!-- &amp;"));
  CHECK(page.starts_with("<!doctype html>"));
  CHECK(page.ends_with("</html>\n"));
  for (const char* mark : {"{{title}}", "{{data}}", "@REPORT"}) CHECK_THAT(page, !Catch::Contains(mark));
}
