// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/report.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace rubato::step {

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
  case Outcome::converged:
    return "converged";
  case Outcome::too_many_iterations:
    return "too many iterations";
  case Outcome::cycling:
    return "status cycle";
  case Outcome::singular_matrix:
    return "singular matrix";
  case Outcome::not_finite:
    return "a value is not finite";
  case Outcome::geometry_unsettled:
    return "too many rounds of the geometry loop";
  case Outcome::friction_unsettled:
    return "too many rounds of the friction loop";
  case Outcome::status_unsettled:
    return "too many rounds of the status loop";
  case Outcome::pressed_afar:
    return "pressed where nothing is";
  case Outcome::indefinite:
    return "the matrix is not positive definite";
  case Outcome::plastic_step:
    return "plastic strain grew too much";
  case Outcome::cell_failed:
    return "a cell has no forces";
  case Outcome::unsolved:
    return "the iterative solver did not converge";
  case Outcome::interrupted:
    return "interrupted";
  }
  return "";
}

std::string_view level_of(Outcome outcome) {
  switch (outcome) {
  case Outcome::geometry_unsettled:
    return to_string(LoopLevel::geometry);
  case Outcome::friction_unsettled:
    return to_string(LoopLevel::friction);
  case Outcome::status_unsettled:
  case Outcome::cycling:
    return to_string(LoopLevel::status);
  default:
    return "newton";
  }
}

std::string_view to_string(LoopLevel level) {
  switch (level) {
  case LoopLevel::geometry:
    return "geometry";
  case LoopLevel::friction:
    return "friction";
  case LoopLevel::status:
    return "status";
  }
  return "";
}

bool StallWatch::stalls(double residual) {
  // Newton's iterations square it; one that is not halved does not converge.
  constexpr double progress = 0.5;
  const bool stalled = residual > progress * last_;
  last_ = residual;
  return stalled;
}

std::string_view to_string(Criterion criterion) {
  switch (criterion) {
  case Criterion::residual:
    return "residual";
  case Criterion::status:
    return "status";
  case Criterion::gap:
    return "gap";
  case Criterion::projection:
    return "projection";
  case Criterion::point_lost:
    return "point lost";
  case Criterion::distance:
    return "distance";
  case Criterion::singular:
    return "singular matrix";
  case Criterion::geometry_loop:
    return "geometry loop";
  case Criterion::friction_loop:
    return "friction loop";
  case Criterion::plastic_step:
    return "plastic step";
  case Criterion::cell:
    return "cell";
  case Criterion::linear_solve:
    return "linear solve";
  }
  return "";
}

const Unmet* StepReport::unmet_by(Criterion criterion) const {
  const auto found = std::ranges::find(unmet, criterion, &Unmet::criterion);
  return found == unmet.end() ? nullptr : &*found;
}

void name_status_changes(StepReport& report) {
  if (report.changing_points.empty())
    return;
  const auto& first = report.changing_points.front();
  report.unmet.push_back({Criterion::status, first.zone, first.node,
                          static_cast<double>(report.status_changes), 0, report.status_changes});
}

void name_residual_growth(StepReport& report) {
  if (report.outcome == Outcome::singular_matrix)
    report.unmet.insert(report.unmet.begin(), Unmet{Criterion::singular});
  if (!(report.residual <= report.tolerance))
    report.unmet.push_back({Criterion::residual, -1, report.worst_node, report.residual, report.tolerance});
}

std::vector<WorstNode> worst_nodes(const Eigen::VectorXd& residual, std::span<const mesh::NodeIndex> nodes,
                                   double scale) {
  constexpr std::size_t named = 5;
  std::map<mesh::NodeIndex, double> largest;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double entry = std::abs(residual[static_cast<Eigen::Index>(i)]);
    auto& here = largest[nodes[i]];
    here = std::max(here, std::isfinite(entry) ? entry / scale : INFINITY);
  }
  std::vector<WorstNode> worst;
  for (const auto& [node, value] : largest)
    if (value > 0)
      worst.push_back({node, value});
  std::ranges::stable_sort(worst, std::ranges::greater(), &WorstNode::residual);
  worst.resize(std::min(worst.size(), named));
  return worst;
}

} // namespace rubato::step
