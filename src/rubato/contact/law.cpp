// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/law.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <array>

namespace rubato::contact {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;
using study::ContactMethod;
using study::FrictionMethod;

constexpr int gap = 0;
constexpr int slip = 1;
constexpr int pressure = 3;
constexpr int semi = 4;

/// Part of the clearance beyond which no tangent of an exponential pressure is taken.
constexpr double widest_tangent = 0.99;

/// Springs begin where a point counts as closed: a force that jumped there would leave no status that agrees
/// with its own gap.
double force_of_spring(const PointState& point, const PointLaw& law) {
  return -law.normal * (point.gap + law.gap_tolerance);
}

FrictionPressure pressure_of_multiplier(const PointState& point, const PointLaw& /*law*/) {
  FrictionPressure result;
  result.value = point.pressure;
  result.derivative[pressure] = 1;
  return result;
}

FrictionPressure pressure_of_spring(const PointState& point, const PointLaw& law) {
  FrictionPressure result;
  result.value = force_of_spring(point, law);
  result.derivative[gap] = -law.normal;
  return result;
}

/// P with its derivatives, zero while it is held.
FrictionPressure friction_pressure_of(const PointState& point, const PointLaw& law) {
  if (law.frozen_friction_pressure)
    return {.value = *law.frozen_friction_pressure};
  return normal_law(law.method).friction_pressure(point, law);
}

Vector2d relative_to_multiplier(const PointState& point, const PointLaw& law) {
  return {point.semi[0] + law.tangential * point.slip[0], point.semi[1] + law.tangential * point.slip[1]};
}

Vector2d relative_to_saturation(const PointState& point, const PointLaw& law) {
  return scaled(law.tangential, point.slip);
}

Vector2d relative_to_limit(const PointState& point, const PointLaw& law) {
  return scaled(law.tangential / (law.friction * friction_pressure_of(point, law).value), point.slip);
}

Vector2d relative_friction(const PointState& point, const PointLaw& law) {
  return friction_law(law.friction_method).relative_friction(point, law);
}

/// Λ = 0
void free_semi_multipliers(const PointState& point, PointResponse& response) {
  for (int a = 0; a < 2; ++a) {
    response.equations[1 + a] = point.semi[a];
    response.d_equations(1 + a, semi + a) = 1;
  }
}

void open_contact(const PointState& point, const PointLaw& law, PointResponse& response) {
  response.equations[0] = -point.pressure / law.normal;
  response.d_equations(0, pressure) = -1 / law.normal;
}

/// T_n = λ − c g and g = 0
void close_by_augmentation(const PointState& point, const PointLaw& law, PointResponse& response) {
  response.traction[0] = -law.normal * point.gap + point.pressure;
  response.d_traction(0, gap) = -law.normal;
  response.d_traction(0, pressure) = 1;
  response.equations[0] = -point.gap;
  response.d_equations(0, gap) = -1;
}

void close_by_spring(const PointState& point, const PointLaw& law, PointResponse& response) {
  response.traction[0] = force_of_spring(point, law);
  response.d_traction(0, gap) = -law.normal;
}

FrictionPressure pressure_of_exponential(const PointState& point, const PointLaw& law) {
  FrictionPressure result;
  result.value = exponential::pressure(point.gap, law.exponential);
  result.derivative[gap] = -exponential::stiffness(point.gap, law.exponential);
  return result;
}

void close_exponentially(const PointState& point, const PointLaw& law, PointResponse& response) {
  const auto spring = pressure_of_exponential(point, law);
  response.traction[0] = spring.value;
  response.d_traction(0, gap) = spring.derivative[gap];
}

PointResponse hold(const PointState& point) {
  PointResponse response;
  response.traction = {point.pressure, point.semi[0], point.semi[1]};
  response.equations = {-point.gap, -point.slip[0], -point.slip[1]};
  for (int i = 0; i < 3; ++i) {
    response.d_traction(i, pressure + i) = 1;
    response.d_equations(i, gap + i) = -1;
  }
  return response;
}

/// v/|v| and its derivative.
struct Direction {
  Vector2d unit;
  Matrix2d derivative;
  explicit Direction(const Vector2d& v) : unit(v) {
    const double length = length_of(v);
    if (length > 0)
      unit = {v[0] / length, v[1] / length};
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        derivative(a, b) = ((a == b ? 1 : 0) - unit[a] * unit[b]) / length;
  }
};

/// 1/|v| beyond the unit circle.
double shrinking(const Vector2d& v) {
  return 1 / std::max(1.0, length_of(v));
}

/// Adds factor · block to the tangential rows, at the two columns from `first` on.
void add_block(double factor, const Matrix2d& block, int first, Matrix36& rows) {
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 2; ++a)
      rows(1 + a, first + b) += factor * block(a, b);
}

/// −μ P ρ, and what it owes to the change of P.
void limit_friction(double friction, const FrictionPressure& threshold, const Vector2d& rho,
                    PointResponse& response) {
  for (int a = 0; a < 2; ++a) {
    response.traction[1 + a] = -friction * threshold.value * rho[a];
    for (int variable = 0; variable < 6; ++variable)
      response.d_traction(1 + a, variable) = -friction * rho[a] * threshold.derivative[variable];
  }
}

/// A spring since the start of the step, or the limit μ P against the slip.
void rub_by_spring(const PointState& point, Status status, const PointLaw& law, PointResponse& response) {
  if (status == Status::stick) {
    for (int a = 0; a < 2; ++a) {
      response.traction[1 + a] = -law.tangential * point.slip[a];
      response.d_traction(1 + a, slip + a) = -law.tangential;
    }
    response.kept_friction = shrinking(relative_friction(point, law));
    return;
  }
  const auto threshold = friction_pressure_of(point, law);
  const Direction along(point.slip);
  limit_friction(law.friction, threshold, along.unit, response);
  add_block(-law.friction * threshold.value, along.derivative, slip, response.d_traction);
}

/// −μ P ρ with ρ = `relative` in stick and its direction in slip, and what ρ is made of.
struct Saturation {
  double limit;
  Vector2d rho;
  Matrix2d d_rho = Matrix2d::Identity(); ///< by `relative`
};

Saturation saturate(const PointState& point, Status status, const PointLaw& law, PointResponse& response) {
  const auto threshold = friction_pressure_of(point, law);
  Saturation result{law.friction * threshold.value, relative_friction(point, law)};
  if (status == Status::slip) {
    const Direction along(result.rho);
    result.rho = along.unit;
    result.d_rho = along.derivative;
  }
  limit_friction(law.friction, threshold, result.rho, response);
  add_block(-result.limit * law.tangential, result.d_rho, slip, response.d_traction);
  return result;
}

void rub_by_saturation(const PointState& point, Status status, const PointLaw& law, PointResponse& response) {
  response.kept_friction = shrinking(saturate(point, status, law, response).rho);
}

/// With semi-multipliers also the equation Λ = ρ, which in stick is c_t Δs = 0.
void rub_by_multiplier(const PointState& point, Status status, const PointLaw& law, PointResponse& response) {
  const auto saturation = saturate(point, status, law, response);
  add_block(-saturation.limit, saturation.d_rho, semi, response.d_traction);
  for (int a = 0; a < 2; ++a) {
    response.equations[1 + a] = point.semi[a] - saturation.rho[a];
    response.d_equations(1 + a, semi + a) = 1;
  }
  add_block(-1, saturation.d_rho, semi, response.d_equations);
  add_block(-law.tangential, saturation.d_rho, slip, response.d_equations);
}

bool rubs(const PointState& point, Status status, const PointLaw& law) {
  return status != Status::open && law.friction > 0 && friction_pressure_of(point, law).value > 0 &&
         (status == Status::stick || length_of(relative_friction(point, law)) > 0);
}

// T_n of a point that closes is to be more than what rounding of its gap makes.

bool compresses_spring(const PointState& point, const PointLaw& law) {
  return force_of_spring(point, law) > 0;
}

bool is_within_clearance(const PointState& point, const PointLaw& law) {
  return point.gap + law.gap_tolerance < exponential::reach(law.exponential);
}

bool presses(const PointState& point, const PointLaw& law) {
  const double pushed = point.pressure > 0 ? -law.normal * point.gap : force_of_spring(point, law);
  return point.pressure + pushed > 0;
}

/// A point that has just closed has no friction yet (Λ = 0). Pulled back over the slip that it comes with, it
/// would need more than its limit: c_t, which knows nothing of pressures, may call that sticking, and the
/// pull opens points beside it.
bool comes_sliding(const PointState& point, const PointLaw& law) {
  return point.semi[0] == 0 && point.semi[1] == 0 &&
         law.resistance * length_of(point.slip) > law.friction * friction_pressure_of(point, law).value;
}

bool never(const PointState& /*point*/, const PointLaw& /*law*/) {
  return false;
}

double automatic_augmentation(double /*resistance*/, double edge) {
  return 1 / (tolerances.saturation_slip * edge);
}
double automatic_penalty(double resistance, double edge) {
  return tolerances.penalty_stiffening * automatic_augmentation(resistance, edge);
}
double automatic_spring(double resistance, double /*edge*/) {
  return tolerances.friction_spring_share * resistance;
}

double no_stiffness(const PointState& /*point*/, const PointLaw& /*law*/) {
  return 0;
}
double saturation_stiffness(const PointState& point, const PointLaw& law) {
  return law.friction * law.tangential * friction_pressure(point, law);
}

double augmentation_stiffness(const PointState& /*point*/, const PointLaw& /*law*/) {
  return 0;
}
double spring_stiffness(const PointState& /*point*/, const PointLaw& law) {
  return law.normal;
}
SpringLine line_through_contact(const PointState& /*point*/, const PointLaw& law) {
  return {.rest_gap = 0, .stiffness = law.normal};
}
double no_energy(double /*now*/, const study::ContactZone& /*zone*/) {
  return 0;
}
double half_of_penetration(double now, const study::ContactZone& /*zone*/) {
  return now < 0 ? -0.5 * now : 0.0;
}
double at_contact(const study::ContactZone& /*zone*/) {
  return 0;
}

double exponential_stiffness(const PointState& point, const PointLaw& law) {
  return exponential::stiffness(point.gap, law.exponential);
}
/// Of a point without pressure: the tangent at its gap, not far from the gaps between 0 and the clearance.
/// Deeper ones are too stiff to lead to the pressure, at the clearance there is no stiffness.
SpringLine tangent_of_exponential(const PointState& point, const PointLaw& law) {
  const auto& numbers = law.exponential;
  const double now = point.pressure > 0 ? exponential::gap_of(point.pressure, numbers)
                                        : std::clamp(point.gap, 0.0, widest_tangent * numbers.clearance);
  const double stiffness = exponential::stiffness(now, numbers);
  return {.rest_gap = now + exponential::pressure(now, numbers) / stiffness, .stiffness = stiffness};
}
double exponential_energy(double now, const study::ContactZone& zone) {
  return exponential::energy_length(now, exponential::numbers_of(zone));
}
double at_reach(const study::ContactZone& zone) {
  return exponential::reach(exponential::numbers_of(zone));
}

double product(double value, double multiple) {
  return value * multiple;
}
double first_of(double value, double /*other*/) {
  return value;
}
double second_of(double /*value*/, double other) {
  return other;
}
double smaller(double value, double most) {
  return std::min(value, most);
}
double zero(double /*value*/) {
  return 0;
}
double same(double value) {
  return value;
}
double inverse(double stiffness, double /*exact*/) {
  return 1 / stiffness;
}

constexpr Coefficient augmentation{.is_spring = false,
                                   .scaled = &product,
                                   .limited = &smaller,
                                   .at_length = &first_of,
                                   .stiffness = &zero,
                                   .compliance = &second_of};
constexpr Coefficient spring{.is_spring = true,
                             .scaled = &first_of,
                             .limited = &first_of,
                             .at_length = &second_of,
                             .stiffness = &same,
                             .compliance = &inverse};
/// Stiff by the pressure that it limits: μ P k_t.
constexpr Coefficient saturation{.is_spring = true,
                                 .scaled = &first_of,
                                 .limited = &first_of,
                                 .at_length = &first_of,
                                 .stiffness = &zero,
                                 .compliance = &inverse};

constexpr NormalLaw augmented(ContactMethod method) {
  return {.method = method,
          .coefficient = &augmentation,
          .multiple = 1,
          .touches = &presses,
          .close = &close_by_augmentation,
          .friction_pressure = &pressure_of_multiplier,
          .stiffness = &augmentation_stiffness,
          .line = &line_through_contact,
          .energy_length = &no_energy,
          .reach = &at_contact};
}
constexpr NormalLaw penalized(ContactMethod method) {
  return {.method = method,
          .coefficient = &spring,
          .multiple = tolerances.penalty_stiffening,
          .touches = &compresses_spring,
          .close = &close_by_spring,
          .friction_pressure = &pressure_of_spring,
          .stiffness = &spring_stiffness,
          .line = &line_through_contact,
          .energy_length = &half_of_penetration,
          .reach = &at_contact};
}

constexpr NormalLaw by_exponential{.method = ContactMethod::exponential,
                                   .coefficient = &spring,
                                   .multiple = 1,
                                   .touches = &is_within_clearance,
                                   .close = &close_exponentially,
                                   .friction_pressure = &pressure_of_exponential,
                                   .stiffness = &exponential_stiffness,
                                   .line = &tangent_of_exponential,
                                   .energy_length = &exponential_energy,
                                   .reach = &at_reach};

/// In the order of the methods.
constexpr std::array<NormalLaw, 6> normal_laws{
    {augmented(ContactMethod::augmented_lagrangian), penalized(ContactMethod::penalty),
     augmented(ContactMethod::nodal_lagrange), penalized(ContactMethod::nodal_penalty),
     augmented(ContactMethod::nodal_pcg), by_exponential}};

constexpr std::array<FrictionLaw, 3> friction_laws{{
    {FrictionMethod::augmented_lagrangian, &augmentation, &automatic_augmentation, &relative_to_multiplier,
     &comes_sliding, &rub_by_multiplier, &no_stiffness, false, false},
    {FrictionMethod::penalty, &saturation, &automatic_penalty, &relative_to_saturation, &never,
     &rub_by_saturation, &saturation_stiffness, true, false},
    {FrictionMethod::nodal_penalty, &spring, &automatic_spring, &relative_to_limit, &never, &rub_by_spring,
     &no_stiffness, true, true},
}};

/// What friction that acts along one direction sees of a point.
PointState along(const Vector2d& direction, PointState point) {
  point.slip = scaled(dot(direction, point.slip), direction);
  point.semi = scaled(dot(direction, point.semi), direction);
  return point;
}

PointLaw in_all_directions(PointLaw law) {
  law.rubs_along.reset();
  return law;
}

/// Leaves of a derivative by two tangential variables what is along the direction.
void project_columns(const Vector2d& direction, int variable, Matrix36& derivative) {
  for (int row = 0; row < 3; ++row) {
    const double along =
        derivative(row, variable) * direction[0] + derivative(row, variable + 1) * direction[1];
    derivative(row, variable) = along * direction[0];
    derivative(row, variable + 1) = along * direction[1];
  }
}

/// The answer along one direction; across it Λ = 0.
PointResponse respond_along(const Vector2d& direction, const PointState& point, Status status,
                            const PointLaw& law) {
  auto response = respond(along(direction, point), status, in_all_directions(law));
  for (const int variable : {slip, semi})
    for (auto* derivative : {&response.d_traction, &response.d_equations})
      project_columns(direction, variable, *derivative);
  const double part = dot(direction, point.semi);
  for (int a = 0; a < 2; ++a) {
    response.equations[1 + a] += point.semi[a] - part * direction[a];
    for (int b = 0; b < 2; ++b)
      response.d_equations(1 + a, semi + b) += (a == b ? 1 : 0) - direction[a] * direction[b];
  }
  return response;
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

const NormalLaw& normal_law(ContactMethod method) {
  return normal_laws[static_cast<std::size_t>(method)];
}

const FrictionLaw& friction_law(FrictionMethod method) {
  return friction_laws[static_cast<std::size_t>(method)];
}

Status wanted_status(const PointState& point, const PointLaw& law) {
  if (law.tied)
    return Status::stick;
  if (law.rubs_along)
    return wanted_status(along(*law.rubs_along, point), in_all_directions(law));
  if (!law.stays_closed && !normal_law(law.method).touches(point, law))
    return Status::open;
  const bool sticks = law.friction > 0 && friction_pressure_of(point, law).value > 0 &&
                      length_of(relative_friction(point, law)) <= 1 &&
                      !friction_law(law.friction_method).comes_sliding(point, law);
  return sticks ? Status::stick : Status::slip;
}

PointResponse respond(const PointState& point, Status status, const PointLaw& law) {
  if (law.tied && status != Status::open)
    return hold(point);
  if (law.rubs_along)
    return respond_along(*law.rubs_along, point, status, law);
  PointResponse response;
  if (status == Status::open)
    open_contact(point, law, response);
  else
    normal_law(law.method).close(point, law, response);
  if (rubs(point, status, law))
    friction_law(law.friction_method).rub(point, status, law, response);
  else
    free_semi_multipliers(point, response);
  return response;
}

double friction_pressure(const PointState& point, const PointLaw& law) {
  return std::max(0.0, friction_pressure_of(point, law).value);
}

} // namespace rubato::contact
