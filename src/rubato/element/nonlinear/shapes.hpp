// SPDX-License-Identifier: LGPL-3.0-or-later
/// The shapes that kernels are compiled for.
#pragma once

#include "rubato/element/nonlinear.hpp"
#include "rubato/element/nonlinear/cell_gradients.hpp"

namespace rubato::element {

template <class S> struct ShapeTag { using Shape = S; };

/// Calls work(ShapeTag<S>) with the shape of a cell in space whose sizes are known at compile time; false
/// where there is none.
template <class Work> bool with_fixed_solid(const CellKind& kind, const Work& work) {
  switch (kind.type) {
  case CellType::hexa8:
    if (kind.formulation == Formulation::reduced)
      work(ShapeTag<Shape<3, 3, 8, 1>>{});
    else
      work(ShapeTag<Shape<3, 3, 8, 8>>{});
    return true;
  case CellType::hexa20:
    work(ShapeTag<Shape<3, 3, 20, 27>>{});
    return true;
  case CellType::tetra4:
    work(ShapeTag<Shape<3, 3, 4, 1>>{});
    return true;
  case CellType::tetra10:
    work(ShapeTag<Shape<3, 3, 10, 4>>{});
    return true;
  default:
    return false;
  }
}

/// The same in the plane; Rows = 3 if axisymmetric.
template <int Rows, class Work> bool with_fixed_plane(const CellKind& kind, const Work& work) {
  switch (kind.type) {
  case CellType::quad4:
    if (kind.formulation == Formulation::reduced)
      work(ShapeTag<Shape<2, Rows, 4, 1>>{});
    else
      work(ShapeTag<Shape<2, Rows, 4, 4>>{});
    return true;
  case CellType::quad8:
    work(ShapeTag<Shape<2, Rows, 8, 9>>{});
    return true;
  default:
    return false;
  }
}

} // namespace rubato::element
