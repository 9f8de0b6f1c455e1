// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/failure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rubato::run {
namespace {

using step::Outcome;

/// A message names that many nodes and points; run.json has more.
constexpr std::size_t named = 3;

const contact::Zone& zone_of(const model::Model& model, const step::RestlessPoint& point) {
  return model.zones[static_cast<std::size_t>(point.zone)];
}

std::string worst_of(const model::Model& model, const step::StepReport& report) {
  std::vector<std::string> nodes;
  for (const auto& worst : report.worst)
    if (nodes.size() < named)
      nodes.push_back(fmt::format("{} at node {}",
                                  nodes.empty() ? fmt::format("{:.2e}", worst.residual)
                                                : fmt::format("{:.1e}", worst.residual),
                                  model::node_label(model.mesh, worst.node)));
  return fmt::format("{}", fmt::join(nodes, ", "));
}

std::string restless_of(const model::Model& model, const step::StepReport& report) {
  std::vector<std::string> points;
  for (const auto& point : report.restless)
    if (points.size() < named)
      points.push_back(fmt::format("{} of zone '{}' ({} and {})", model::node_label(model.mesh, point.node),
                                   zone_of(model, point).settings.name, contact::to_string(point.before),
                                   contact::to_string(point.now)));
  return fmt::format("{} contact points kept changing their status, among them {}", report.status_changes,
                     fmt::join(points, ", "));
}

void advise_on_loops(const contact::Zone& zone, Outcome outcome, std::vector<std::string>& advice) {
  const auto loop = [&](Outcome failed, const deck::Level& level, const char* name) {
    if (outcome == failed && level.by == deck::Iteration::fixed_point)
      advice.push_back(fmt::format("contact.{}.iterate.{}: newton", zone.settings.name, name));
  };
  loop(Outcome::geometry_unsettled, zone.settings.geometry, "geometry");
  loop(Outcome::friction_unsettled, zone.settings.threshold, "friction");
  loop(Outcome::status_unsettled, zone.settings.status, "status");
}

void advise_on_coefficients(const contact::Zone& zone, std::vector<std::string>& advice) {
  const auto& settings = zone.settings;
  const bool springs =
      settings.friction > 0 && settings.friction_method != deck::FrictionMethod::augmented_lagrangian;
  if (springs && settings.tangential_coefficient)
    advice.push_back(fmt::format("a smaller contact.{}.coefficients.tangential than {:g}, or none",
                                 settings.name, *settings.tangential_coefficient));
  if (!contact::is_exact(settings.method) && settings.normal_coefficient)
    advice.push_back(fmt::format("a smaller contact.{}.coefficients.normal than {:g}, or none", settings.name,
                                 *settings.normal_coefficient));
}

} // namespace

bool feeds_on_contact(const model::Model& model, const time::Scheme& scheme) {
  return time::is_undamped(scheme) && std::ranges::any_of(model.zones, [](const contact::Zone& zone) {
           return contact::is_exact(zone.settings.method);
         });
}

std::vector<std::string> advice(const model::Model& model, const time::Scheme& scheme,
                                const step::StepReport& report) {
  std::vector<std::string> advice;
  if (report.outcome == Outcome::not_finite)
    advice.emplace_back("look at the loads and the mesh there");
  if (report.outcome == Outcome::singular_matrix)
    advice.emplace_back("supports for bodies that only contact holds");
  for (const auto& zone : model.zones) {
    advise_on_loops(zone, report.outcome, advice);
    advise_on_coefficients(zone, advice);
  }
  if (feeds_on_contact(model, scheme))
    advice.emplace_back("time: {scheme: moreau_jean}, which gains no energy from contact");
  advice.emplace_back("a shorter time.step");
  if (!report.restless.empty())
    advice.push_back(fmt::format("a look at the mesh around {}",
                                 model::node_label(model.mesh, report.restless.front().node)));
  return advice;
}

std::string explain(const model::Model& model, const results::Failure& failure) {
  const auto& report = failure.report;
  auto text = fmt::format("no convergence from t = {:g} to {:g} ({}, {} iterations)", failure.begin,
                          failure.end, step::to_string(report.outcome), report.iterations);
  if (!failure.not_finite.empty())
    text += fmt::format("; the first that is not finite: {}", failure.not_finite);
  else if (!report.worst.empty())
    text += fmt::format("; residual {} (wanted {:.0e})", worst_of(model, report), report.tolerance);
  if (!report.restless.empty())
    text += "; " + restless_of(model, report);
  if (!failure.advice.empty())
    text += fmt::format("; what may help: {}", fmt::join(failure.advice, "; "));
  return text;
}

} // namespace rubato::run
