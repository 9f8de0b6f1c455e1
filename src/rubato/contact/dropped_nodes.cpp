// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/dropped_nodes.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <algorithm>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr Index numbers_a_node = 4;

/// A traction of a point by its force.
Vector3d traction_by_force(const PointOutcome& outcome) {
  return outcome.area > 0 ? scaled(1 / outcome.area, outcome.tangential) : Vector3d(0, 0, 0);
}

struct ReceiverMean {
  double pressure = 0;
  Vector3d traction{0, 0, 0};
  Status status = Status::open;
};

ReceiverMean mean_of(std::span<const int> receivers, std::span<const Status> status,
                     std::span<const PointOutcome> outcomes) {
  ReceiverMean mean;
  const double part = 1 / static_cast<double>(receivers.size());
  for (const int receiver : receivers) {
    const auto at = static_cast<std::size_t>(receiver);
    mean.pressure += part * outcomes[at].pressure;
    add_scaled(part, traction_by_force(outcomes[at]), mean.traction);
    if (status[at] == Status::slip || (status[at] == Status::stick && mean.status == Status::open))
      mean.status = status[at];
  }
  return mean;
}

} // namespace

void report_dropped_nodes(std::span<const PointEvaluation> points, std::span<const Status> status,
                          ZoneState& state) {
  state.of_receivers.resize(0);
  if (std::ranges::all_of(points, [](const auto& point) { return point.receivers.empty(); }))
    return;
  state.of_receivers.setZero(static_cast<Index>(points.size()) * numbers_a_node);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].receivers.empty())
      continue;
    const auto mean = mean_of(points[i].receivers, status, state.outcomes);
    state.outcomes[i].pressure = mean.pressure;
    const auto first = static_cast<Index>(i) * numbers_a_node;
    state.of_receivers[first] = static_cast<double>(mean.status);
    for (int c = 0; c < 3; ++c)
      state.of_receivers[first + 1 + c] = mean.traction[c];
  }
}

Status reported_status(const ZoneState& state, std::size_t point) {
  const auto first = static_cast<Index>(point) * numbers_a_node;
  if (state.status[point] != Status::open || first >= state.of_receivers.size())
    return state.status[point];
  return static_cast<Status>(static_cast<int>(state.of_receivers[first]));
}

Vector3d reported_traction(const ZoneState& state, std::size_t point) {
  const auto first = static_cast<Index>(point) * numbers_a_node;
  if (state.status[point] != Status::open || first >= state.of_receivers.size())
    return traction_by_force(state.outcomes[point]);
  return {state.of_receivers[first + 1], state.of_receivers[first + 2], state.of_receivers[first + 3]};
}

} // namespace rubato::contact
