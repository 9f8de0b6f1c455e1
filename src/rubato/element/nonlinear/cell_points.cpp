// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/cell_points.hpp"

namespace rubato::element {
namespace {

/// The symmetric part, times `factor`.
void put_symmetric(const material::Tangent6& tangent, double factor, material::Tangent6& symmetric) {
  const double half = 0.5 * factor;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      symmetric(i, j) = half * (tangent(i, j) + tangent(j, i));
}

} // namespace

CellPoints::CellPoints(const CellKind& of_kind, const PointLaws& laws, const CellInput& given,
                       const CellOutput& wanted, const CellGradients& of_cell, const PointValues& values)
    : kind(of_kind), input(given), output(wanted), gradients(of_cell),
      displacement(of_cell.by_component(given.displacement)), at(values), laws_(laws),
      free_strains_(of_kind.strain, laws, given.free_strain) {
  gradients.set_displacement_gradients(displacement, at.gradient);
}

CellResult CellPoints::respond(material::Want want) {
  for (std::size_t q = 0; q < at.seen.size(); ++q) {
    if (!is_small() && !(volume_change(at.seen[q].h) > -1 && free_strains_.is_possible(q)))
      return {Failure::inverted, static_cast<int>(q)};
    at.strain[q] = strain_of(kind.strain, at.seen[q]);
    free_strains_.take_from(q, at.strain[q]);
  }
  const auto failed = laws_.respond({at.strain, input.old.first(law_states()), output.now.first(law_states()),
                                     input.step, want, at.response});
  if (failed < at.seen.size())
    return {Failure::law, static_cast<int>(failed)};
  return answered();
}

CellResult CellPoints::answered() {
  CellResult result;
  for (std::size_t q = 0; q < at.seen.size(); ++q) {
    result.stored += gradients.weight(static_cast<int>(q)) * at.response[q].stored;
    const material::Stress6 stress = free_strains_.shrinking(q) * at.response[q].stress;
    at.piola[q] = first_piola(kind.strain, at.seen[q], stress);
  }
  return result;
}

void CellPoints::put_weighted_tangent(int q, material::Tangent6& tangent) const {
  put_symmetric(at.response[place(q)].tangent, gradients.weight(q), tangent);
}

void CellPoints::put_moduli(int q, Moduli& moduli) const {
  const auto& response = at.response[place(q)];
  const double shrinking = free_strains_.shrinking(place(q));
  material::Response symmetric;
  symmetric.stress = shrinking * response.stress;
  put_symmetric(response.tangent, shrinking * shrinking, symmetric.tangent);
  first_moduli(kind.strain, at.seen[place(q)], symmetric, moduli);
}

void CellPoints::set_moduli(std::span<material::Tangent6> moduli) const {
  for (int q = 0; q < count(); ++q)
    put_weighted_tangent(q, moduli[place(q)]);
}

void CellPoints::set_moduli(std::span<Moduli> moduli) const {
  for (int q = 0; q < count(); ++q) {
    put_moduli(q, moduli[place(q)]);
    moduli[place(q)] *= gradients.weight(q);
  }
}

void CellPoints::put_records() const {
  for (std::size_t q = 0; q < output.records.size(); ++q) {
    const auto& response = at.response[q];
    output.records[q] = {gradients.weight(static_cast<int>(q)),
                         response.stored,
                         at.strain[q],
                         free_strains_.at(q),
                         response.stress,
                         cauchy_stress(kind.strain, at.seen[q].h, at.piola[q]),
                         at.gradient[q],
                         at.conjugate[q]};
  }
}

} // namespace rubato::element
