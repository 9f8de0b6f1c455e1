// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/attempt_json.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace rubato::results {
namespace {

using nlohmann::ordered_json;

/// JSON knows no infinity.
ordered_json finite(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

const std::string& zone_name(const model::Model& model, int zone) {
  return model.zones[static_cast<std::size_t>(zone)].settings.name;
}

bool iterates_on_bulk(const model::Model& model) {
  return !model.domain.is_linear() && !study::is_explicit(model.study.time.scheme);
}

/// Which cell has no forces, and why.
ordered_json to_json(const model::Model& model, const domain::CellFailure& failure) {
  return {{"label", domain::cell_label(model.mesh, failure.cell)},
          {"reason", element::described(failure.reason)}};
}

ordered_json to_json(const model::Model& model, const step::Unmet& unmet) {
  ordered_json json{{"criterion", step::to_string(unmet.criterion)}};
  if (unmet.zone >= 0)
    json["zone"] = zone_name(model, unmet.zone);
  if (unmet.node >= 0)
    json["node"] = model::node_label(model.mesh, unmet.node);
  if (unmet.criterion != step::Criterion::singular && unmet.criterion != step::Criterion::cell)
    json.update({{"value", finite(unmet.value)}, {"allowed", unmet.allowed}, {"count", unmet.count}});
  return json;
}

ordered_json to_json(const model::Model& model, const std::vector<step::Unmet>& unmet) {
  auto json = ordered_json::array();
  for (const auto& each : unmet)
    json.push_back(to_json(model, each));
  return json;
}

} // namespace

ordered_json to_json(const model::Model& model, const simulation::Attempt& attempt,
                     const step::StepReport& report) {
  ordered_json json; // filled entry by entry: a list of them would be copied twice, in every step
  json["begin"] = attempt.begin;
  json["end"] = attempt.end;
  json["cut_level"] = attempt.cut_level;
  json["accepted"] = attempt.accepted;
  json["outcome"] = step::to_string(report.outcome);
  json["iterations"] = report.iterations;
  if (iterates_on_bulk(model)) {
    json["bulk_iterations"] = report.bulk_iterations;
    json["factorisations"] = report.factorisations;
    json["bulk_residuals"] = report.bulk_residuals;
    json["indefinite"] = report.indefinite;
    if (report.unstable_directions > 0)
      json["unstable_directions"] = report.unstable_directions;
    json["exact_tangent"] = report.exact_tangent;
  }
  if (model.study.time.arc_length)
    json["load_factor"] = report.load_factor;
  json["residual"] = report.residual;
  json["status_changes"] = report.status_changes;
  json["geometry_by_loop"] = report.geometry_by_loop;
  json["friction_continuation"] = report.friction_continuation;
  json["seconds"] = attempt.seconds;
  for (const auto& round : report.rounds)
    json["rounds"].push_back({{"level", step::to_string(round.level)},
                              {"round", round.round},
                              {"iterations", round.iterations},
                              {"change", round.change},
                              {"settled", round.settled}});
  if (!attempt.accepted)
    json["unmet"] = to_json(model, report.unmet);
  if (!attempt.accepted && report.failed_cell)
    json["failed_cell"] = to_json(model, *report.failed_cell);
  if (!attempt.accepted && report.worst_node >= 0)
    json["worst_node"] = model::node_label(model.mesh, report.worst_node);
  return json;
}

ordered_json to_json(const model::Model& model, const Failure& failure) {
  const auto& report = failure.report;
  ordered_json json{{"begin", failure.begin},
                    {"end", failure.end},
                    {"cut_level", failure.cut_level},
                    {"outcome", step::to_string(report.outcome)},
                    {"level", step::level_of(report.outcome)},
                    {"iterations", report.iterations},
                    {"residual", finite(report.residual)},
                    {"tolerance", report.tolerance},
                    {"unmet", to_json(model, report.unmet)},
                    {"worst_nodes", ordered_json::array()},
                    {"status_changes", report.status_changes},
                    {"changed_status", ordered_json::array()},
                    {"advice", failure.advice}};
  if (report.failed_cell)
    json["failed_cell"] = to_json(model, *report.failed_cell);
  if (iterates_on_bulk(model))
    json["indefinite"] = report.indefinite;
  if (!failure.not_finite.empty())
    json["not_finite"] = failure.not_finite;
  for (const auto& worst : report.worst)
    json["worst_nodes"].push_back(
        {{"node", model::node_label(model.mesh, worst.node)}, {"residual", finite(worst.residual)}});
  for (const auto& point : report.changing_points)
    json["changed_status"].push_back({{"zone", zone_name(model, point.zone)},
                                      {"node", model::node_label(model.mesh, point.node)},
                                      {"before", contact::to_string(point.before)},
                                      {"now", contact::to_string(point.now)}});
  return json;
}

} // namespace rubato::results
