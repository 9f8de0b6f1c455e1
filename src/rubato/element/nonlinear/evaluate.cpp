// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/element/nonlinear/bubble_cell.hpp"
#include "rubato/element/nonlinear/cell_kernel.hpp"
#include "rubato/element/nonlinear/reference_gradients.hpp"
#include "rubato/element/nonlinear/small_hexa8.hpp"
#include "rubato/study/formulation.hpp"

#include <stdexcept>
#include <string>

namespace rubato::element {
namespace {

using study::Physics;

bool is_bulk(const CellKind& kind) {
  return cell::has_reference_cell(kind.type) &&
         cell::topology(kind.type).dimension == component_count(kind.section.physics);
}

bool is_box(const CellKind& kind) {
  return kind.type == CellType::quad4 || kind.type == CellType::hexa8;
}

} // namespace

bool is_offered(const CellKind& kind) {
  if (!is_bulk(kind))
    return false;
  switch (kind.formulation) {
  case Formulation::mean_dilatation:
    return study::averages_dilatation(kind.type, kind.section.physics);
  case Formulation::enhanced:
    return is_box(kind) && kind.strain != StrainKind::logarithmic;
  case Formulation::reduced:
    return is_box(kind);
  case Formulation::lower_order:
    return has_lower_order_rule(kind.type);
  default:
    return true;
  }
}

int point_count(const CellKind& kind) {
  switch (kind.formulation) {
  case Formulation::reduced:
    return 1;
  case Formulation::lower_order:
    return reference_gradients(kind.type, PointRule::lower_order).points;
  default:
    return static_cast<int>(cell::stiffness_rule(kind.type).size());
  }
}

int mode_count(const CellKind& kind) {
  if (kind.formulation == Formulation::mean_dilatation && has_bubble(kind.type))
    return component_count(kind.section.physics);
  if (kind.formulation != Formulation::enhanced)
    return 0;
  if (kind.type == CellType::quad4)
    return 4;
  return kind.strain == StrainKind::small ? 12 : 9;
}

int state_size_of_cell(const CellKind& kind, int law_state_size) {
  return point_count(kind) * law_state_size + mode_count(kind);
}

const char* described(Failure failure) {
  switch (failure) {
  case Failure::none:
    return "no failure";
  case Failure::inverted:
    return "a point is turned inside out (J ≤ 0)";
  case Failure::law:
    return "the law has no response to the strain";
  case Failure::mode_iteration:
    return "the iteration for the enhanced strain of the cell has no end";
  case Failure::not_finite:
    return "a force is not finite";
  case Failure::no_length:
    return "a connector with rotates: true ends there, and its two ends come together: without length it "
           "has no direction";
  }
  return "";
}

CellResult evaluate(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                    const CellOutput& output) {
  if (!is_offered(kind))
    throw std::invalid_argument(std::string(cell::topology(kind.type).name) +
                                " has no such formulation in this physics");
  if (is_small_hexa8(kind, output))
    return evaluate_small_hexa8(kind, laws, input, output);
  return evaluate_cell(kind, laws, input, output);
}

} // namespace rubato::element
