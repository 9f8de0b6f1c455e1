// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/points.hpp"

#include "rubato/contact/frozen_frame.hpp"
#include "rubato/contact/mortar/obstacle_mortar.hpp"
#include "rubato/contact/mortar/parts.hpp"
#include "rubato/contact/mortar/slip.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/springs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

bool is_clamped(const Zone& zone, std::size_t node) {
  for (int c = 0; c < zone.space_dimension; ++c)
    if (!zone.is_held(node, c))
      return false;
  return true;
}

/// Whether supports hold a node whole and each of its faces has nodes that they do not: the end of a clamped
/// beam.
bool ends_at_a_clamp(const Zone& zone, std::size_t node) {
  const auto moves = [&](int other) { return !is_clamped(zone, static_cast<std::size_t>(other)); };
  return is_clamped(zone, node) && std::ranges::all_of(zone.slave.faces_of_node[node], [&](int face) {
           return std::ranges::any_of(zone.slave.faces[static_cast<std::size_t>(face)].position_span(),
                                      moves);
         });
}

/// A node that is excluded keeps its function: its part of the surface touches nothing. One at a clamp gives
/// it to its neighbours, as a tie's does: only its master could give way to its force, by the little of it
/// that is not clamped, too, so that points there would press and pull on each other with forces beyond those
/// of the bodies.
std::vector<Keep> keep_of(const Zone& zone) {
  std::vector<Keep> keep(zone.points.size(), Keep::by_cover);
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (zone.points[i].excluded)
      keep[i] = Keep::always;
    else if (ends_at_a_clamp(zone, static_cast<std::size_t>(zone.points[i].node_position)))
      keep[i] = Keep::never;
  return keep;
}

/// Kept, dropped, kept and dropped again.
constexpr int returned = 3;
/// The shares that are asked of a node, one after the other each time that it has returned. First less, as
/// what is kept where a step begins mostly stays; then more; then nothing. Kept for good with next to no
/// cover a node would carry in a point what its neighbours carry on their faces.
constexpr std::array asked_shares{least_kept_share, 0.5 * least_kept_share, 0.1, 0.2, 0.4, 0.};

/// Of the way to a node's neighbour: by how much a lift may change in a step before its gap follows.
constexpr double free_change = 2e-5;
/// How often that may be, before its gap follows the least gaps themselves.
constexpr int most_releases = 3;

/// As PointEvaluation has it.
double lift_of(const Node& node) {
  return node.kept() ? node.lift : -1;
}

template <class PositionOf>
void collect(const Surface& surface, const PositionOf& position, std::vector<Vector3d>& into) {
  into.resize(surface.nodes.size());
  for (std::size_t i = 0; i < into.size(); ++i)
    into[i] = position(surface.nodes[i]);
}

std::optional<SelfPairs> self_of(const Zone& zone) {
  if (!zone.meets_itself())
    return std::nullopt;
  return SelfPairs(zone.slave, zone.undeformed_master, zone.mortar->longest_face);
}

} // namespace

Points::Points(const Zone& zone, const Threads& threads)
    : zone_(&zone), threads_(threads), keep_(keep_of(zone)), self_(self_of(zone)) {}

void Points::update(const Configuration& configuration) {
  const auto position = [&](mesh::NodeIndex node) { return configuration.position(node); };
  collect(zone_->slave, position, slave_);
  collect(zone_->master, position, master_);
  take_start(configuration);
  if (held_lifts_.size() != slave_.size())
    take_lifts();
  integrate_at(slave_, master_, configuration.t, now_);
  hold_those_that_return();
  hold_lifts();
}

/// Where only rounding or the last digits of an iterate decide, each decision moves the iterate back.
void Points::hold_those_that_return() {
  const auto count = now_.nodes.size();
  changes_.resize(count);
  least_shares_.resize(count, least_kept_share);
  if (was_kept_.size() == count)
    for (std::size_t i = 0; i < count; ++i)
      if (now_.nodes[i].kept() != (was_kept_[i] != 0) && ++changes_[i] == returned)
        ask_another_share_of(i);
  was_kept_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    was_kept_[i] = now_.nodes[i].kept() ? 1 : 0;
}

void Points::ask_another_share_of(std::size_t node) {
  changes_[node] = 1; // as if it had been kept and dropped now for the first time
  const auto* next = std::find(asked_shares.begin(), asked_shares.end(), least_shares_[node]) + 1;
  if (next != asked_shares.end())
    least_shares_[node] = *next;
}

void Points::hold_lifts() {
  measured_lifts_.resize(now_.nodes.size());
  releases_.resize(now_.nodes.size());
  for (std::size_t i = 0; i < measured_lifts_.size(); ++i) {
    measured_lifts_[i] = lift_of(now_.nodes[i]);
    if (measured_lifts_[i] >= 0 && releases_[i] < most_releases)
      hold_lift(i);
  }
}

/// A lift stays that of the step's start, or of the configuration in which its node was first kept, until it
/// is off by more than the free change, and then the one at which it was: two ways to the same end differ by
/// no more than that.
void Points::hold_lift(std::size_t i) {
  const auto& reference = *zone_->mortar;
  auto& node = now_.nodes[i];
  const auto neighbour = static_cast<std::size_t>(reference.tangent_neighbour[i]);
  const double free =
      free_change * length_of(difference_of(reference.undeformed[neighbour], reference.undeformed[i]));
  node.gap_weights.resize(0);
  if (held_lifts_[i] < 0 || std::abs(node.lift - held_lifts_[i]) > free) {
    held_lifts_[i] = node.lift;
    ++releases_[i];
    return;
  }
  node.gap += held_lifts_[i] - node.lift;
  node.lift = held_lifts_[i];
  node.lift_slope = 0;
}

void Points::begin(std::span<const double> lifts) {
  held_lifts_.assign(lifts.begin(), lifts.end());
  releases_.assign(lifts.size(), 0);
}

/// Before the first step.
void Points::take_lifts() {
  integrate_at(start_slave_, start_master_, start_t_, now_);
  held_lifts_.resize(now_.nodes.size());
  for (std::size_t i = 0; i < held_lifts_.size(); ++i)
    held_lifts_[i] = lift_of(now_.nodes[i]);
}

void Points::integrate_at(const Positions& slave, const Positions& master, double t, Operators& into) {
  const auto options = options_at(slave, master);
  if (zone_->meets_itself())
    integrate(zone_->slave, *zone_->mortar, zone_->slave, slave, slave, options, workspace_, into);
  else if (zone_->obstacle)
    integrate(zone_->slave, *zone_->mortar, *zone_->obstacle, zone_->obstacle->pose(t), slave, options,
              workspace_, into);
  else
    integrate(zone_->slave, *zone_->mortar, zone_->master, slave, master, options, workspace_, into);
}

Options Points::options_at(const Positions& slave, const Positions& master) {
  Options options{.held = zone_->held, .keep = keep_, .least_shares = least_shares_, .threads = threads_};
  if (!zone_->obstacle && !self_)
    options.reaches = reach_.at(slave, master);
  if (!self_)
    return options;
  options.may_pair = [this](int one, int other) { return self_->may_pair(one, other); };
  options.mean_normals = true;
  options.reach = self_->reach_at(slave);
  return options;
}

/// What belongs to the start of the step is kept as long as it is the same start.
void Points::take_start(const Configuration& configuration) {
  const auto position = [&](mesh::NodeIndex node) { return configuration.start_position(node); };
  Positions start(zone_->slave.nodes.size());
  collect(zone_->slave, position, start);
  if (start_t_ == configuration.start_t && start == start_slave_)
    return;
  start_t_ = configuration.start_t;
  start_slave_ = std::move(start);
  collect(zone_->master, position, start_master_);
  if (self_)
    self_->update(start_slave_);
  was_kept_.clear();
  changes_.clear();
  least_shares_.clear();
  if (zone_->obstacle)
    return take_frames_before_obstacle();
  if (!self_)
    reach_.begin(zone_->slave, zone_->master, start_slave_, start_master_, zone_->mortar->longest_face);
  take_frames();
}

void Points::take_frames_before_obstacle() {
  Operators before;
  integrate_at(start_slave_, {}, start_t_, before);
  start_frames_.resize(start_slave_.size());
  for (std::size_t i = 0; i < start_frames_.size(); ++i)
    start_frames_[i] = {before.nodes[i].normal, before.nodes[i].tangents};
}

void Points::take_frames() {
  std::vector<Vector3d> normals;
  if (self_)
    mean_normals(zone_->slave, *zone_->mortar, start_slave_, options_at(start_slave_, {}), workspace_,
                 normals);
  else
    set_normals(zone_->slave, *zone_->mortar, start_slave_, {.held = zone_->held}, normals);
  start_frames_.resize(start_slave_.size());
  for (std::size_t i = 0; i < start_frames_.size(); ++i)
    start_frames_[i] = node_frame(*zone_->mortar, start_slave_, normals, i);
}

/// Before a master the frame of a node has turned with the slave's since then.
Eigen::Matrix<double, 3, 2> Points::start_tangents(std::size_t position) const {
  const auto& start = start_frames_[position];
  if (zone_->obstacle)
    return start.tangents;
  const auto& now = now_.nodes[position];
  return turned(now.tangents, now.slave_frame, start);
}

Vector3d Points::anchor_motion(const Node& node, const Configuration& configuration) const {
  if (!zone_->obstacle)
    return {0, 0, 0};
  const Vector3d start = node.stencil.sum([&](auto at) { return configuration.start_position(at); });
  const Vector3d end = node.stencil.sum([&](auto at) { return configuration.position(at); });
  return zone_->obstacle->way(start, end, configuration.start_t, configuration.t);
}

void Points::measure(std::size_t position, const VectorXd& multipliers, const Configuration& configuration,
                     PointEvaluation& into) const {
  const auto& node = now_.nodes[position];
  const auto& point = zone_->points[position];
  into.pair = node.kept() ? Pair::before_obstacle() : Pair{};
  into.cover = node.kept() ? node.weight / point.area : 1;
  into.receivers = node.receivers;
  into.lift = measured_lifts_[position];
  if (!node.kept()) {
    into.kinematics.reset();
    into.variables = variables_of(*zone_, point, multipliers, into.kinematics);
    return;
  }
  if (!into.kinematics)
    into.kinematics.emplace();
  auto& k = *into.kinematics;
  k.stencil = node.stencil;
  k.parametric_dimension = zone_->space_dimension - 1;
  k.normal = node.normal;
  k.tangents = node.tangents;
  k.closest_point = node.anchor;
  k.obstacle_displacement = anchor_motion(node, configuration);
  const Vector3d start = sum_of(gap_vector(node, [&](auto at) { return configuration.start_position(at); }),
                                k.obstacle_displacement);
  k.slip_origin.setZero(); // an obstacle that rotates takes frames along
  if (!zone_->obstacle || !zone_->obstacle->rotation) {
    const auto then = start_tangents(position);
    for (int a = 0; a < 2; ++a)
      k.slip_origin[a] = dot(difference_of(column_of(then, a), column_of(node.tangents, a)), start);
  }
  const Vector3d end = gap_vector(node, [&](auto at) { return configuration.position(at); });
  const Vector3d moved = difference_of(end, start);
  for (int a = 0; a < 2; ++a)
    k.slip[a] = dot(column_of(node.tangents, a), moved) - k.slip_origin[a];
  const double offset = zone_->offset.at(point.place, configuration.t);
  const double gap = node.gap + offset;
  k.gap_weights = node.gap_weights;
  // Springs press by the gap as it is; of one that a multiplier closes it only matters where it is 0.
  const bool scales = k.gap_weights.size() == 0 && node.lift_slope > 0 && closes_gaps(*zone_) &&
                      variables_of(*zone_, point, multipliers, {}).pressure > 0;
  k.gap = scales ? gap / (1 + node.lift_slope) : gap; // moves as the stencil says
  k.gap_origin = (zone_->obstacle ? dot(node.normal, end) - node.gap : -node.lift) - offset + gap - k.gap;
  if (k.gap_weights.size() > 0)
    k.gap_origin =
        dot(node.normal, k.gap_vector([&](auto at) { return configuration.position(at); })) - k.gap;
  if (zone_->space_dimension == 2)
    k.slip[1] = k.slip_origin[1] = 0;
  into.variables = variables_of(*zone_, point, multipliers, into.kinematics);
}

void measure(Points& points, const VectorXd& multipliers, const Configuration& configuration,
             std::vector<PointEvaluation>& into) {
  points.update(configuration);
  into.resize(points.zone().points.size());
  for (std::size_t i = 0; i < into.size(); ++i)
    points.measure(i, multipliers, configuration, into[i]);
}

void measure(Points& points, const VectorXd& multipliers, const Configuration& configuration,
             std::span<const std::size_t> chosen, std::vector<PointEvaluation>& into) {
  points.update(configuration);
  for (const auto i : chosen)
    points.measure(i, multipliers, configuration, into[i]);
}

void evaluate(Points& points, const VectorXd& multipliers, const Configuration& configuration,
              std::vector<PointEvaluation>& into) {
  measure(points, multipliers, configuration, into);
  for (auto& point : into)
    if (point.kinematics)
      point.kinematics = with_frozen_frame(std::move(*point.kinematics));
}

} // namespace rubato::contact::mortar
