// SPDX-License-Identifier: LGPL-3.0-or-later
// What the linear system of the points in contact answers.
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/interface/condensed.hpp"

#include <algorithm>

namespace rubato::step {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;

/// Of the iterate that now() is; `at`: where its surface is. Each rank solves its dense system; as their last
/// digits need not be the same, those of the first one count.
std::optional<Corrected> Condensed::corrected(const State& trial, const Frozen& frozen, const VectorXd& at) {
  linearise(trial, frozen);
  const auto ranks = model_.sharing();
  const auto change =
      scratch_.points.solve(surface_.free - at, surface_.beyond_carried(force()), {system_.matrix, ranks});
  if (!ranks.of_first(change.has_value()))
    return std::nullopt;
  Corrected result;
  result.applied = force();
  if (change)
    scratch_.points.add_force(*change, result.applied);
  result.applied = linalg::of_first(std::move(result.applied), ranks);
  result.moved = surface_.moved_by(result.applied);
  for (const auto& zone : trial.zones)
    result.multipliers.push_back(zone.multipliers);
  if (change) {
    correct_own_multipliers(*change, result.moved - at, result.multipliers);
    correct_shared_multipliers(*change, result.multipliers);
  }
  for (auto& multipliers : result.multipliers)
    multipliers = linalg::of_first(std::move(multipliers), ranks);
  return result;
}

/// `moved`: how far the change moves the surface. Open points have no multipliers in the end.
void Condensed::correct_own_multipliers(const InterfaceNewtonSystem::Change& change, const VectorXd& moved,
                                        std::vector<VectorXd>& multipliers) const {
  const auto of_point = [&](std::size_t z, int count, std::size_t i) {
    return multipliers[z].segment(Index{model_.zones[z].points[i].node_position} * count, count);
  };
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const int count = model_.zones[z].owns_multipliers() ? model_.zones[z].multipliers_per_node() : 0;
    for (std::size_t i = 0; count > 0 && i < now().status[z].size(); ++i)
      if (now().status[z][i] == Status::open)
        of_point(z, count, i).setZero();
  }
  const auto& points = scratch_.points;
  for (const auto& point : points.points())
    if (const int count = point.response.multipliers(); count > 0 && point.shares.empty())
      of_point(point.zone, count, point.index) += points.multipliers_of(point, change, moved);
}

void Condensed::correct_shared_multipliers(const InterfaceNewtonSystem::Change& change,
                                           std::vector<VectorXd>& multipliers) const {
  scratch_.points.for_each_shared(change, [&](int multiplier, double by) {
    const auto after = std::ranges::upper_bound(model_.multiplier_offsets, multiplier);
    const auto zone = static_cast<std::size_t>(after - model_.multiplier_offsets.begin()) - 1;
    multipliers[zone][multiplier - model_.multiplier_offsets[zone]] += by;
  });
}

} // namespace rubato::step
