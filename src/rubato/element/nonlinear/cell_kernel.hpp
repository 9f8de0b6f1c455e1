// SPDX-License-Identifier: LGPL-3.0-or-later
/// The evaluation of one cell, by formulation.
#pragma once

#include "rubato/element/nonlinear/enhanced.hpp"
#include "rubato/element/nonlinear/hourglass_control.hpp"
#include "rubato/element/nonlinear/mean_dilatation.hpp"

#include <cmath>

namespace rubato::element {

template <class S> class CellKernel {
public:
  CellKernel(const CellKind& kind, const PointLaws& laws, const CellInput& input, const CellOutput& output)
      : cell_(kind, laws, input, output) {}

  CellResult evaluate() {
    const auto result = by_formulation();
    if (result)
      cell_.put_records();
    return result;
  }

private:
  static std::size_t place(int q) { return static_cast<std::size_t>(q); }

  bool wants_tangent() const { return !cell_.output.tangent.empty(); }
  material::Want want() const { return wants_tangent() ? material::Want::tangent : material::Want::stress; }

  auto tangent() const {
    const auto size = static_cast<Eigen::Index>(cell_.gradients.nodes() * S::d);
    using Matrix = Eigen::Matrix<double, S::is_fixed ? S::most_nodes * S::d : Eigen::Dynamic,
                                 S::is_fixed ? S::most_nodes * S::d : Eigen::Dynamic>;
    return Eigen::Map<Matrix>(cell_.output.tangent.data(), size, size);
  }

  CellResult by_formulation() {
    if constexpr (S::may_be_enhanced)
      if (cell_.kind.formulation == Formulation::enhanced)
        return cell_.is_small() ? enhanced<SmallModuli<S>>() : enhanced<LargeModuli<S>>();
    if constexpr (S::may_average)
      if (cell_.kind.formulation == Formulation::mean_dilatation)
        return mean_dilatation();
    if constexpr (S::is_reduced)
      return reduced();
    else
      return full();
  }

  CellResult full() {
    for (int q = 0; q < cell_.count(); ++q)
      cell_.seen[place(q)].h = cell_.gradient[place(q)];
    auto result = cell_.respond(want());
    if (!result)
      return result;
    cell_.conjugate = cell_.piola;
    if (wants_tangent())
      cell_.is_small() ? put_full<SmallModuli<S>>() : put_full<LargeModuli<S>>();
    return with_force(result, cell_.gradients.no_force());
  }

  CellResult reduced() {
    cell_.seen[0].h = cell_.gradient[0];
    auto result = cell_.respond(want());
    if (!result)
      return result;
    cell_.conjugate = cell_.piola;
    const HourglassForces<S> hourglass(cell_.kind, cell_.gradients, cell_.input);
    result.hourglass = hourglass.energy();
    if (wants_tangent()) {
      cell_.is_small() ? put_full<SmallModuli<S>>() : put_full<LargeModuli<S>>();
      auto k = tangent();
      hourglass.add_tangent(k);
    }
    return with_force(result, hourglass.forces());
  }

  template <class Held> void put_full() {
    Held moduli;
    cell_.set_moduli(moduli);
    auto k = tangent();
    BlockSums<S, Held>(cell_.gradients, moduli).put(0, cell_.gradients.nodes(), k);
  }

  CellResult mean_dilatation() {
    MeanDilatation<S> mean(cell_);
    auto result = mean.see();
    if (result)
      result = cell_.respond(want());
    if (!result)
      return result;
    mean.set_conjugates(wants_tangent());
    if (wants_tangent())
      cell_.is_small() ? put_mean<SmallModuli<S>>(mean) : put_mean<LargeModuli<S>>(mean);
    return with_force(result, cell_.gradients.no_force());
  }

  template <class Held> void put_mean(const MeanDilatation<S>& mean) {
    Held moduli;
    const auto terms = mean.set_moduli(moduli);
    auto k = tangent();
    BlockSums<S, Held>(cell_.gradients, moduli).put(0, cell_.gradients.nodes(), k);
    add_mean_terms(terms, k);
  }

  /// K += t⊗r + r⊗t + c t⊗t, the last term by halves.
  template <class Matrix> void add_mean_terms(const MeanTerms<S>& terms, Matrix& k) {
    const typename S::Nodal across = terms.across + terms.along / 2 * terms.change;
    const auto dof = [](const typename S::Nodal& values, int i) { return values(i / S::d, i % S::d); };
    const auto size = static_cast<int>(k.rows());
    for (int j = 0; j < size; ++j) {
      const double t = dof(terms.change, j), r = dof(across, j);
      for (int i = 0; i < size; ++i)
        k(i, j) += dof(terms.change, i) * r + dof(across, i) * t;
    }
  }

  template <class Held> CellResult enhanced() {
    EnhancedCell<S, Held> modes(cell_);
    const auto result = modes.solve();
    if (!result)
      return result;
    cell_.conjugate = cell_.piola;
    if (wants_tangent()) {
      auto k = tangent();
      modes.put_tangent(k);
    }
    return with_force(result, cell_.gradients.no_force());
  }

  /// `force`: what acts beside the stresses.
  CellResult with_force(CellResult result, typename S::Nodal force) {
    for (int q = 0; q < cell_.count(); ++q)
      cell_.gradients.add_force(q, cell_.conjugate[place(q)], force);
    cell_.put_force(force);
    if (!std::isfinite(force.sum()))
      result.failure = Failure::not_finite;
    return result;
  }

  CellPoints<S> cell_;
};

} // namespace rubato::element
