// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/enforcement.hpp"

#include "rubato/contact/frozen_frame.hpp"
#include "rubato/contact/point_tangent.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/spring_friction.hpp"
#include "rubato/contact/springs.hpp"
#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

class ZoneAssembler {
public:
  ZoneAssembler(const Zone& zone, int multiplier_offset, ContactSystem& system)
      : per_node_(zone.multipliers_per_node()), offset_(multiplier_offset), system_(system) {}

  void add(const SlavePoint& point, const FactoredResponse& response) {
    const auto& interpolation = response.interpolation;
    const MatrixXd force_by_displacement = response.force_by_displacement();
    for (Index row = 0; row < interpolation.cols(); ++row) {
      const int global_row = response.dofs[static_cast<std::size_t>(row)];
      double force = 0;
      for (Index i = 0; i < response.components; ++i)
        force += interpolation(i, row) * response.force[i];
      system_.force[global_row] += force;
      for (Index column = 0; column < interpolation.cols(); ++column) {
        double slope = 0;
        for (Index i = 0; i < interpolation.rows(); ++i)
          slope += interpolation(i, row) * force_by_displacement(i, column);
        push(system_.force_by_dof, global_row, response.dofs[static_cast<std::size_t>(column)], slope);
      }
    }
    for (std::size_t j = 0; j < point.multipliers.size(); ++j)
      couple(point, j, response);
    add_equations(point, response.multiplier_equations());
  }

  void add_equations(const SlavePoint& point, const PointEquations& equations) {
    for (std::size_t j = 0; j < point.multipliers.size(); ++j)
      for (Index a = 0; a < equations.values.size(); ++a) {
        const int row = multiplier(point, j, a);
        system_.equations[row] += point.multiplier_shape[j] * equations.values[a];
        for (std::size_t k = 0; k < point.multipliers.size(); ++k)
          for (Index b = 0; b < equations.values.size(); ++b)
            push(system_.equation_by_multiplier, row, multiplier(point, k, b),
                 point.multiplier_shape[j] * point.multiplier_shape[k] * equations.by_multiplier(a, b));
      }
  }

private:
  int multiplier(const SlavePoint& point, std::size_t node, Index variable) const {
    return offset_ + point.multipliers[node] * per_node_ + static_cast<int>(variable);
  }

  static void push(Triplets& triplets, int row, int column, double value) {
    if (value != 0)
      triplets.emplace_back(row, column, value);
  }

  void couple(const SlavePoint& point, std::size_t j, const FactoredResponse& response) {
    const double shape = point.multiplier_shape[j];
    const Index d = response.components;
    for (Index a = 0; a < response.multipliers(); ++a)
      for (Index q = 0; q < response.d_du.cols(); ++q) {
        const int dof = response.dofs[static_cast<std::size_t>(q)];
        double force = 0;
        for (Index i = 0; i < d; ++i)
          force += response.interpolation(i, q) * response.by_multiplier(i, a);
        push(system_.force_by_multiplier, dof, multiplier(point, j, a), shape * force);
        push(system_.equation_by_dof, multiplier(point, j, a), dof, shape * response.d_du(d + a, q));
      }
  }

  int per_node_;
  int offset_;
  ContactSystem& system_;
};

using Measure = decltype(measure_kinematics);

/// `measure` says how much of the kinematics is wanted.
void evaluate_pair(const Zone& zone, std::size_t point, const Pair& pair, const VectorXd& multipliers,
                   const Configuration& configuration, Measure& measure, PointEvaluation& into) {
  into.pair = pair;
  if (!pair.paired())
    into.kinematics.reset();
  else if (!into.kinematics)
    into.kinematics.emplace();
  if (into.kinematics)
    measure(zone, zone.points[point], pair, configuration, *into.kinematics);
  into.variables = variables_of(zone, zone.points[point], multipliers, into.kinematics);
}

void evaluate_pairs(const Zone& zone, std::span<const Pair> pairs, const VectorXd& multipliers,
                    const Configuration& configuration, Measure& measure,
                    std::vector<PointEvaluation>& into) {
  into.resize(zone.points.size());
  for (std::size_t i = 0; i < zone.points.size(); ++i)
    evaluate_pair(zone, i, pairs[i], multipliers, configuration, measure, into[i]);
}

void measure_again(const Zone& zone, const VectorXd& multipliers, const Configuration& configuration,
                   std::span<PointEvaluation> frozen) {
  for (std::size_t i = 0; i < frozen.size(); ++i) {
    if (frozen[i].kinematics)
      measure_in_frozen_frame(*frozen[i].kinematics, configuration);
    frozen[i].variables = variables_of(zone, zone.points[i], multipliers, frozen[i].kinematics);
  }
}

struct Traction {
  double pressure = 0;
  Vector3d normal;
  Vector3d tangential;
};

/// The tangential part of a traction, in space.
Vector3d on_tangents(const Kinematics& k, const Vector3d& traction) {
  return sum_of(scaled(traction[1], column_of(k.tangents, 0)), scaled(traction[2], column_of(k.tangents, 1)));
}

/// Frames of ties stand along the axes.
Traction traction_on_surface(const Kinematics& k, const PointResponse& response) {
  const auto normal = scaled(response.traction[0], k.normal);
  const auto tangential = on_tangents(k, response.traction);
  if (is_zero(k.facing))
    return {response.traction[0], normal, tangential};
  const auto whole = sum_of(normal, tangential);
  const double pressure = dot(whole, k.facing);
  return {pressure, scaled(pressure, k.facing), difference_of(whole, scaled(pressure, k.facing))};
}

/// A uniform pressure puts no force on such a node, so that its own says nothing: its neighbours' does,
/// unless nothing presses there.
void recover_axis_pressures(const Zone& zone, std::vector<PointOutcome>& outcomes) {
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const auto& axis = zone.points[i].axis_pressure;
    if (!axis)
      continue;
    const double beside = axis->weights[0] * outcomes[axis->points[0]].pressure +
                          axis->weights[1] * outcomes[axis->points[1]].pressure;
    if (!(beside > 0))
      continue;
    outcomes[i].pressure = beside;
    outcomes[i].area = length_of(outcomes[i].normal) / beside;
  }
}

} // namespace

PointState variables_of(const Zone& zone, const SlavePoint& point, const VectorXd& multipliers,
                        const std::optional<Kinematics>& kinematics) {
  const auto variables = zone.multiplier_variables();
  Vector3d values(0, 0, 0);
  for (std::size_t j = 0; j < point.multipliers.size(); ++j) {
    Index next = point.multipliers[j] * static_cast<Index>(variables.size());
    for (const int variable : variables)
      values[variable] += point.multiplier_shape[j] * multipliers[next++];
  }
  PointState state;
  state.pressure = values[0];
  state.semi = {values[1], values[2]};
  state.gap = kinematics ? kinematics->gap : std::numeric_limits<double>::infinity();
  if (kinematics)
    state.slip = kinematics->slip;
  return state;
}

double pressing_force(const PointOutcome& outcome) {
  return std::copysign(length_of(outcome.normal), outcome.pressure);
}

double resistance(const SlavePoint& point, const domain::DofMap& dofs,
                  const Eigen::Ref<const VectorXd>& diagonal) {
  double sum = 0;
  double shares = 0;
  for (std::size_t i = 0; i < point.nodes.size(); ++i) {
    const double share = std::abs(point.shape[i]);
    const auto first = dofs.first_dof[static_cast<std::size_t>(point.nodes[i])];
    double total = 0;
    for (int c = 0; c < dofs.components; ++c)
      total += diagonal[first + c];
    sum += share * total / dofs.components;
    shares += share;
  }
  return sum / shares;
}

ZoneState initial_state(const Zone& zone) {
  const bool active = zone.settings.initially_active.value_or(true);
  const auto closed = zone.settings.tie ? Status::stick : Status::slip;
  return {VectorXd::Zero(zone.multiplier_count()),
          std::vector<Status>(zone.points.size(), active ? closed : Status::open),
          std::vector<PointOutcome>(zone.points.size()),
          std::vector<FrictionHistory>(zone.points.size()),
          {},
          {},
          {},
          {},
          {}};
}

std::vector<std::uint8_t> touched_points(const Zone& zone, const ZoneState& state) {
  std::vector<std::uint8_t> touched;
  if (!zone.settings.bilateral)
    return touched;
  const bool from_start = zone.settings.initially_active.value_or(false);
  for (std::size_t i = 0; i < state.status.size(); ++i)
    touched.push_back(state.status[i] != Status::open && (from_start || !is_zero(state.outcomes[i].normal)));
  return touched;
}

ContactSystem::ContactSystem(Index dofs, Index multipliers)
    : force(VectorXd::Zero(dofs)), equations(VectorXd::Zero(multipliers)) {}

namespace {

/// Augmentation of friction by that which is chosen by itself, beyond which statuses follow the rounding of
/// slips: from 1e5 on steps take twenty times as many iterations, from 1e9 on they fail
/// (docs/guide/deck.md#coefficients). The answer does not depend on it.
constexpr double largest_augmentation = 1e3;

double tangential_coefficient(const Zone& zone, const FrictionLaw& friction, double stiffness) {
  const double automatic = friction.coefficient(stiffness, zone.edge());
  const double asked = zone.settings.tangential_coefficient.value_or(automatic);
  return friction.role->limited(asked, largest_augmentation * automatic);
}

} // namespace

ZoneCoefficients automatic_coefficients(const Zone& zone, const domain::DofMap& dofs,
                                        const Eigen::Ref<const VectorXd>& diagonal) {
  const auto& settings = zone.settings;
  const auto& normal = normal_law(settings.method);
  const auto& friction = friction_law(settings.friction_method);
  ZoneCoefficients coefficients;
  for (const auto& point : zone.points) {
    const double stiffness = resistance(point, dofs, diagonal) / std::abs(point.weight);
    coefficients.resistance.push_back(stiffness);
    coefficients.normal.push_back(settings.normal_coefficient.value_or(normal.multiple * stiffness));
    coefficients.tangential.push_back(tangential_coefficient(zone, friction, stiffness));
  }
  return coefficients;
}

void evaluate(NeighbourList& neighbours, const VectorXd& multipliers, const Configuration& configuration,
              std::vector<PointEvaluation>& into) {
  neighbours.update(configuration);
  evaluate_pairs(neighbours.zone(), neighbours.pairs(), multipliers, configuration, evaluate_kinematics,
                 into);
}

void measure(NeighbourList& neighbours, const VectorXd& multipliers, const Configuration& configuration,
             std::vector<PointEvaluation>& into) {
  neighbours.update(configuration);
  evaluate_pairs(neighbours.zone(), neighbours.pairs(), multipliers, configuration, measure_kinematics, into);
}

void measure(NeighbourList& neighbours, const VectorXd& multipliers, const Configuration& configuration,
             std::span<const std::size_t> points, std::vector<PointEvaluation>& into) {
  neighbours.update(configuration, points);
  for (const auto i : points)
    evaluate_pair(neighbours.zone(), i, neighbours.pairs()[i], multipliers, configuration, measure_kinematics,
                  into[i]);
}

void differentiate(const Zone& zone, std::size_t point, const Configuration& configuration,
                   PointEvaluation& evaluation) {
  if (zone.holds_geometry())
    return;
  if (zone.mortar)
    evaluation.kinematics = with_frozen_frame(std::move(*evaluation.kinematics));
  else
    evaluate_kinematics(zone, zone.points[point], evaluation.pair, configuration, *evaluation.kinematics);
}

std::vector<PointEvaluation> with_frozen_frames(std::vector<PointEvaluation> points) {
  for (auto& point : points)
    if (point.kinematics)
      point.kinematics = with_frozen_frame(std::move(*point.kinematics));
  return points;
}

std::vector<PointEvaluation> evaluate_in_frozen_frames(std::vector<PointEvaluation> frozen, const Zone& zone,
                                                       const VectorXd& multipliers,
                                                       const Configuration& configuration) {
  measure_again(zone, multipliers, configuration, frozen);
  return frozen;
}

void evaluate_in_frozen_frames(const std::vector<PointEvaluation>& frozen, const Zone& zone,
                               const VectorXd& multipliers, const Configuration& configuration,
                               std::vector<PointEvaluation>& into) {
  into = frozen;
  measure_again(zone, multipliers, configuration, into);
}

PointLaw ZoneLaw::of_point(std::size_t index) const {
  PointLaw law{zone->settings.method,
               zone->settings.friction_method,
               zone->friction_at(index, friction),
               coefficients->normal[index],
               coefficients->tangential[index],
               tolerances.closing_gap * zone->edge(),
               zone->space_dimension - 1,
               std::nullopt};
  law.exponential = exponential::numbers_of(zone->settings);
  if (!frozen_friction_pressures.empty())
    law.frozen_friction_pressure = frozen_friction_pressures[index];
  law.tied = zone->settings.tie;
  law.stays_closed = !stays_closed.empty() && stays_closed[index] != 0;
  if (!directions.empty() && directions[index].count == 0)
    law.friction = 0;
  if (!directions.empty() && directions[index].count == 1)
    law.rubs_along = directions[index].only;
  if (!coefficients->resistance.empty())
    law.resistance = coefficients->resistance[index];
  return law;
}

std::vector<Status> wanted_status(const ZoneLaw& law, std::span<const PointEvaluation> points) {
  std::vector<Status> status(points.size(), Status::open);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].kinematics && !law.zone->points[i].excluded)
      status[i] = wanted_status(points[i].variables, law.of_point(i));
  return status;
}

void keep_last_contact(const ZoneLaw& law, std::span<const PointEvaluation> points,
                       std::span<const Status> before, std::span<Status> status) {
  const auto is_open = [](Status one) { return one == Status::open; };
  if (!closes_gaps(*law.zone) || !std::ranges::all_of(status, is_open))
    return;
  for (std::size_t i = 0; i < status.size(); ++i)
    if (points[i].kinematics && points[i].variables.pressure > 0)
      status[i] = before[i];
}

Vector3d force_of(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation, Status status) {
  const auto& k = *evaluation.kinematics;
  const auto traction = respond(evaluation.variables, status, law.of_point(point)).traction;
  return scaled(-weight_of(law.zone->points[point], evaluation),
                sum_of(scaled(traction[0], k.normal), on_tangents(k, traction)));
}

std::vector<double> friction_pressures(const ZoneLaw& law, std::span<const PointEvaluation> points,
                                       std::span<const Status> status) {
  std::vector<double> pressures(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (status[i] != Status::open) {
      auto point_law = law.of_point(i);
      point_law.frozen_friction_pressure.reset();
      pressures[i] = friction_pressure(points[i].variables, point_law);
    }
  return pressures;
}

void add_contributions(const ZoneLaw& law, std::span<const PointEvaluation> points,
                       std::span<const Status> status, const domain::DofMap& dofs, int multiplier_offset,
                       ContactSystem& system) {
  ZoneAssembler assembler(*law.zone, multiplier_offset, system);
  FactoredResponse response;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& point = law.zone->points[i];
    if (status[i] == Status::open) {
      assembler.add_equations(point, open_equations(law, i, points[i]));
      continue;
    }
    factor_response(law, i, points[i], status[i], dofs, response);
    assembler.add(point, response);
  }
}

std::vector<PointOutcome> outcomes(const ZoneLaw& law, std::span<const PointEvaluation> points,
                                   std::span<const Status> status) {
  std::vector<PointOutcome> all(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& point = law.zone->points[i];
    auto& outcome = all[i];
    outcome.gap = points[i].variables.gap;
    outcome.slip = points[i].variables.slip;
    outcome.area = points[i].kinematics ? point.area * points[i].cover : 0;
    if (status[i] == Status::open)
      continue;
    const auto traction =
        traction_on_surface(*points[i].kinematics, respond(points[i].variables, status[i], law.of_point(i)));
    outcome.pressure = traction.pressure * point.weight / point.area;
    const double weight = weight_of(point, points[i]);
    outcome.normal = scaled(weight, traction.normal);
    outcome.tangential = scaled(weight, traction.tangential);
  }
  recover_axis_pressures(*law.zone, all);
  return all;
}

MeanGap largest_mean_gap(const ZoneLaw& law, std::span<const PointEvaluation> points,
                         std::span<const Status> status) {
  const auto& zone = *law.zone;
  VectorXd sums = VectorXd::Zero(static_cast<Index>(zone.slave.nodes.size()));
  VectorXd weights = VectorXd::Zero(sums.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& point = zone.points[i];
    const double equation = respond(points[i].variables, status[i], law.of_point(i)).equations[0];
    for (std::size_t j = 0; j < point.multipliers.size(); ++j) {
      sums[point.multipliers[j]] += point.weight * point.multiplier_shape[j] * equation;
      weights[point.multipliers[j]] += std::abs(point.weight * point.multiplier_shape[j]);
    }
  }
  MeanGap largest;
  for (Index i = 0; i < sums.size(); ++i)
    if (const double mean = std::abs(sums[i]) / weights[i]; mean > largest.value)
      largest = {mean, static_cast<int>(i)};
  return largest;
}

void add_friction_force(std::span<const PointEvaluation> points, std::span<const PointOutcome> outcomes,
                        const domain::DofMap& dofs, VectorXd& force) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].kinematics && !is_zero(outcomes[i].tangential))
      points[i].kinematics->stencil.scatter(scaled(-1, outcomes[i].tangential), dofs, force);
}

} // namespace rubato::contact
