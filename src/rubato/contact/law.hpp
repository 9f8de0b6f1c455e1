// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a contact point answers to its gap, slip and multipliers: the traction on the slave and, for methods
/// with multipliers, the equations that determine them. Laws know nothing about meshes.
///
/// Normal part. Exact methods: T_n = λ − c g with the equation g = 0 in contact, λ = 0 apart (Alart and
/// Curnier, Comput. Methods Appl. Mech. Eng. 92, 1991, in the form of Code_Aster R5.03.52).
/// Penalty ones: T_n = k ⟨−g⟩. Exponential: T_n = p(g) from a clearance on (exponential.hpp).
/// Tangential part, P being the pressure friction is measured by (λ, or T_n of a penalty): augmented
/// Lagrangian −μ P ρ, ρ = Λ + c_t Δs in stick with the equation Δs = 0, ρ = r/|r|, r = Λ + c_t Δs in slip
/// with Λ = ρ. Penalty: the same without Λ. Nodal penalty: −E Δs in stick, −μ P Δs/|Δs| in slip.
/// Nodal methods read "force of a node" wherever "pressure" stands.
/// Tied: T = (λ, Λ₁, Λ₂) with the equations g = 0, Δs₁ = 0, Δs₂ = 0, whatever the signs.
#pragma once

#include "rubato/contact/exponential.hpp"
#include "rubato/contact/status.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string_view>

namespace rubato::contact {

/// The variables of a point, in this order: g, Δs₁, Δs₂, λ, Λ₁, Λ₂.
struct PointState {
  double gap = 0;                                 ///< > 0 open [length]
  Eigen::Vector2d slip = Eigen::Vector2d::Zero(); ///< since the start of the step [length]
  double pressure = 0;                            ///< multiplier λ ≥ 0 [pressure]
  Eigen::Vector2d semi = Eigen::Vector2d::Zero(); ///< Λ, |Λ| ≤ 1
};

struct PointLaw {
  study::ContactMethod method = study::ContactMethod::augmented_lagrangian;
  study::FrictionMethod friction_method = study::FrictionMethod::augmented_lagrangian;
  double friction = 0;      ///< μ
  double normal = 0;        ///< c or k [pressure/length]
  double tangential = 0;    ///< c_t or k_t [1/length]; nodal: E [force/length]
  double gap_tolerance = 0; ///< an open point closes when it penetrates more than that [length]
  int tangents = 2;         ///< tangential directions: 1 in 2D
  /// P while an outer loop holds it; follows the point otherwise.
  std::optional<double> frozen_friction_pressure;
  exponential::Numbers exponential{}; ///< of that method
  bool stays_closed = false;          ///< it has touched, and is bilateral
  bool tied = false;                  ///< λ, Λ₁, Λ₂ are tractions that hold gap and slips at 0
  /// A unit vector among τ₁, τ₂, where friction acts along it alone (shared_nodes.hpp).
  std::optional<Eigen::Vector2d> rubs_along = std::nullopt;
  double resistance = 0; ///< of the body against a slip of the point [pressure/length]; 0: not known
};

/// Traction on the slave side T = traction[0] n + traction[1] τ₁ + traction[2] τ₂ and the residuals of the
/// equations for λ, Λ₁, Λ₂, with their derivatives with respect to the six variables.
struct PointResponse {
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 6> d_traction = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Vector3d equations = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 6> d_equations = Eigen::Matrix<double, 3, 6>::Zero();
  /// Part of the friction that tangents are to turn with the frame and to move with the place. Less than one
  /// of a spring that sticks beyond its limit: the point is on its way to a slip within it.
  double kept_friction = 1;

  Eigen::Vector3d kept_traction() const {
    return {traction[0], kept_friction * traction[1], kept_friction * traction[2]};
  }
};

/// The status that the present variables call for: in contact iff T_n > 0 or the point stays closed
/// (`stays_closed`); sticking iff friction stays below its limit and the point does not come sliding
/// (FrictionLaw::comes_sliding). Tied points stick. Frictionless points in contact count as slipping.
Status wanted_status(const PointState& point, const PointLaw& law);

/// Traction and equations of a point of that status. In contact without pressure there is no friction yet
/// and Λ = 0.
PointResponse respond(const PointState& point, Status status, const PointLaw& law);

/// P, the pressure that friction is measured by, at a point in contact; never negative.
double friction_pressure(const PointState& point, const PointLaw& law);

/// The pressure that friction is measured by, and its derivatives with respect to the six variables.
struct FrictionPressure {
  double value = 0;
  Eigen::Matrix<double, 1, 6> derivative = Eigen::Matrix<double, 1, 6>::Zero();
};

/// What the coefficient of a law is to the answer: an augmentation only leads to it, a spring is part of the
/// model, gives way and shows.
struct Coefficient {
  bool is_spring;
  /// By a multiple that an attempt at a step is tried with.
  double (*scaled)(double value, double multiple);
  /// Taken to at most `most` where it may follow the step at hand.
  double (*limited)(double value, double most);
  /// In a step of another length than the usual one, given what the effective matrices of both make of it.
  double (*at_length)(double here, double usual);
  /// Of a spring whose stiffness does not depend on the pressure [force/length]; else 0.
  double (*stiffness)(double value);
  /// Penetration a unit of force [length/force]; `exact` where none belongs to the answer.
  double (*compliance)(double stiffness, double exact);
};

/// A normal spring near a state, as a line: p = stiffness (rest_gap − g).
struct SpringLine {
  double rest_gap = 0;  ///< [length]
  double stiffness = 0; ///< [pressure/length]
};

/// What sets the normal parts apart: a row each.
struct NormalLaw {
  study::ContactMethod method;
  const Coefficient* coefficient;
  double multiple; ///< c or k that is chosen by itself, in units of what the slave side resists
  /// Whether the variables call for contact: T_n > 0.
  bool (*touches)(const PointState&, const PointLaw&);
  /// Traction and equation in contact.
  void (*close)(const PointState&, const PointLaw&, PointResponse&);
  FrictionPressure (*friction_pressure)(const PointState&, const PointLaw&);
  /// −dp/dg of a spring, whether the point touches or not; 0 of an augmentation [pressure/length].
  double (*stiffness)(const PointState&, const PointLaw&);
  /// The spring near the pressure of a point, near its gap while it has none.
  SpringLine (*line)(const PointState&, const PointLaw&);
  /// Energy that a spring holds at a gap, over the force that it presses with; 0 of an augmentation [length].
  double (*energy_length)(double gap, const study::ContactZone&);
  /// The gap below which points press [length].
  double (*reach)(const study::ContactZone&);
};

/// What sets the tangential parts apart: a row each.
struct FrictionLaw {
  study::FrictionMethod method;
  const Coefficient* role; ///< of c_t, k_t or E
  /// c_t, k_t or E that is chosen by itself, given what the slave side resists [pressure/length] and the
  /// zone's edge [length].
  double (*coefficient)(double resistance, double edge);
  /// What friction compares with its limit: it sticks while the length is at most one.
  Eigen::Vector2d (*relative_friction)(const PointState&, const PointLaw&);
  /// Whether a point that friction has not held before slips whatever its relative friction.
  bool (*comes_sliding)(const PointState&, const PointLaw&);
  /// Traction and equations of a point that sticks or slips with some pressure.
  void (*rub)(const PointState&, Status, const PointLaw&, PointResponse&);
  /// Stiffness of a spring that the pressure makes, while it sticks [pressure/length].
  double (*stiffness)(const PointState&, const PointLaw&);
  /// Whether points may stick on their way from one slip to the opposite one (spring_friction.hpp).
  bool sticks_in_passing;
  /// Which points stick and which slip is often not unique: steps then start from the last one's statuses,
  /// as other codes do.
  bool starts_from_last_step;
};

const NormalLaw& normal_law(study::ContactMethod method);
const FrictionLaw& friction_law(study::FrictionMethod method);

} // namespace rubato::contact
