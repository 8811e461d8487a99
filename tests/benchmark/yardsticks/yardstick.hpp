// What all yardsticks have in common.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace yardsticks {

class Yardstick {
 public:
  virtual ~Yardstick() = default;
  virtual std::size_t points() const = 0;
  /// What a step moves of the points' arrays between the processor and where they lie, a point [B]. What is written is
  /// read as well: a processor owns a line of memory before it writes to it.
  virtual std::size_t bytes_per_point() const = 0;
  virtual void step() = 0;
  /// Compares a step with one that is written naively; returns what is wrong, or nothing.
  virtual std::string wrong() = 0;
};

std::unique_ptr<Yardstick> make_space();
std::unique_ptr<Yardstick> make_plane_linear();
std::unique_ptr<Yardstick> make_plane_quadratic();
std::unique_ptr<Yardstick> make_stream_space();
std::unique_ptr<Yardstick> make_stream_plane();

}  // namespace yardsticks
