// A program of somebody else's: relaxes a scene and prints how far from equilibrium it stopped.
#include <stillpoint/stillpoint.hpp>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto scene = stillpoint::load_scene(argv[1]);
  const auto summary = stillpoint::run(scene, {});
  std::cout << "residual " << summary.residual << '\n';
  return summary.residual < 1e-9 ? 0 : 1;
}
