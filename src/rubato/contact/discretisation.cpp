// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/discretisation.hpp"

#include <utility>

namespace rubato::contact {

using Eigen::VectorXd;

Discretisation make_discretisation(const Zone& zone, const Threads& threads) {
  if (zone.holds_geometry())
    return Discretisation(std::in_place_type<FrozenPoints>, zone);
  if (zone.mortar)
    return Discretisation(std::in_place_type<mortar::Points>, zone, threads);
  return Discretisation(std::in_place_type<NeighbourList>, zone);
}

const Zone& zone_of(const Discretisation& discretisation) {
  return std::visit([](const auto& by) -> const Zone& { return by.zone(); }, discretisation);
}

void begin_step(Discretisation& discretisation, const ZoneState& committed) {
  if (auto* points = std::get_if<mortar::Points>(&discretisation))
    points->begin(committed.lifts);
}

void forget_visits(Discretisation& discretisation) {
  if (auto* neighbours = std::get_if<NeighbourList>(&discretisation))
    neighbours->forget_visits();
}

bool release_beyond_borders(Discretisation& discretisation) {
  auto* neighbours = std::get_if<NeighbourList>(&discretisation);
  return neighbours != nullptr && neighbours->release_beyond_borders();
}

std::vector<PointEvaluation> evaluate(const Zone& zone, const VectorXd& multipliers,
                                      const Configuration& configuration) {
  auto discretisation = make_discretisation(zone);
  std::vector<PointEvaluation> points;
  evaluate(discretisation, multipliers, configuration, points);
  return points;
}

void evaluate(Discretisation& discretisation, const VectorXd& multipliers, const Configuration& configuration,
              std::vector<PointEvaluation>& into) {
  std::visit([&](auto& by) { evaluate(by, multipliers, configuration, into); }, discretisation);
}

void measure(Discretisation& discretisation, const VectorXd& multipliers, const Configuration& configuration,
             std::vector<PointEvaluation>& into) {
  std::visit([&](auto& by) { measure(by, multipliers, configuration, into); }, discretisation);
}

void measure(Discretisation& discretisation, const VectorXd& multipliers, const Configuration& configuration,
             std::span<const std::size_t> points, std::vector<PointEvaluation>& into) {
  std::visit([&](auto& by) { measure(by, multipliers, configuration, points, into); }, discretisation);
}

} // namespace rubato::contact
