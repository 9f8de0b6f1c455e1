// SPDX-License-Identifier: LGPL-3.0-or-later
#include "views.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace rubato::python {

std::vector<std::int32_t> indices_of(py::handle value, std::int64_t limit, const char* what) {
  const py::array any = py::module_::import("numpy").attr("asarray")(value);
  const char kind = any.dtype().kind();
  if (kind != 'i' && kind != 'u' && any.size() > 0)
    throw py::type_error(fmt::format("found an array of {}, expected whole numbers: indices of {}",
                                     py::str(any.dtype()).cast<std::string>(), what));
  const auto wide = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(any);
  std::vector<std::int32_t> result;
  result.reserve(static_cast<std::size_t>(wide.size()));
  for (const auto index : std::span(wide.data(), static_cast<std::size_t>(wide.size()))) {
    if (index < 0 || index >= limit)
      throw py::index_error(
          fmt::format("found the index {} of {}, expected 0 to {}", index, what, limit - 1));
    result.push_back(static_cast<std::int32_t>(index));
  }
  return result;
}

std::vector<Eigen::Vector3d> places_of(const Numbers& array) {
  if (array.ndim() != 2 || (array.shape(1) != 2 && array.shape(1) != 3))
    throw std::invalid_argument(
        "found an array of another shape, expected places: n x 3, or n x 2 in the plane");
  std::vector<Eigen::Vector3d> places(static_cast<std::size_t>(array.shape(0)), Eigen::Vector3d::Zero());
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    for (py::ssize_t k = 0; k < array.shape(1); ++k)
      places[static_cast<std::size_t>(i)][k] = array.at(i, k);
  return places;
}

} // namespace rubato::python
