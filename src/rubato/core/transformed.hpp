// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <vector>

namespace rubato {

/// Value(f(member)) for each member of a range, in the order of the range. f is a function or a pointer to a
/// member.
template <class Value, class Range, class Function>
std::vector<Value> transformed(const Range& range, const Function& f) {
  std::vector<Value> values;
  values.reserve(static_cast<std::size_t>(std::size(range)));
  for (const auto& member : range)
    values.emplace_back(std::invoke(f, member));
  return values;
}

} // namespace rubato
