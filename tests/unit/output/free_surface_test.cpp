#include "output/free_surface.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

constexpr double w = 0.1, spacing = w / 2;  // of columns, and of points: four to a cell
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Points at the middles of squares of side `spacing`, where they lie under the surface y = top(x), 0 ≤ x < length;
// moved by up to jitter/2 spacings in each direction.
std::vector<double> points_under(const std::function<double(double)>& top, double length, double jitter = 0) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-jitter / 2, jitter / 2);
  std::vector<double> place;
  for (double i = 0.5; i * spacing < length; ++i) {
    for (double j = 0.5; j * spacing < 10; ++j) {
      const double x = (i + move(random)) * spacing, y = (j + move(random)) * spacing;
      if (y < top(x)) place.insert(place.end(), {x, y});
    }
  }
  return place;
}

// 3 m high for 1 m, then falling to the right.
std::vector<double> wedge(double degrees, double jitter = 0) {
  const double slope = std::tan(radians(degrees));
  return points_under([&](double x) { return std::min(3., (1 - x) * slope + 3); }, 1 + 3 / slope, jitter);
}

std::vector<double> mirrored(std::vector<double> place) {
  for (std::size_t k = 0; k < place.size(); k += 2) place[k] = -place[k];
  return place;
}

// A surface through the corners (x, y), sampled at every whole x.
FreeSurface through(const std::vector<std::pair<double, double>>& corners) {
  FreeSurface surface;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const auto [x, y] = corners[k];
    const auto [x_next, y_next] = corners[k + 1];
    for (double at = x; at < x_next; ++at) {
      surface.x.push_back(at);
      surface.y.push_back(y + (at - x) / (x_next - x) * (y_next - y));
    }
  }
  surface.x.push_back(corners.back().first);
  surface.y.push_back(corners.back().second);
  return surface;
}

double angle_of(double rise, double run) { return std::atan(rise / run) * 180 / std::numbers::pi; }

}  // namespace

TEST_CASE("the free surface is the highest point of each column that has any") {
  const std::vector<double> place = {0.52, 0.1, 0.55, 0.9, 0.51, 0.5, -0.3, 0.2, 1.4, 0.6, 2.9, 0.8};
  const FreeSurface surface = free_surface(place, 1);
  CHECK(surface.x == std::vector<double>{-0.3, 0.55, 1.4, 2.9});
  CHECK(surface.y == std::vector<double>{0.2, 0.9, 0.6, 0.8});
  CHECK(free_surface({}, 1).x.empty());
  CHECK_THROWS_AS(free_surface(place, 0), std::invalid_argument);
}

TEST_CASE("points apart from the mass, or at no place at all, are no part of its free surface") {
  const std::vector<double> mass = wedge(30);
  std::vector<double> place = {-5, 0.2, -5, 0.25, 20, 0.01, 1e300, -1e300};  // beyond it
  place.insert(place.end(), {2, 9, 2.01, 9, 0.5, 3.15});                     // above it, the last by hardly a cell
  for (std::size_t k = 0; k < mass.size(); k += 2) {
    place.insert(place.end(), {mass[k], mass[k + 1]});
    if (k % 20 == 0) place.insert(place.end(), {not_a_number, 1, mass[k], not_a_number});
    if (k % 50 == 0) place.insert(place.end(), {1, std::numeric_limits<double>::infinity()});
  }
  const FreeSurface surface = free_surface(place, w), expected = free_surface(mass, w);
  CHECK(surface.x == expected.x);
  CHECK(surface.y == expected.y);
}

TEST_CASE("the mass is the cluster with most points, of squares that touch, if by a corner alone") {
  CHECK(free_surface(std::vector{0.5, 0.5, 1.5, 1.5, 2.5, 0.5}, 1).x == std::vector{0.5, 1.5, 2.5});
  CHECK(free_surface(std::vector{0.5, 0.5, 1.5, 0.5, 3.5, 0.5}, 1).x == std::vector{0.5, 1.5});
  CHECK(free_surface(std::vector{0.5, 0.5, 1.5, 0.5, 3.5, 0.5, 3.6, 0.5, 3.7, 0.6}, 1).x == std::vector{3.7});
}

TEST_CASE("a wedge of points has its slope, whichever way it falls, scattered or not, and with points that flew off") {
  // The highest point of a column lies less than a spacing under the surface: within ±s/2 of a line parallel to it.
  // Such deviations turn a line that was fitted over the length L by 3 (s/2)/L at most; in the angle that is cos² times
  // as much.
  for (const double degrees : {20., 30., 45., 60.}) {
    for (const double jitter : {0., 0.5, 1.}) {
      std::vector<double> place = wedge(degrees, jitter);
      place.insert(place.end(), {2.5, 8, 30, 0.02});
      const double length = 0.7 * 3 / std::tan(radians(degrees));
      const double turn = 3 * (spacing / 2) / length * std::pow(std::cos(radians(degrees)), 2) * 180 / std::numbers::pi;
      INFO(degrees << " degrees, jitter " << jitter << ", expected within " << turn);
      CHECK(slope_angle(free_surface(place, w), 0) == Approx(degrees).epsilon(0).margin(turn));
      CHECK(slope_angle(free_surface(mirrored(place), w), 0) == Approx(degrees).epsilon(0).margin(turn));
    }
  }
  CHECK(slope_angle(free_surface(wedge(30), w), 0) == Approx(30).margin(0.1));  // and this is what it comes to
}

TEST_CASE("only the surface between 15 and 85 percent of the height above the base makes the slope") {
  // H = 100 on a base at 7: 10 m of crest, 70 m of slope and 20 m of toe, the corners at 15 and 85 percent.
  const auto surface = [](double base) {
    return through({{0, 100 + base}, {40, 85 + base}, {180, 15 + base}, {400, base}});
  };
  CHECK(slope_angle(surface(0), 0) == Approx(angle_of(70, 140)).epsilon(1e-12));
  CHECK(slope_angle(surface(7), 7) == Approx(angle_of(70, 140)).epsilon(1e-12));
  const FreeSurface limits{{0, 1, 2, 3, 4, 5, 6}, {100, 86, 84, 50, 16, 14, 0}};
  CHECK(slope_angle(limits, 0) == Approx(angle_of(34, 1)).epsilon(1e-12));
  CHECK(slope_angle(surface(50), 0) != Approx(angle_of(70, 140)).epsilon(1e-3));
}

TEST_CASE("a steep slope is not flattened by points that scatter across it") {
  // Pairs of points at equal distances to both sides of a line at 75 degrees, well within the limits of height.
  const double slope = radians(75), across = 0.8;
  FreeSurface surface{{-1}, {20}};
  for (double along = 5; along <= 16; ++along) {
    for (const double side : {-across, across}) {
      surface.x.push_back((20 - along) * std::cos(slope) + side * std::sin(slope));
      surface.y.push_back(along * std::sin(slope) + side * std::cos(slope));
    }
  }
  CHECK(slope_angle(surface, 0) == Approx(75).epsilon(1e-12));
}

TEST_CASE("a vertical step, or less than three columns of a slope, has no angle") {
  CHECK(std::isnan(slope_angle(free_surface(points_under([](double) { return 3; }, 2), w), 0)));
  CHECK(std::isnan(slope_angle({{0, 1, 2, 3}, {10, 7, 4, 0}}, 0)));
  CHECK(slope_angle({{0, 1, 2, 3, 4}, {10, 8, 6, 4, 0}}, 0) == Approx(angle_of(2, 1)).epsilon(1e-12));
  CHECK(std::isnan(slope_angle({}, 0)));
  CHECK(std::isnan(slope_angle({{0, 1, 2, 3, 4}, {10, 8, 6, 4, 0}}, 10)));
  CHECK(std::isnan(slope_angle({{0, 1, 2, 3, 4}, {5, 5, 5, 5, 5}}, 5)));
}

TEST_CASE("of a heap, the flank with more columns makes the slope, and no second heap behind it") {
  CHECK(slope_angle(through({{0, 0}, {100, 100}, {300, 0}}), 0) == Approx(angle_of(1, 2)).epsilon(1e-12));
  CHECK(slope_angle(through({{0, 0}, {200, 100}, {300, 0}}), 0) == Approx(angle_of(1, 2)).epsilon(1e-12));
  CHECK(slope_angle(through({{0, 0}, {100, 100}, {300, 0}, {340, 80}, {380, 0}}), 0) ==
        Approx(angle_of(1, 2)).epsilon(1e-12));
  const FreeSurface equal{{0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 20, 50, 80, 100, 70, 50, 30, 0}};
  CHECK(slope_angle(equal, 0) == Approx(angle_of(20, 1)).epsilon(1e-12));  // of equals, the right one
}
