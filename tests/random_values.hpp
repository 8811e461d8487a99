// Values by chance, the same in every run.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace stillpoint::test {

/// n values between −scale and scale; each seed has its own.
inline std::vector<double> random_values(std::size_t n, double scale, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-scale, scale);
  std::vector<double> values(n);
  for (double& value : values) value = uniform(random);
  return values;
}

}  // namespace stillpoint::test
