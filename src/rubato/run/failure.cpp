// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/failure.hpp"

#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/model/rigid_motions.hpp"
#include "rubato/run/advice.hpp"
#include "rubato/step/finiteness.hpp"
#include "rubato/time/scheme.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::run {
namespace {

using step::Criterion;
using step::Unmet;

/// A message names that many nodes and points; run.json has more.
constexpr std::size_t named = 3;

const std::string& zone_name(const model::Model& model, int zone) {
  return model.zones[static_cast<std::size_t>(zone)].settings.name;
}

std::string node_of(const model::Model& model, const Unmet& unmet) {
  return model::node_label(model.mesh, unmet.node);
}

/// ", and of 3 more points"
std::string others(const Unmet& unmet, std::string_view before) {
  if (unmet.count < 2)
    return "";
  return fmt::format(", {}{} more point{}", before, unmet.count - 1, unmet.count > 2 ? "s" : "");
}

std::string residual_of(const model::Model& model, const step::StepReport& report) {
  std::vector<std::string> nodes;
  for (const auto& worst : report.worst)
    if (nodes.size() < named)
      nodes.push_back(fmt::format("{} at node {}",
                                  nodes.empty() ? fmt::format("{:.2e}", worst.residual)
                                                : fmt::format("{:.1e}", worst.residual),
                                  model::node_label(model.mesh, worst.node)));
  if (nodes.empty())
    nodes.push_back(fmt::format("{:.2e}", report.residual));
  return fmt::format("residual {} (wanted {:.0e})", fmt::join(nodes, ", "), report.tolerance);
}

std::string status_changes_of(const model::Model& model, const step::StepReport& report) {
  std::vector<std::string> points;
  for (const auto& point : report.changing_points)
    if (points.size() < named)
      points.push_back(fmt::format("{} of zone '{}' ({} and {})", model::node_label(model.mesh, point.node),
                                   zone_name(model, point.zone), contact::to_string(point.before),
                                   contact::to_string(point.now)));
  return fmt::format("{} contact points kept changing their status, among them {}", report.status_changes,
                     fmt::join(points, ", "));
}

std::string gap_of(const model::Model& model, const Unmet& unmet) {
  return fmt::format("the gap of zone '{}' is not closed: {:.2e} at node {} (allowed {:.1e}){}",
                     zone_name(model, unmet.zone), unmet.value, node_of(model, unmet), unmet.allowed,
                     others(unmet, "and at "));
}

std::string projection_of(const model::Model& model, const Unmet& unmet) {
  const bool obstacle = model.zones[static_cast<std::size_t>(unmet.zone)].obstacle.has_value();
  return fmt::format(
      "{} still moves: by {:.2e}{} at node {} (allowed {:.0e}){}",
      obstacle ? fmt::format("the normal of the obstacle of zone '{}'", zone_name(model, unmet.zone))
               : fmt::format("the projection on the master of zone '{}'", zone_name(model, unmet.zone)),
      unmet.value, obstacle ? "" : " of a face", node_of(model, unmet), unmet.allowed,
      others(unmet, "and at "));
}

std::string lost_of(const model::Model& model, const Unmet& unmet) {
  return fmt::format("contact was lost at node {} of zone '{}'{}: touched before, it faces nothing now",
                     node_of(model, unmet), zone_name(model, unmet.zone), others(unmet, "and at "));
}

std::string distance_of(const model::Model& model, const Unmet& unmet) {
  return fmt::format(
      "zone '{}' presses node {}, which is {:.3g} from its master (allowed {:.3g}): forces are "
      "in balance, but not those of contact",
      zone_name(model, unmet.zone), node_of(model, unmet), unmet.value, unmet.allowed);
}

std::string loose_of(const model::Model& model) {
  std::vector<std::string> bodies;
  for (const auto& body : model::loose_bodies(model))
    bodies.push_back(
        fmt::format("the body of node {} {}", model::node_label(model.mesh, body.node), body.against));
  const bool springs = std::ranges::any_of(model.springs, &model::Spring::soft);
  return bodies.empty() ? ""
                        : fmt::format("nothing but contact{} holds {}", springs ? " and soft springs" : "",
                                      fmt::join(bodies, ", "));
}

std::string geometry_loop_of(const model::Model& model, const Unmet& unmet) {
  if (!std::isfinite(unmet.value))
    return "the geometry loop had one round, two are the least";
  return fmt::format("displacements still change by {:.2e} of what the step moves, most at node {} (allowed "
                     "{:.0e})",
                     unmet.value, node_of(model, unmet), unmet.allowed);
}

std::string friction_loop_of(const model::Model& model, const Unmet& unmet) {
  return fmt::format("friction pressures still change by {:.2e} of the largest, most at node {} of zone '{}' "
                     "(allowed {:.0e})",
                     unmet.value, node_of(model, unmet), zone_name(model, unmet.zone), unmet.allowed);
}

std::string cell_of(const model::Model& model, const step::StepReport& report) {
  return fmt::format("{} has no forces: {}", domain::cell_label(model.mesh, report.failed_cell->cell),
                     element::described(report.failed_cell->reason));
}

std::string plastic_step_of(const model::Model& model, const Unmet& unmet) {
  return fmt::format("the plastic strain at node {} grew by {:.2e} in one step (time.max_plastic_step: {:g})",
                     node_of(model, unmet), unmet.value, unmet.allowed);
}

/// Of a nonlinear bulk.
std::string stability_of(const model::Model& model) {
  return fmt::format("the effective matrix without contact was not positive definite: {}",
                     model.study.time.scheme == study::SchemeKind::static_steps
                         ? "the state is not stable under these loads, as past a limit load or where a part "
                           "buckles"
                         : "a part buckles, faster than the steps follow");
}

std::string sentence(const model::Model& model, const step::StepReport& report, const Unmet& unmet) {
  switch (unmet.criterion) {
  case Criterion::residual:
    return residual_of(model, report);
  case Criterion::status:
    return status_changes_of(model, report);
  case Criterion::gap:
    return gap_of(model, unmet);
  case Criterion::projection:
    return projection_of(model, unmet);
  case Criterion::point_lost:
    return lost_of(model, unmet);
  case Criterion::distance:
    return distance_of(model, unmet);
  case Criterion::singular:
    return loose_of(model);
  case Criterion::geometry_loop:
    return geometry_loop_of(model, unmet);
  case Criterion::friction_loop:
    return friction_loop_of(model, unmet);
  case Criterion::plastic_step:
    return plastic_step_of(model, unmet);
  case Criterion::cell:
    return cell_of(model, report);
  case Criterion::linear_solve:
    return fmt::format("conjugate gradients left {:.1e} of a right side (allowed: {:.0e})", unmet.value,
                       unmet.allowed);
  }
  return "";
}

/// Of an explicit run.
std::string explain_growth(const model::Model& model, const results::Failure& failure) {
  if (failure.report.failed_cell)
    return fmt::format("{} (between t = {:g} and {:g})", cell_of(model, failure.report), failure.begin,
                       failure.end);
  return fmt::format("displacements grew beyond all bounds between t = {:g} and {:g}; the first that is not "
                     "finite: {}",
                     failure.begin, failure.end, failure.not_finite);
}

} // namespace

results::Failure failure_of(const model::Model& model, const simulation::RejectedStep& step) {
  const auto& attempt = step.attempt;
  const auto& time = model.study.time;
  results::Failure failure{attempt.begin, attempt.end, attempt.cut_level, step.report, {}, {}};
  failure.advice = study::is_explicit(time.scheme)
                       ? std::vector<std::string>{"a shorter time.step", "a smaller time.safety"}
                       : advice(model, time::make_scheme(time), failure);
  if (step.report.outcome == step::Outcome::not_finite)
    failure.not_finite = step::first_not_finite(model, attempt.end, step.reached, step.report);
  return failure;
}

std::string explain(const model::Model& model, const results::Failure& failure) {
  if (study::is_explicit(model.study.time.scheme))
    return explain_growth(model, failure);
  const auto& report = failure.report;
  auto text = fmt::format("no convergence from t = {:g} to {:g} ({}, {} iterations)", failure.begin,
                          failure.end, step::to_string(report.outcome), report.iterations);
  if (!failure.not_finite.empty())
    text += fmt::format("; the first that is not finite: {}", failure.not_finite);
  if (!model.free_body_nodes.empty() && report.unmet_by(Criterion::singular) == nullptr)
    if (const auto loose = loose_of(model); !loose.empty())
      text += fmt::format("; {}, which may not hold this load", loose);
  for (const auto& unmet : report.unmet)
    if (const auto line = sentence(model, report, unmet);
        !line.empty() && (failure.not_finite.empty() || unmet.criterion == Criterion::cell))
      text += "; " + line;
  if (report.indefinite)
    text += "; " + stability_of(model);
  if (!failure.advice.empty())
    text += fmt::format("; what may help: {}", fmt::join(failure.advice, "; "));
  return text;
}

} // namespace rubato::run
