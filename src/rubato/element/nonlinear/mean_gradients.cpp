// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/mean_gradients.hpp"

#include "rubato/cell/wave_patterns.hpp"

namespace rubato::element {

template <> const Waves<2>& waves<2>() {
  static const Waves<2> table = cell::shortest_waves(CellType::quad4);
  return table;
}

template <> const Waves<3>& waves<3>() {
  static const Waves<3> table = cell::shortest_waves(CellType::hexa8);
  return table;
}

} // namespace rubato::element
