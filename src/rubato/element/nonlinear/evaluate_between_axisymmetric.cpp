// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/between_kernel.hpp"
#include "rubato/element/nonlinear/kernels.hpp"

namespace rubato::element {

BetweenResult evaluate_between_axisymmetric(const CellKind& kind, const PointLaws& laws,
                                            const BetweenInput& input, const BetweenOutput& output) {
  if (kind.type == CellType::quad4)
    return BetweenKernel<Shape<2, 3, 4, 4>>(kind, laws, input, output).evaluate();
  return BetweenKernel<Shape<2, 3, Eigen::Dynamic, Eigen::Dynamic>>(kind, laws, input, output).evaluate();
}

} // namespace rubato::element
