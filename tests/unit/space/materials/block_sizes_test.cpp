// Blocks of few points and of many.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "space/materials/point_material.hpp"

using namespace stillpoint;

namespace {

// A material with these parameters, and the others as a scene has them.
MaterialSpec material(const std::string& law, const std::string& parameters) {
  return load_scene("law.toml",
                    "dim = 2\n[grid]\nmin = [0, 0]\nmax = [1, 1]\ncells = [1, 1]\n[body]\nstate = \"plane-strain\"\n"
                    "material = \"m\"\n[[support]]\nface = \"bottom\"\n[damping]\nstrategy = \"auto\"\n"
                    "[material.m]\nE = 1e4\nnu = 0.3\nrho = 1\nlaw = \"" +
                        law + "\"\n" + parameters,
                    {})
      .materials.at("m");
}

template <Kinematics K>
constexpr StressState state_of() {
  return K == Kinematics::space          ? StressState::space
         : K == Kinematics::axisymmetric ? StressState::axisymmetric
                                         : StressState::plane_strain;
}

// V P and the histories of `count` points from `first` on, which are evaluated in blocks of so many.
template <Kinematics K>
std::vector<double> answers(const MaterialSpec& spec, std::size_t of_block, double size) {
  constexpr std::size_t points = 32;
  const auto law = make_point_material<K>(spec, state_of<K>(), 0, points, true);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-size, size);
  std::vector<TensorOf<K>> dH(points);
  std::vector<double> V(points), found;
  for (auto& of_point : dH)
    for (double& component : of_point) component = any(random);
  for (double& volume : V) volume = 1 + any(random);
  std::vector<double> trial(law->info().history_size);
  for (int step = 0; step < 3; ++step) {  // the second and third from a state that has yielded
    for (std::size_t first = 0; first < points; first += of_block) {
      auto block = std::make_unique<PointBlock<K>>();
      block->first = first;
      block->count = std::min(of_block, points - first);
      for (std::size_t q = 0; q < block->count; ++q)
        for (std::size_t c = 0; c < dH[first + q].size(); ++c)
          block->H[c][q] = block->dH[c][q] = dH[first + q][c] * (step == 1 ? -0.3 : 1);
      CHECK(law->stress(*block, V.data(), 0.1, trial.data()) == 0);
      for (std::size_t q = 0; q < block->count; ++q)
        for (std::size_t c = 0; c < dH[first + q].size(); ++c) found.push_back(block->VP[c][q]);
    }
    found.insert(found.end(), trial.begin(), trial.end());
    if (!trial.empty()) law->commit(trial);
    trial.resize(law->info().history_size);
  }
  return found;
}

template <Kinematics K>
void check(const MaterialSpec& spec, double size) {
  CAPTURE(spec.law, static_cast<int>(K));
  const std::vector<double> whole = answers<K>(spec, 32, size);
  for (const std::size_t of_block : {1, 2, 3, 5, 7, 8, 9, 15}) {
    CAPTURE(of_block);
    CHECK(answers<K>(spec, of_block, size) == whole);
  }
}

}  // namespace

TEST_CASE("a point answers with the same bits in a block of any size, whatever its law") {
  const std::string soil = "phi = 30\npsi = 5\nc = 1\n";
  const std::vector<MaterialSpec> all = {material("linear-elastic", ""), material("neo-hookean", ""),
                                         material("hencky", ""), material("drucker-prager", soil),
                                         material("mohr-coulomb", soil)};
  for (const MaterialSpec& spec : all) {
    for (const double size : {1e-5, 1e-3, 0.055, 0.1}) {  // Hencky's logarithm takes roots of some, not of all
      check<Kinematics::plane>(spec, size);
      check<Kinematics::axisymmetric>(spec, size);
      check<Kinematics::space>(spec, size);
    }
  }
}
