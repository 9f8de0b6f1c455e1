// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/explicit_penalty.hpp"

#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Of the direction that moves most easily: a node may be held in others.
double inverse_mass_of(const domain::DofMap& dofs, const VectorXd& inverse_mass, mesh::NodeIndex node) {
  double largest = inverse_mass[dofs.dof(node, 0)];
  for (int c = 1; c < dofs.components; ++c)
    largest = std::max(largest, inverse_mass[dofs.dof(node, c)]);
  return largest;
}

/// Steps without iterations have nothing to hop in: a point that comes back to a face is there. Which faces
/// it had been on before would be a memory that no checkpoint keeps.
void pair_anew(NeighbourList& neighbours, const Configuration& configuration) {
  neighbours.forget_visits();
  neighbours.update(configuration);
}

Vector3d velocity_of(const SlavePoint& point, const domain::DofMap& dofs, const VectorXd& velocity) {
  Vector3d sum(0, 0, 0);
  for (std::size_t i = 0; i < point.nodes.size(); ++i)
    for (int c = 0; c < dofs.components; ++c)
      sum[c] += point.shape[i] * velocity[dofs.dof(point.nodes[i], c)];
  return sum;
}

/// How far an obstacle comes under a point that has `moved` to the configuration; a meshed master's way is in
/// the motion of its nodes.
Vector3d way_of_obstacle(const Zone& zone, const SlavePoint& point, const Vector3d& moved,
                         const Configuration& configuration) {
  if (!zone.obstacle)
    return {0, 0, 0};
  const Vector3d now = position(point, configuration);
  return zone.obstacle->way(difference_of(now, moved), now, configuration.start_t, configuration.t);
}

} // namespace

std::vector<double> penalty_stiffness(const Zone& zone, const domain::DofMap& dofs,
                                      const VectorXd& inverse_mass, double eigenvalue) {
  double master = 0;
  for (const auto node : zone.master.nodes)
    master += inverse_mass_of(dofs, inverse_mass, node) / static_cast<double>(zone.master.nodes.size());
  std::vector<double> stiffness;
  for (const auto& point : zone.points) {
    double slave = 0;
    for (std::size_t i = 0; i < point.nodes.size(); ++i)
      slave += point.shape[i] * point.shape[i] * inverse_mass_of(dofs, inverse_mass, point.nodes[i]);
    const bool held = slave + master == 0; // whatever the springs are, nothing moves
    const double spring = held ? 0.0 : tolerances.explicit_spring_share * eigenvalue / (slave + master);
    stiffness.push_back(zone.settings.normal_coefficient.value_or(spring / std::abs(point.weight)));
  }
  return stiffness;
}

ExplicitPenalty::ExplicitPenalty(const Zone& zone, const domain::DofMap& dofs,
                                 std::vector<double> normal_stiffness)
    : zone_(&zone), dofs_(&dofs), normal_stiffness_(std::move(normal_stiffness)), neighbours_(zone),
      springs_(zone.points.size()), friction_history_(zone.points.size()) {}

void ExplicitPenalty::advance(const Configuration& configuration, const VectorXd& velocity, double step,
                              VectorXd& force) {
  pair_anew(neighbours_, configuration);
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    if (zone_->points[i].excluded)
      continue;
    auto& spring = springs_[i];
    const double energy = tangential_energy(i);
    if (!neighbours_.pairs()[i].paired()) {
      friction_history_[i].work += energy;
      spring = {.paired = false};
      continue;
    }
    measure_kinematics(*zone_, zone_->points[i], neighbours_.pairs()[i], configuration, place_);
    spring.gap = place_.gap;
    if (!press(spring, normal_stiffness_[i])) {
      friction_history_[i].work += energy;
      continue;
    }
    const auto moved = scaled(step, place_.stencil.gather(velocity, *dofs_));
    const auto relative =
        difference_of(moved, way_of_obstacle(*zone_, zone_->points[i], moved, configuration));
    const auto slip = part_across(place_.normal, relative);
    spring.normal = place_.normal;
    for (int a = 0; a < 2; ++a)
      spring.slip_on_tangents[a] = dot(column_of(place_.tangents, a), slip);
    const Vector3d traction = spring.traction;
    rub(spring, zone_->friction_at(i, zone_->settings.friction), normal_stiffness_[i], slip);
    const double work = -0.5 * zone_->points[i].weight * dot(sum_of(traction, spring.traction), slip);
    friction_history_[i].work += work - (tangential_energy(i) - energy);
    friction_history_[i].slip += length_of(slip);
    place_.stencil.scatter(scaled(-1, push_of(i)), *dofs_, force);
  }
}

Vector3d ExplicitPenalty::push() const {
  Vector3d sum(0, 0, 0);
  for (std::size_t i = 0; i < springs_.size(); ++i)
    add_scaled(1, push_of(i), sum);
  return sum;
}

Vector3d ExplicitPenalty::push_of(std::size_t index) const {
  const auto& spring = springs_[index];
  return scaled(zone_->points[index].weight, sum_of(scaled(spring.pressure, spring.normal), spring.traction));
}

double ExplicitPenalty::work_of_obstacle(const Configuration& configuration, const VectorXd& velocity,
                                         double step) const {
  const auto& obstacle = *zone_->obstacle;
  if (!obstacle.rotation)
    return dot(obstacle.translation(configuration.start_t, configuration.t), push());
  double work = 0;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const auto& point = zone_->points[i];
    if (springs_[i].status != Status::open)
      work +=
          dot(push_of(i), way_of_obstacle(*zone_, point, scaled(step, velocity_of(point, *dofs_, velocity)),
                                          configuration));
  }
  return work;
}

double ExplicitPenalty::stored() const {
  double sum = 0;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    if (springs_[i].status == Status::open)
      continue;
    const double normal = 0.5 * springs_[i].pressure * springs_[i].pressure / normal_stiffness_[i];
    sum += zone_->points[i].weight * normal + tangential_energy(i);
  }
  return sum;
}

double ExplicitPenalty::dissipated() const {
  double sum = 0;
  for (const auto& history : friction_history_)
    sum += history.work;
  return sum;
}

void ExplicitPenalty::restore(const Memory& memory, const Configuration& configuration) {
  springs_ = memory.springs;
  friction_history_ = memory.friction_history;
  pair_anew(neighbours_, configuration);
}

ZoneState ExplicitPenalty::state() const {
  auto state = initial_state(*zone_);
  state.outcomes.assign(springs_.size(), {});
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const auto& spring = springs_[i];
    const double weight = zone_->points[i].weight;
    state.status[i] = spring.status;
    state.outcomes[i] = {neighbours_.pairs()[i].paired() ? spring.gap : INFINITY, spring.slip_on_tangents,
                         spring.pressure, scaled(weight * spring.pressure, spring.normal),
                         scaled(weight, spring.traction)};
    state.outcomes[i].area = neighbours_.pairs()[i].paired() ? zone_->points[i].area : 0;
  }
  state.friction_history = friction_history_;
  return state;
}

void ExplicitPenalty::add_loads(VectorXd& load) const {
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const double spring = std::abs(zone_->points[i].weight) * normal_stiffness_[i];
    visit_nodes(i, [&](mesh::NodeIndex node, double shape) {
      load[dofs_->dof(node, 0)] += spring * std::abs(shape);
    });
  }
}

double ExplicitPenalty::largest_row_sum(const VectorXd& load, const VectorXd& inverse_mass) const {
  double largest = 0;
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    double sum = 0;
    visit_nodes(i, [&](mesh::NodeIndex node, double shape) {
      sum += std::abs(shape) * inverse_mass_of(*dofs_, inverse_mass, node) * load[dofs_->dof(node, 0)];
    });
    largest = std::max(largest, sum);
  }
  return largest;
}

/// The nodes that a point pushes if it faces a master, with its shape values; the master's are negative.
template <class Visit> void ExplicitPenalty::visit_nodes(std::size_t index, const Visit& visit) const {
  const auto& point = zone_->points[index];
  const auto& pair = neighbours_.pairs()[index];
  if (point.excluded || !pair.paired())
    return;
  for (std::size_t i = 0; i < point.nodes.size(); ++i)
    visit(point.nodes[i], point.shape[i]);
  if (zone_->obstacle)
    return;
  const auto& face = zone_->master.faces[at(pair.master_face)];
  const auto shape = face_values(face.type, pair.projection.clamped);
  for (std::size_t j = 0; j < at(face.node_count); ++j)
    visit(face.nodes[j], -shape[j]);
}

/// The pressure that the gap calls for; false, and a relaxed spring, when there is none.
bool ExplicitPenalty::press(Spring& spring, double normal_stiffness) const {
  const double known = spring.paired ? spring.gap_offset : spring.gap;
  spring.gap_offset = std::min(std::max(known, spring.gap), 0.0);
  spring.paired = true;
  spring.pressure = normal_stiffness * (spring.gap_offset - spring.gap);
  if (spring.pressure > 0)
    return true;
  spring = {.gap_offset = spring.gap_offset, .gap = spring.gap};
  return false;
}

/// Friction after a slip increment: elastic as far as Coulomb allows.
void ExplicitPenalty::rub(Spring& spring, double friction, double normal_stiffness,
                          const Vector3d& slip) const {
  const auto& settings = zone_->settings;
  spring.status = Status::slip;
  const double limit = friction * spring.pressure;
  if (limit == 0)
    return;
  spring.tangential_stiffness =
      std::min(normal_stiffness, limit * settings.tangential_coefficient.value_or(INFINITY));
  spring.slip = part_across(spring.normal, sum_of(spring.slip, slip));
  const double trial = spring.tangential_stiffness * length_of(spring.slip);
  if (trial <= limit)
    spring.status = Status::stick;
  else
    spring.slip = scaled(limit / trial, spring.slip);
  spring.traction = scaled(-spring.tangential_stiffness, spring.slip);
}

double ExplicitPenalty::tangential_energy(std::size_t index) const {
  const auto& spring = springs_[index];
  return 0.5 * zone_->points[index].weight * spring.tangential_stiffness * dot(spring.slip, spring.slip);
}

double largest_eigenvalue(std::span<const ExplicitPenalty> zones, const VectorXd& inverse_mass) {
  VectorXd load = VectorXd::Zero(inverse_mass.size());
  for (const auto& zone : zones)
    zone.add_loads(load);
  double largest = 0;
  for (const auto& zone : zones)
    largest = std::max(largest, zone.largest_row_sum(load, inverse_mass));
  return largest;
}

} // namespace rubato::contact
