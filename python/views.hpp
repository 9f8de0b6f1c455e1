// SPDX-License-Identifier: LGPL-3.0-or-later
/// Arrays of numpy: views that cannot be written and keep their owner alive, and copies.
#pragma once

#include <algorithm>
#include <cstdint>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <span>
#include <utility>
#include <vector>

namespace rubato::python {

namespace py = pybind11;

/// A view of numbers in C order. `owner`: the object whose life the numbers share.
template <class T> py::array view(const T* numbers, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array_t<T> array(std::move(shape), numbers, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}
template <class T> py::array view(const std::vector<T>& numbers, py::handle owner) {
  return view(numbers.data(), {static_cast<py::ssize_t>(numbers.size())}, owner);
}
inline py::array view(const Eigen::VectorXd& numbers, py::handle owner) {
  return view(numbers.data(), {numbers.size()}, owner);
}

/// A view of a member of each item: a number, or as many as a vector has. `first`: the member of the first
/// item, unused where there is none.
template <class Item>
py::array member_view(const std::vector<Item>& items, const double* first, py::ssize_t count,
                      py::handle owner) {
  const auto size = static_cast<py::ssize_t>(items.size());
  constexpr auto stride = static_cast<py::ssize_t>(sizeof(Item));
  constexpr auto width = static_cast<py::ssize_t>(sizeof(double));
  const bool numbers = count == 1;
  py::array_t<double> array(numbers ? std::vector{size} : std::vector{size, count},
                            numbers ? std::vector{stride} : std::vector{stride, width}, first, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// An array of its own.
template <class T> py::array_t<T> copied(std::span<const T> numbers, std::vector<py::ssize_t> shape) {
  py::array_t<T> array(std::move(shape));
  std::ranges::copy(numbers, array.mutable_data());
  return array;
}
template <class T> py::array_t<T> copied(const std::vector<T>& numbers) {
  return copied(std::span(numbers), {static_cast<py::ssize_t>(numbers.size())});
}

/// Floats in C order; what is no array of numbers is refused by numpy.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Whole numbers, each at least 0 and below `limit`: indices. Throws TypeError for anything else than
/// integers, IndexError, which names `what`, for one outside.
std::vector<std::int32_t> indices_of(py::handle value, std::int64_t limit, const char* what);

/// Places: n × 3, or n × 2 in the plane. Throws ValueError for another shape.
std::vector<Eigen::Vector3d> places_of(const Numbers& array);

} // namespace rubato::python
