// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/reach.hpp"

#include "rubato/model/model.hpp"
#include "rubato/step/common/effective_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::step {
namespace {

constexpr double reach_in_edges = 0.5;

} // namespace

double Reach::part_of(const Eigen::VectorXd& move, double more) {
  if (!std::isfinite(most_) || move.size() == 0)
    return 1;
  const double largest = move.lpNorm<Eigen::Infinity>();
  if (last_.size() == move.size())
    allowed_ = last_.dot(move) < 0 ? allowed_ / 2 : std::min(2 * allowed_, most_);
  const double limit = allowed_ + more;
  const double part = largest <= limit ? 1 : limit / largest;
  last_ = part * move;
  return part;
}

double finest_edge(const model::Model& model) {
  double edge = std::numeric_limits<double>::infinity();
  for (const auto& zone : model.zones)
    edge = std::min(edge, zone.edge());
  return edge;
}

Reach reach_of(const model::Model& model, const EffectiveSystem& system) {
  return Reach(system.has_free_bodies ? reach_in_edges * finest_edge(model)
                                      : std::numeric_limits<double>::infinity());
}

} // namespace rubato::step
