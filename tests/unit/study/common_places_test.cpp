// The places at which levels with different points are compared.
#include "study/common_places.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

/// A field that is known everywhere.
class Known final : public PlaceReader {
 public:
  void displacement(ConstVec X, Vec u) const override {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 10 * X[0] + X[1] + static_cast<double>(i);
  }
  void stress(ConstVec X, Vec stress) const override {
    for (std::size_t i = 0; i < stress.size(); ++i) stress[i] = X[1] - static_cast<double>(i);
  }
  // read_at() asks for nothing else
  bool holds(ConstVec) const override { return true; }
  bool reaches(ConstVec) const override { return true; }
  void put_back(Vec) const override {}
  void velocity(ConstVec, Vec) const override {}
  void strain(ConstVec, Vec) const override {}
  double pore_pressure(ConstVec) const override { return 0; }
  double history(const std::string&, ConstVec) const override { return 0; }
};

}  // namespace

TEST_CASE("the places of a box are two Gauss points along each axis of a cell, and sum to integrals of cubics") {
  const Scene scene = scenes::load("column", {"grid.cells=[2, 5]", "body.points_per_cell=9"});  // 1.25 m × 10 m
  const CommonPlaces places = common_places(scene);
  REQUIRE(places.size() == 2 * 5 * 4);
  CHECK(count_of_places(scene) == 40);
  double of_x3 = 0, of_y3 = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    of_x3 += places.volume[p] * std::pow(places.x[2 * p], 3);
    of_y3 += places.volume[p] * std::pow(places.x[2 * p + 1], 3);
  }
  CHECK(of_x3 == Approx(std::pow(1.25, 4) / 4 * 10).epsilon(1e-13));
  CHECK(of_y3 == Approx(1.25 * 1e4 / 4).epsilon(1e-13));
}

TEST_CASE("the places of a scene do not depend on where its own points lie") {
  const auto of = [](const char* placement) {
    return common_places(scenes::load("column", {placement, "body.points_per_cell=[3, 2]"}));
  };
  const CommonPlaces uniform = of("body.placement=uniform"), random = of("body.placement=random");
  CHECK(uniform.x == random.x);
  CHECK(uniform.volume == random.volume);
}

TEST_CASE("what is read at the places is each place's own, u and stress") {
  const CommonPlaces places = {.x = {1, 2, 3, 4}, .volume = {1, 1}};
  const FieldsAtPlaces fields = read_at(places, Known(), 3);
  CHECK(fields.u == std::vector<double>{12, 13, 34, 35});
  CHECK(fields.stress == std::vector<double>{2, 1, 0, 4, 3, 2});
}
