// The soil of all yardsticks: Drucker–Prager without cohesion, and the numbers that its law needs. Tension is positive.
#pragma once

namespace yardsticks::soil {

constexpr double E = 20e6, nu = 0.3;  // [Pa], [1]
constexpr double density = 1800;      // [kg/m³]
constexpr double gravity = 9.81;      // [m/s²]
constexpr double eta = 0.687;         // of the cone √J₂ + η p ≤ 0: φ = 35°, the mean cone

constexpr double lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
constexpr double shear = E / (2 * (1 + nu));
constexpr double at_rest = nu / (1 - nu);  // horizontal by vertical stress of soil that has settled
constexpr double tiny = 1e-300;            // so that 0/0 is 0

}  // namespace yardsticks::soil
