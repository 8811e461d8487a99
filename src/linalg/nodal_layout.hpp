// The nodes and components of a stiffness's unknowns, which a hierarchy of coarser levels needs besides the matrix.
#pragma once

#include <cstddef>
#include <vector>

namespace stillpoint {

struct NodalLayout {
  int dim = 0;
  std::vector<int> node;          // node of each unknown, from 0, ascending, (n)
  std::vector<int> component;     // component of each unknown, in 0 … dim − 1, ascending in a node, (n)
  std::vector<double> positions;  // (nodes × dim) [m]

  bool empty() const { return node.empty(); }
  std::size_t nodes() const { return node.empty() ? 0 : static_cast<std::size_t>(node.back()) + 1; }
};

}  // namespace stillpoint
