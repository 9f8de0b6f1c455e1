// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is kept of quadrature points as plain numbers, which files and other ranks take.
#pragma once

#include "rubato/domain/law_path.hpp"
#include "rubato/element/nonlinear.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rubato::domain {

/// Shows every number of a point, in the same order always.
template <class Visit> void each_number(LawPoint& point, const Visit& visit) {
  for (auto* six : {&point.strain, &point.free, &point.stress})
    std::ranges::for_each(*six, visit);
}

template <class Visit> void each_number(element::PointRecord& record, const Visit& visit) {
  visit(record.volume);
  visit(record.stored);
  for (auto* six : {&record.strain, &record.free, &record.stress, &record.cauchy})
    std::ranges::for_each(*six, visit);
  for (auto* tensor : {&record.gradient, &record.piola})
    std::ranges::for_each(tensor->reshaped(), visit);
}

template <class Point> std::size_t numbers_of_a_point() {
  Point point{};
  std::size_t count = 0;
  each_number(point, [&](double&) { ++count; });
  return count;
}

/// Point by point.
template <class Point> std::vector<double> numbers_of(const std::vector<Point>& points) {
  std::vector<double> numbers;
  numbers.reserve(points.size() * numbers_of_a_point<Point>());
  for (auto point : points)
    each_number(point, [&](double x) { numbers.push_back(x); });
  return numbers;
}

/// The other way; as many numbers as `numbers_of` gives.
template <class Point> void put(std::span<const double> numbers, std::vector<Point>& points) {
  auto next = numbers.begin();
  for (auto& point : points)
    each_number(point, [&](double& x) { x = *next++; });
}

} // namespace rubato::domain
