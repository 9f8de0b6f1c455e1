// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/cell_kernel.hpp"
#include "rubato/element/nonlinear/kernels.hpp"
#include "rubato/element/nonlinear/shapes.hpp"
#include "rubato/element/nonlinear/small_hexa8.hpp"

namespace rubato::element {

CellResult evaluate_solid(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                          const CellOutput& output) {
  if (is_small_hexa8(kind, output))
    return evaluate_small_hexa8(kind, laws, input, output);
  CellResult result;
  const auto evaluate_as = [&]<class S>(ShapeTag<S>) {
    result = CellKernel<S>(kind, laws, input, output).evaluate();
  };
  if (!with_fixed_solid(kind, evaluate_as))
    evaluate_as(ShapeTag<Shape<3, 3, Eigen::Dynamic, Eigen::Dynamic>>{});
  return result;
}

} // namespace rubato::element
