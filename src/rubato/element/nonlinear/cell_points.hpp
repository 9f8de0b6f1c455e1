// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of a cell during an evaluation: what the laws see, and what they answer.
#pragma once

#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/cell_gradients.hpp"
#include "rubato/element/nonlinear/free_strains.hpp"

#include <array>
#include <cstddef>

namespace rubato::element {

template <class S> class CellPoints {
public:
  template <class T> using AtPoints = std::array<T, static_cast<std::size_t>(S::most_points)>;

  CellPoints(const CellKind& of_kind, const PointLaws& laws, const CellInput& given, const CellOutput& wanted)
      : kind(of_kind), input(given), output(wanted),
        gradients(reference_gradients(of_kind.type), given.points, of_kind.section), laws_(laws),
        free_strains_(of_kind.strain, laws, given.free_strain) {
    const auto u = gradients.by_component(given.displacement);
    for (int q = 0; q < count(); ++q)
      gradient[place(q)] = gradients.displacement_gradient(q, u);
  }

  int count() const { return gradients.points(); }
  bool is_small() const { return kind.strain == StrainKind::small; }
  static std::size_t place(int q) { return static_cast<std::size_t>(q); }
  std::size_t law_states() const { return place(count()) * place(laws_.state_size()); }

  /// Strains of `seen`, responses, and their stored energy and P.
  CellResult respond(material::Want want) {
    for (int q = 0; q < count(); ++q) {
      if (!is_small() && !(volume_change(seen[place(q)].h) > -1 && free_strains_.is_possible(place(q))))
        return {Failure::inverted, q};
      strain[place(q)] = strain_of(kind.strain, seen[place(q)]);
      free_strains_.take_from(place(q), strain[place(q)]);
    }
    const auto size = place(count());
    const auto failed = laws_.respond({{strain.data(), size},
                                       input.old.first(law_states()),
                                       output.now.first(law_states()),
                                       input.step,
                                       want,
                                       {response.data(), size}});
    if (failed < size)
      return {Failure::law, static_cast<int>(failed)};
    return answered();
  }

  /// A of a point for small strain, volume and the symmetric part only.
  material::Tangent6 weighted_tangent(int q) const {
    const auto& d = response[place(q)].tangent;
    return (0.5 * gradients.weight(q)) * (d + d.transpose());
  }

  /// A of a point for large motions.
  void put_moduli(int q, Moduli& moduli) const {
    material::Response symmetric = response[place(q)];
    const double shrinking = free_strains_.shrinking(place(q));
    symmetric.stress *= shrinking;
    symmetric.tangent =
        (0.5 * shrinking * shrinking) * (response[place(q)].tangent + response[place(q)].tangent.transpose());
    first_moduli(kind.strain, seen[place(q)], symmetric, moduli);
  }

  void set_moduli(SmallModuli<S>& moduli) const {
    for (int q = 0; q < count(); ++q)
      moduli.at[place(q)] = weighted_tangent(q);
  }

  void set_moduli(LargeModuli<S>& moduli) const {
    for (int q = 0; q < count(); ++q) {
      put_moduli(q, moduli.at[place(q)]);
      moduli.at[place(q)] *= gradients.weight(q);
    }
  }

  void put_force(const typename S::Nodal& force) const {
    for (int i = 0; i < gradients.nodes(); ++i)
      for (int a = 0; a < S::d; ++a)
        output.force[place(i * S::d + a)] = force(i, a);
  }

  void put_records() const {
    for (std::size_t q = 0; q < output.records.size(); ++q)
      output.records[q] = {gradients.weight(static_cast<int>(q)),
                           response[q].stored,
                           strain[q],
                           free_strains_.at(q),
                           response[q].stress,
                           cauchy_stress(kind.strain, seen[q].h, piola[q]),
                           gradient[q],
                           conjugate[q]};
  }

  const CellKind& kind;
  const CellInput& input;
  const CellOutput& output;
  CellGradients<S> gradients;
  AtPoints<Eigen::Matrix3d> gradient; ///< H, to which `conjugate` belongs
  AtPoints<Deformation> seen;         ///< by the law
  AtPoints<material::Strain6> strain;
  AtPoints<material::Response> response;
  AtPoints<Eigen::Matrix3d> piola;     ///< of what is seen
  AtPoints<Eigen::Matrix3d> conjugate; ///< P_c

private:
  CellResult answered() {
    CellResult result;
    for (int q = 0; q < count(); ++q) {
      result.stored += gradients.weight(q) * response[place(q)].stored;
      const material::Stress6 stress = free_strains_.shrinking(place(q)) * response[place(q)].stress;
      piola[place(q)] = first_piola(kind.strain, seen[place(q)], stress);
    }
    return result;
  }

  const PointLaws& laws_;
  FreeStrains free_strains_;
};

} // namespace rubato::element
