// numpy arrays of doubles: views of the library's memory, and copies.
#pragma once

#include <stillpoint/types.hpp>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/numpy.h>

namespace stillpoint::python {

using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Shape = std::vector<pybind11::ssize_t>;

inline void make_read_only(pybind11::array& array) { array.attr("flags").attr("writeable") = false; }

/// A read-only view of memory that `owner` keeps, without a copy.
inline Array view_of(ConstVec values, std::shared_ptr<const void> owner) {
  const pybind11::capsule keeps(new std::shared_ptr<const void>(std::move(owner)),
                                [](void* kept) { delete static_cast<std::shared_ptr<const void>*>(kept); });
  Array array(static_cast<pybind11::ssize_t>(values.size()), values.data(), keeps);
  make_read_only(array);
  return array;
}

/// A copy of the values in an array of this shape.
inline Array copy_of(ConstVec values, Shape shape) {
  Array array(std::move(shape));
  std::ranges::copy(values, array.mutable_data());
  return array;
}

/// The values of an array that has to be a vector of n.
inline ConstVec vector_of(const Array& array, std::size_t n, const char* name) {
  if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != n)
    throw std::invalid_argument(fmt::format("{}: expected an array of shape ({},)", name, n));
  return {array.data(), n};
}

}  // namespace stillpoint::python
