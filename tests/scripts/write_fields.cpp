// write_fields plane|space|bar|killed FOLDER [vtu]: leaves fields whose every number is known to fields_test.py and to
// vtu_test.py, to the bit.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string_view>

#include "output/field_writer.hpp"
#include "output/vtu_writer.hpp"

using namespace stillpoint;

namespace {

// Entry k of number `number` in frame `frame`: one rounding, of an integer's seventh.
double value(std::size_t frame, std::size_t number, std::size_t k) {
  return static_cast<double>(1 + k + 100 * number + 10 * frame) / 7;
}

FieldFrame a_frame(std::size_t number, int dim, std::size_t points, const std::vector<PointField>& fields) {
  FieldFrame frame{static_cast<double>(number) / 3, dim, points, {}, fields, {}, {}};
  for (int d = 0; d < dim; ++d) frame.grid_lines.push_back({0.0, 0.5 + d, 2.0 + d + static_cast<double>(number / 2)});
  const auto fill = [&](std::vector<double>& values, int components, std::size_t seed) {
    values.resize(static_cast<std::size_t>(components) * points);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = value(number, seed, k);
  };
  fill(frame.position, dim, 0);
  std::size_t seed = 1;
  for (PointField& field : frame.fields) fill(field.values, field.components, seed++);
  return frame;
}

void finish(FieldWriter& writer) { writer.finish(); }
void finish(VtuWriter& /*its files are complete*/) {}

template <class Writer>
void write(std::string_view what, const char* folder) {
  Writer writer(folder);
  if (what == "bar") {
    writer.add(a_frame(0, 1, 4, {{"u", 1, {}, "m"}, {"v", 1, {}}, {"stress", 1, {}, "Pa"}}));
  } else if (what == "space") {
    writer.add(
        a_frame(0, 3, 60, {{"u", 3, {}, "m"}, {"v", 3, {}}, {"stress", 6, {}, "Pa"}, {"plastic_strain", 1, {}}}));
  } else {
    std::size_t number = 0;
    for (const std::size_t points : {5u, 40000u, 5u}) {  // the second takes more than one chunk, and an odd part of one
      FieldFrame frame =
          a_frame(number++, 2, points,
                  {{"u", 2, {}, "m"}, {"v", 2, {}}, {"stress", 4, {}, "Pa"}, {"plastic_strain", 1, {}}, {"n", 3, {}}});
      for (std::size_t p = 0; p < points; ++p) frame.material.push_back(static_cast<int>(p % 3) - 1);
      writer.add(frame);
    }
  }
  if (what == "killed") std::_Exit(1);  // no destructor, and nothing of the library's own at exit
  finish(writer);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 4) return 2;
  argc == 4 ? write<VtuWriter>(argv[1], argv[2]) : write<FieldWriter>(argv[1], argv[2]);
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
