// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/hourglass_control.hpp"

namespace rubato::element {
namespace {

template <class S> double energy_of(const CellKind& kind, const CellInput& input) {
  const CellGradients<S> gradients(reference_gradients(kind.type), input.points, kind.section);
  return HourglassForces<S>(kind, gradients, input).energy();
}

} // namespace

double hourglass_energy(const CellKind& kind, std::span<const Eigen::Vector3d> points,
                        std::span<const double> displacement) {
  if (kind.formulation != Formulation::reduced)
    return 0;
  const CellInput input{points, displacement, {}};
  switch (kind.section.physics) {
  case study::Physics::solid:
    return energy_of<Shape<3, 3, 8, 1>>(kind, input);
  case study::Physics::axisymmetric:
    return energy_of<Shape<2, 3, 4, 1>>(kind, input);
  default:
    return energy_of<Shape<2, 2, 4, 1>>(kind, input);
  }
}

} // namespace rubato::element
