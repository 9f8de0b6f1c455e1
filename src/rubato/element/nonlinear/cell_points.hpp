// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of a cell during an evaluation: what the laws see, and what they answer.
#pragma once

#include "rubato/element/nonlinear/cell_gradients.hpp"
#include "rubato/element/nonlinear/free_strains.hpp"
#include "rubato/element/nonlinear/kinematics.hpp"

#include <array>
#include <cstddef>

namespace rubato::element {

/// What a cell stores of each point.
struct PointValues {
  std::span<Eigen::Matrix3d> gradient; ///< H, to which `conjugate` belongs
  std::span<Deformation> seen;         ///< by the law
  std::span<material::Strain6> strain;
  std::span<material::Response> response;
  std::span<Eigen::Matrix3d> piola;     ///< of what is seen
  std::span<Eigen::Matrix3d> conjugate; ///< P_c
};

/// Memory of at most so many points: small cells touch little of it.
template <int most> class PointMemory {
public:
  PointValues first(int count) {
    const auto size = static_cast<std::size_t>(count);
    return {std::span(gradient_).first(size), std::span(seen_).first(size),
            std::span(strain_).first(size),   std::span(response_).first(size),
            std::span(piola_).first(size),    std::span(conjugate_).first(size)};
  }

private:
  template <class T> using Points = std::array<T, static_cast<std::size_t>(most)>;

  Points<Eigen::Matrix3d> gradient_;
  Points<Deformation> seen_;
  Points<material::Strain6> strain_;
  Points<material::Response> response_;
  Points<Eigen::Matrix3d> piola_, conjugate_;
};

class CellPoints {
public:
  /// Views all that it is given.
  CellPoints(const CellKind& of_kind, const PointLaws& laws, const CellInput& given, const CellOutput& wanted,
             const CellGradients& of_cell, const PointValues& values);

  int count() const { return gradients.points(); }
  bool is_small() const { return kind.strain == StrainKind::small; }
  std::size_t law_states() const { return at.seen.size() * static_cast<std::size_t>(laws_.state_size()); }

  /// Strains of `seen`, responses, and their stored energy and P.
  CellResult respond(material::Want want);

  /// A of a point for small strain, volume and the symmetric part only.
  void put_weighted_tangent(int q, material::Tangent6& tangent) const;
  /// A of a point for large motions.
  void put_moduli(int q, Moduli& moduli) const;
  /// A of all points, with their volumes.
  void set_moduli(std::span<material::Tangent6> moduli) const;
  void set_moduli(std::span<Moduli> moduli) const;

  void put_records() const;

  const CellKind& kind;
  const CellInput& input;
  const CellOutput& output;
  const CellGradients& gradients;
  NodalValues displacement;
  PointValues at;

private:
  CellResult answered();

  const PointLaws& laws_;
  FreeStrains free_strains_;
};

} // namespace rubato::element
