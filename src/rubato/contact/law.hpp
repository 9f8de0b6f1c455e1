// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a contact point answers to its gap, slip and multipliers: the traction on the slave and, for methods
/// with multipliers, the equations that determine them. Laws know nothing about meshes.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <string_view>

namespace rubato::contact {

enum class Status : std::uint8_t { open, stick, slip };

/// The variables of a point, in this order: g, Δs₁, Δs₂, λ, Λ₁, Λ₂.
struct PointState {
  double gap = 0;                                 ///< > 0 open [length]
  Eigen::Vector2d slip = Eigen::Vector2d::Zero(); ///< since the start of the step [length]
  double pressure = 0;                            ///< multiplier λ ≥ 0 [pressure]
  Eigen::Vector2d semi = Eigen::Vector2d::Zero(); ///< Λ, |Λ| ≤ 1
};

struct PointCoefficients {
  double friction = 0;      ///< μ
  double normal = 0;        ///< c [pressure/length]
  double tangential = 0;    ///< c_t [1/length]
  double gap_tolerance = 0; ///< an open point closes when it penetrates more than that [length]
  int tangents = 2;         ///< tangential directions: 1 in 2D
};

/// Traction on the slave side T = traction[0] n + traction[1] τ₁ + traction[2] τ₂ and the residuals of the
/// equations for λ, Λ₁, Λ₂, with their derivatives with respect to the six variables.
struct PointResponse {
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 6> d_traction = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Vector3d equations = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 6> d_equations = Eigen::Matrix<double, 3, 6>::Zero();
};

/// Contact iff λ − c g > 0, stick iff |Λ + c_t Δs| ≤ 1 (Alart and Curnier, Comput. Methods Appl. Mech. Eng.
/// 92, 1991, in the form of Code_Aster R5.03.52). Frictionless points in contact count as slipping.
Status augmented_lagrangian_status(const PointState& point, const PointCoefficients& coefficients);

/// In contact: p = λ − c g with g = 0 as λ's equation; tangential traction −μ λ ρ with ρ = Λ + c_t Δs and Δs
/// = 0 in stick, ρ = r/|r|, r = Λ + c_t Δs, and Λ = ρ in slip. Open: λ = 0, Λ = 0. In contact at λ ≤ 0 there
/// is no friction yet and Λ = 0.
PointResponse augmented_lagrangian(const PointState& point, Status status,
                                   const PointCoefficients& coefficients);

struct MethodEntry {
  std::string_view name;
  std::string_view code_aster;
  std::string_view summary;
};
/// Every way to enforce contact there is, for `rubato list` and the guide.
std::span<const MethodEntry> all_methods();

} // namespace rubato::contact
