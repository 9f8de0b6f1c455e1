// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/cell_kernel.hpp"

#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/cell_points.hpp"
#include "rubato/element/nonlinear/enhanced.hpp"
#include "rubato/element/nonlinear/hourglass_control.hpp"
#include "rubato/element/nonlinear/mean_cell.hpp"

#include <cmath>

namespace rubato::element {
namespace {

class CellKernel {
public:
  CellKernel(const CellKind& kind, const PointLaws& laws, const CellInput& input, const CellOutput& output,
             CellGradients& gradients, const PointValues& values)
      : gradients_(gradients), cell_(kind, laws, input, output, gradients, values) {}

  CellResult evaluate() {
    const auto result = by_formulation();
    if (result && !cell_.output.records.empty())
      cell_.put_records();
    return result;
  }

private:
  bool wants_tangent() const { return !cell_.output.tangent.empty(); }
  material::Want want() const { return wants_tangent() ? material::Want::tangent : material::Want::stress; }
  MatrixView tangent() const { return {cell_.output.tangent.data(), gradients_.dofs()}; }

  CellResult by_formulation() {
    switch (cell_.kind.formulation) {
    case Formulation::enhanced:
      return enhanced();
    case Formulation::mean_dilatation:
      return mean_dilatation();
    case Formulation::reduced:
      return reduced();
    default:
      return full();
    }
  }

  /// The stresses and moduli of the laws at the strain of the displacements.
  CellResult respond() {
    for (std::size_t q = 0; q < cell_.at.seen.size(); ++q)
      cell_.at.seen[q].h = cell_.at.gradient[q];
    cell_.at.conjugate = cell_.at.piola;
    return cell_.respond(want());
  }

  CellResult full() {
    const auto result = respond();
    if (!result)
      return result;
    if (wants_tangent())
      put_full();
    return with_force(result, gradients_.no_force());
  }

  CellResult reduced() {
    auto result = respond();
    if (!result)
      return result;
    const HourglassForces hourglass(cell_.kind, gradients_, cell_.input.points, cell_.displacement);
    result.hourglass = hourglass.energy();
    if (wants_tangent()) {
      put_full();
      hourglass.add_tangent(tangent());
    }
    return with_force(result, hourglass.forces());
  }

  /// Calls work(A), A the moduli of small strain or of large motions, which `work` sets.
  template <class Work> void with_moduli(const Work& work) const {
    const auto size = cell_.at.seen.size();
    if (cell_.is_small()) {
      AtPoints<material::Tangent6> moduli;
      work(std::span(moduli).first(size));
    } else {
      AtPoints<Moduli> moduli;
      work(std::span(moduli).first(size));
    }
  }

  void put_full() {
    with_moduli([&](auto moduli) {
      cell_.set_moduli(moduli);
      put_block_sums(gradients_, moduli, 0, gradients_.nodes(), tangent());
    });
  }

  CellResult mean_dilatation() {
    MeanCell mean(cell_, gradients_, wants_tangent());
    const auto result = mean.solve();
    if (!result)
      return result;
    if (wants_tangent())
      mean.put_tangent(tangent());
    return with_force(result, gradients_.no_force());
  }

  CellResult enhanced() {
    EnhancedCell modes(cell_, gradients_);
    const auto result = modes.solve();
    if (!result)
      return result;
    cell_.at.conjugate = cell_.at.piola;
    if (wants_tangent())
      modes.put_tangent(tangent());
    return with_force(result, gradients_.no_force());
  }

  /// `force`: what acts beside the stresses.
  CellResult with_force(CellResult result, NodalValues force) const {
    gradients_.add_forces(cell_.at.conjugate, force);
    if (!std::isfinite(gradients_.put(force, cell_.output.force)))
      result.failure = Failure::not_finite;
    return result;
  }

  CellGradients& gradients_;
  CellPoints cell_;
};

template <int most_points>
CellResult evaluate_with(CellGradients& gradients, const CellKind& kind, const PointLaws& laws,
                         const CellInput& input, const CellOutput& output) {
  PointMemory<most_points> memory;
  return CellKernel(kind, laws, input, output, gradients, memory.first(gradients.points())).evaluate();
}

} // namespace

CellResult evaluate_cell(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                         const CellOutput& output) {
  constexpr int of_most_cells = 8;
  CellGradients gradients(kind.type, input.points, kind.section, rule_of(kind.formulation));
  return gradients.points() <= of_most_cells
             ? evaluate_with<of_most_cells>(gradients, kind, laws, input, output)
             : evaluate_with<most_points_of_cell>(gradients, kind, laws, input, output);
}

} // namespace rubato::element
