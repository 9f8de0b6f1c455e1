// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/law.hpp"

#include <algorithm>
#include <array>

namespace rubato::contact {
namespace {

using Eigen::Matrix2d;
using Eigen::RowVectorXd;
using Eigen::Vector2d;
using study::ContactMethod;
using study::FrictionMethod;

constexpr int gap = 0;
constexpr int slip = 1;
constexpr int pressure = 3;
constexpr int semi = 4;

using Row = Eigen::Matrix<double, 1, 6>;

/// Springs begin where a point counts as closed: a force that jumped there would leave no status that agrees
/// with its own gap.
double force_of_spring(const PointState& point, const PointLaw& law) {
  return -law.normal * (point.gap + law.gap_tolerance);
}

/// P with its derivatives, zero while it is held.
struct Threshold {
  double value = 0;
  Row derivative = Row::Zero();
};

Threshold threshold_of(const PointState& point, const PointLaw& law) {
  Threshold threshold;
  if (law.held_threshold) {
    threshold.value = *law.held_threshold;
  } else if (study::is_exact(law.method)) {
    threshold.value = point.pressure;
    threshold.derivative[pressure] = 1;
  } else {
    threshold.value = force_of_spring(point, law);
    threshold.derivative[gap] = -law.normal;
  }
  return threshold;
}

/// What friction compares with its limit, so that it sticks while the length is at most one.
Vector2d relative_friction(const PointState& point, const PointLaw& law) {
  switch (law.friction_method) {
  case FrictionMethod::augmented_lagrangian:
    return point.semi + law.tangential * point.slip;
  case FrictionMethod::penalty:
    return law.tangential * point.slip;
  case FrictionMethod::nodal_penalty:
    break;
  }
  return law.tangential / (law.friction * threshold_of(point, law).value) * point.slip;
}

/// Λ = 0
void free_semi_multipliers(const PointState& point, PointResponse& response) {
  response.equations.tail<2>() = point.semi;
  response.d_equations.block<2, 2>(1, semi).setIdentity();
}

void open_contact(const PointState& point, const PointLaw& law, PointResponse& response) {
  response.equations[0] = -point.pressure / law.normal;
  response.d_equations(0, pressure) = -1 / law.normal;
}

void close_contact(const PointState& point, const PointLaw& law, PointResponse& response) {
  const double stiffness = law.method == ContactMethod::nodal_pcg ? 0.0 : law.normal;
  response.traction[0] = study::is_exact(law.method) ? -stiffness * point.gap : force_of_spring(point, law);
  response.d_traction(0, gap) = -stiffness;
  if (!study::is_exact(law.method))
    return;
  response.traction[0] += point.pressure;
  response.d_traction(0, pressure) = 1;
  response.equations[0] = -point.gap;
  response.d_equations(0, gap) = -1;
}

/// v/|v| and its derivative.
struct Direction {
  Vector2d unit;
  Matrix2d derivative;
  explicit Direction(const Vector2d& v) : unit(v.normalized()) {
    derivative = (Matrix2d::Identity() - unit * unit.transpose()) / v.norm();
  }
};

/// 1/|v| beyond the unit circle.
double shrinking(const Vector2d& v) {
  return 1 / std::max(1.0, v.norm());
}

/// A spring since the start of the step, or the limit μ P against the slip.
void rub_by_spring(const PointState& point, Status status, const PointLaw& law, PointResponse& response) {
  if (status == Status::stick) {
    response.traction.tail<2>() = -law.tangential * point.slip;
    response.d_traction.block<2, 2>(1, slip) = -law.tangential * Matrix2d::Identity();
    response.kept_friction = shrinking(relative_friction(point, law));
    return;
  }
  const auto threshold = threshold_of(point, law);
  const Direction along(point.slip);
  response.traction.tail<2>() = -law.friction * threshold.value * along.unit;
  response.d_traction.bottomRows<2>() = -law.friction * along.unit * threshold.derivative;
  response.d_traction.block<2, 2>(1, slip) -= law.friction * threshold.value * along.derivative;
}

/// −μ P ρ; with semi-multipliers also the equation Λ = ρ, which in stick is c_t Δs = 0.
void rub_by_saturation(const PointState& point, Status status, const PointLaw& law, PointResponse& response) {
  const bool multipliers = law.friction_method == FrictionMethod::augmented_lagrangian;
  const auto threshold = threshold_of(point, law);
  Vector2d rho = relative_friction(point, law);
  Matrix2d d_rho = Matrix2d::Identity();
  if (status == Status::slip) {
    const Direction along(rho);
    rho = along.unit;
    d_rho = along.derivative;
  }
  const double limit = law.friction * threshold.value;
  response.traction.tail<2>() = -limit * rho;
  if (!multipliers)
    response.kept_friction = shrinking(rho);
  response.d_traction.bottomRows<2>() = -law.friction * rho * threshold.derivative;
  response.d_traction.block<2, 2>(1, slip) -= limit * law.tangential * d_rho;
  if (!multipliers)
    return;
  response.d_traction.block<2, 2>(1, semi) -= limit * d_rho;
  response.equations.tail<2>() = point.semi - rho;
  response.d_equations.block<2, 2>(1, semi) = Matrix2d::Identity() - d_rho;
  response.d_equations.block<2, 2>(1, slip) = -law.tangential * d_rho;
}

bool rubs(const PointState& point, Status status, const PointLaw& law) {
  return status != Status::open && law.friction > 0 && threshold_of(point, law).value > 0 &&
         (status == Status::stick || relative_friction(point, law).norm() > 0);
}

/// T_n of a point that closes is to be more than what rounding of its gap makes. Conjugate gradients find
/// forces that are positive or zero.
bool touches(const PointState& point, const PointLaw& law) {
  if (law.method == ContactMethod::nodal_pcg)
    return point.pressure > 0;
  const double pushed = force_of_spring(point, law);
  if (!study::is_exact(law.method))
    return pushed > 0;
  const double held = -law.normal * point.gap;
  return point.pressure > 0 ? point.pressure + held > 0 : point.pressure + pushed > 0;
}

} // namespace

std::string_view to_string(Status status) {
  switch (status) {
  case Status::open:
    return "open";
  case Status::stick:
    return "sticks";
  case Status::slip:
    return "slips";
  }
  return "";
}

namespace {

/// A point that has just closed has no friction yet (Λ = 0). Pulled back over the slip that it comes with, it
/// would need more than its limit: c_t, which knows nothing of pressures, may call that sticking, and the
/// pull opens points beside it.
bool comes_sliding(const PointState& point, const PointLaw& law) {
  return law.friction_method == FrictionMethod::augmented_lagrangian && point.semi.isZero(0) &&
         law.resistance * point.slip.norm() > law.friction * threshold_of(point, law).value;
}

} // namespace

Status wanted_status(const PointState& point, const PointLaw& law) {
  if (!touches(point, law))
    return Status::open;
  const bool sticks = law.friction > 0 && threshold_of(point, law).value > 0 &&
                      relative_friction(point, law).norm() <= 1 && !comes_sliding(point, law);
  return sticks ? Status::stick : Status::slip;
}

PointResponse respond(const PointState& point, Status status, const PointLaw& law) {
  PointResponse response;
  if (status == Status::open)
    open_contact(point, law, response);
  else
    close_contact(point, law, response);
  if (!rubs(point, status, law))
    free_semi_multipliers(point, response);
  else if (law.friction_method == FrictionMethod::nodal_penalty)
    rub_by_spring(point, status, law, response);
  else
    rub_by_saturation(point, status, law, response);
  return response;
}

double friction_pressure(const PointState& point, const PointLaw& law) {
  return std::max(0.0, threshold_of(point, law).value);
}

std::span<const MethodEntry> all_methods() {
  static constexpr std::array<MethodEntry, 5> entries{{
      {"augmented_lagrangian", "CONTINUE, ALGO_CONT='STANDARD'",
       "exact contact by pressures on the slave side"},
      {"penalty", "CONTINUE, ALGO_CONT='PENALISATION'", "pressure grows with penetration"},
      {"nodal_lagrange", "DISCRETE, ALGO_CONT='LAGRANGIEN'", "exact contact by one force a slave node"},
      {"nodal_penalty", "DISCRETE, ALGO_CONT='PENALISATION'", "a slave node's force grows with penetration"},
      {"nodal_pcg", "DISCRETE, ALGO_CONT='GCP'",
       "nodal_lagrange without friction by projected conjugate gradients"},
  }};
  return entries;
}

std::span<const MethodEntry> all_friction_methods() {
  static constexpr std::array<MethodEntry, 3> entries{{
      {"augmented_lagrangian", "CONTINUE, ALGO_FROT='STANDARD'", "exact stick and slip by multipliers"},
      {"penalty", "CONTINUE, ALGO_FROT='PENALISATION'", "friction grows with slip up to Coulomb's limit"},
      {"nodal_penalty", "DISCRETE, ALGO_FROT='PENALISATION'",
       "a slave node's spring since the start of the step, up to Coulomb's limit"},
  }};
  return entries;
}

} // namespace rubato::contact
