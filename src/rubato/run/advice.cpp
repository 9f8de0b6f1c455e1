// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/advice.hpp"

#include "rubato/contact/springs.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/model/rigid_motions.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/schemes.hpp"
#include "rubato/study/validate.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::run {
namespace {

using step::Criterion;
using step::Outcome;

/// Cuts into so many parts have shown that a shorter step does not help.
constexpr double short_enough = 64;
/// What `time.on_failure.levels` is unless a deck says otherwise.
const int usual_levels = study::TimeStepping{}.cut_levels;
/// Loops that came to no end may want that many times the rounds they had.
constexpr int more_rounds = 3;

/// Gathers what may help.
class Advice {
public:
  explicit Advice(const study::Study& study) : study_(study) {}

  void add(std::string text) {
    if (std::ranges::find(lines_, text) == lines_.end())
      lines_.push_back(std::move(text));
  }

  /// Only when the study so changed keeps its rules.
  template <class Change> void add(std::string text, const Change& change) {
    auto changed = study_;
    change(changed);
    if (study::broken_rules(changed).empty())
      add(std::move(text));
  }

  /// The same for one zone.
  template <class Change> void add(std::string text, const contact::Zone& zone, const Change& change) {
    add(std::move(text), [&](study::Study& changed) {
      change(*std::ranges::find(changed.contact, zone.settings.name, &study::ContactZone::name));
    });
  }

  std::vector<std::string> take() { return std::move(lines_); }

private:
  const study::Study& study_;
  std::vector<std::string> lines_;
};

/// The zones that a criterion is about: the one it names, or all.
std::vector<const contact::Zone*> zones_of(const model::Model& model, int zone) {
  if (zone >= 0)
    return {&model.zones[static_cast<std::size_t>(zone)]};
  std::vector<const contact::Zone*> all;
  for (const auto& each : model.zones)
    all.push_back(&each);
  return all;
}

std::string key_of(const contact::Zone& zone, const std::string& key) {
  return fmt::format("contact.{}.{}", zone.settings.name, key);
}

void on_loop(const contact::Zone& zone, study::Level study::ContactZone::*level, const std::string& name,
             Advice& advice) {
  const auto& now = zone.settings.*level;
  if (now.by != study::Iteration::fixed_point)
    return;
  const auto key = key_of(zone, "iterate." + name);
  const int loops = more_rounds * now.max_loops;
  advice.add(key + ": newton", zone,
             [&](study::ContactZone& changed) { (changed.*level).by = study::Iteration::newton; });
  advice.add(fmt::format("{}: {{by: fixed_point, {}max_loops: {}}}", key,
                         name == "status" ? "" : fmt::format("tolerance: {:g}, ", now.tolerance), loops),
             zone, [&](study::ContactZone& changed) { (changed.*level).max_loops = loops; });
}

/// Springs in the place of exact gaps.
void on_gap(const contact::Zone& zone, Advice& advice) {
  const auto method = study::entry_of(zone.settings.method).softer;
  advice.add(
      fmt::format("{}: {}, whose gaps need not close", key_of(zone, "method"), study::entry_of(method).name),
      zone, [&](study::ContactZone& changed) {
        changed.method = method;
        changed.friction_method = study::usual_friction_method(method);
        changed.normal_coefficient.reset();
        changed.tangential_coefficient.reset();
      });
}

void on_projection(const contact::Zone& zone, Advice& advice) {
  for (const auto normal : {study::ContactNormal::slave, study::ContactNormal::average})
    if (zone.settings.normal != normal)
      advice.add(
          fmt::format("{}: {}", key_of(zone, "normal"), study::word_of(study::contact_normal_words, normal)),
          zone, [&](study::ContactZone& changed) { changed.normal = normal; });
}

void on_lost_point(const model::Model& model, const step::Unmet& unmet, Advice& advice) {
  for (const auto* zone : zones_of(model, unmet.zone))
    advice.add(zone->obstacle ? fmt::format("an obstacle of zone '{}' that node {} cannot get past",
                                            zone->settings.name, model::node_label(model.mesh, unmet.node))
                              : fmt::format("a master of zone '{}' that goes on past node {}",
                                            zone->settings.name, model::node_label(model.mesh, unmet.node)));
}

void on_distance(const contact::Zone& zone, Advice& advice) {
  advice.add(key_of(zone, "integration") + ": nodes", zone, [](study::ContactZone& changed) {
    changed.integration = {study::ContactIntegration::nodes, 0};
  });
}

void on_status(const contact::Zone& zone, Advice& advice) {
  if (zone.settings.status.by == study::Iteration::newton)
    advice.add(key_of(zone, "iterate.status") + ": fixed_point", zone,
               [](study::ContactZone& changed) { changed.status.by = study::Iteration::fixed_point; });
  else
    on_loop(zone, &study::ContactZone::status, "status", advice);
}

/// Bodies of revolution that contact holds have the roll of their section as well, against which an
/// axisymmetric model has little beside their hoops.
void on_rolling(const model::Model& model, Advice& advice) {
  if (model.study.physics != study::Physics::axisymmetric ||
      std::ranges::any_of(model.zones, [](const auto& zone) { return zone.settings.friction > 0; }))
    return;
  for (const auto& body : model::loose_bodies(model))
    advice.add(
        fmt::format("friction, or supports that keep the section from rolling, for the body of node {}",
                    model::node_label(model.mesh, body.node)));
}

void on_singular(const model::Model& model, Advice& advice) {
  const auto loose = model::loose_bodies(model);
  for (const auto& body : loose)
    advice.add(fmt::format("supports or springs {} for the body of node {}", body.against,
                           model::node_label(model.mesh, body.node)));
  if (!loose.empty())
    return;
  for (const auto& zone : model.zones)
    if (contact::closes_gaps(zone))
      advice.add(fmt::format("{}: the slave nodes that supports hold", key_of(zone, "exclude_nodes")));
}

/// A body that tips, or slides beyond its friction, has no equilibrium: no path of static states leads on.
void on_lost_hold(const model::Model& model, Advice& advice) {
  const bool rubs =
      std::ranges::any_of(model.zones, [](const auto& zone) { return zone.settings.friction > 0; });
  advice.add(fmt::format("less load, if the body tips or slides{}", rubs ? " beyond its friction" : ""));
  advice.add("time.scheme: moreau_jean, which follows how it moves then",
             [](study::Study& changed) { changed.time.scheme = study::SchemeKind::moreau_jean; });
}

/// Coefficients that the user has chosen and that are part of the answer.
void on_coefficients(const contact::Zone& zone, Advice& advice) {
  for (const auto& [key, value] : contact::given_springs(zone))
    advice.add(fmt::format("a smaller {} than {:g}, or none",
                           key_of(zone, fmt::format("coefficients.{}", key)), value));
}

/// How the cells of a material are integrated, where others bear more strain.
void on_cell(const model::Model& model, const step::StepReport& report, Advice& advice) {
  const auto& failed = *report.failed_cell;
  const auto place = std::ranges::find(model.bulk.cells, failed.cell) - model.bulk.cells.begin();
  const auto& material =
      model.study
          .materials[static_cast<std::size_t>(model.bulk.law_of_cell[static_cast<std::size_t>(place)])];
  const auto type = model.mesh.type_of(failed.cell);
  const auto& physics = model.study.physics;
  if (study::formulation_of(material, physics, type) != study::Formulation::enhanced)
    return;
  const auto other = study::averages_dilatation(type, physics) ? study::Formulation::mean_dilatation
                                                               : study::Formulation::full;
  advice.add(fmt::format("materials.{}.formulation: {}", material.name,
                         study::word_of(study::formulation_words, other)));
}

void on_criterion(const model::Model& model, const step::Unmet& unmet, Advice& advice) {
  if (unmet.criterion == Criterion::singular)
    return on_singular(model, advice);
  if (unmet.criterion == Criterion::point_lost)
    return on_lost_point(model, unmet, advice);
  for (const auto* zone : zones_of(model, unmet.zone)) {
    if (unmet.criterion == Criterion::geometry_loop)
      on_loop(*zone, &study::ContactZone::geometry, "geometry", advice);
    else if (unmet.criterion == Criterion::friction_loop)
      on_loop(*zone, &study::ContactZone::threshold, "friction", advice);
    else if (unmet.criterion == Criterion::status)
      on_status(*zone, advice);
    else if (unmet.criterion == Criterion::projection)
      on_projection(*zone, advice);
    else if (unmet.criterion == Criterion::distance)
      on_distance(*zone, advice);
    else if (unmet.criterion == Criterion::gap)
      on_gap(*zone, advice);
  }
}

/// A gap or a projection that is the only thing not settled names its own cure; while forces are out of
/// balance both are bound to move.
bool is_cause(const step::StepReport& report, const step::Unmet& unmet) {
  const bool follows = unmet.criterion == Criterion::gap || unmet.criterion == Criterion::projection;
  return !follows ||
         (report.unmet_by(Criterion::residual) == nullptr && report.unmet_by(Criterion::status) == nullptr);
}

bool only_residual(const step::StepReport& report) {
  return report.outcome == Outcome::too_many_iterations && report.unmet_by(Criterion::residual) != nullptr &&
         report.unmet_by(Criterion::status) == nullptr && report.unmet_by(Criterion::point_lost) == nullptr;
}

/// The keys of time that moreau_jean does not take, as a run removes them.
std::string without_numbers(const study::TimeStepping& time) {
  std::string removed;
  for (const auto& number : study::entry_of(time.scheme).numbers)
    if (number.get(time))
      removed += fmt::format(", {}: ~", number.key);
  return removed;
}

void on_scheme(const model::Model& model, const time::Scheme& scheme, Advice& advice) {
  if (!feeds_on_contact(model, scheme))
    return;
  const auto time = fmt::format("{{scheme: moreau_jean{}}}", without_numbers(model.study.time));
  advice.add(fmt::format("time: {}, which gains no energy from contact", time),
             [](study::Study& changed) { changed.time.scheme = study::SchemeKind::moreau_jean; });
}

void on_step(const study::TimeStepping& time, const results::Failure& failure, Advice& advice) {
  if (std::pow(time.cut_parts, failure.cut_level) >= short_enough)
    return;
  if (time.instants.empty())
    advice.add("a shorter time.step");
  else
    advice.add(fmt::format("more time.instants around {:g}", failure.end));
  advice.add(fmt::format("time.on_failure.levels: {}", usual_levels));
}

void on_place(const model::Model& model, const step::StepReport& report, Advice& advice) {
  auto node = report.worst_node;
  for (const auto& unmet : report.unmet)
    if (unmet.node >= 0) {
      node = unmet.node;
      break;
    }
  if (node >= 0)
    advice.add(fmt::format("a look at the mesh around {}", model::node_label(model.mesh, node)));
}

} // namespace

bool feeds_on_contact(const model::Model& model, const time::Scheme& scheme) {
  return time::is_undamped(scheme) && std::ranges::any_of(model.zones, contact::closes_gaps);
}

std::vector<std::string> advice(const model::Model& model, const time::Scheme& scheme,
                                const results::Failure& failure) {
  const auto& report = failure.report;
  Advice advice(model.study);
  if (report.outcome == Outcome::not_finite && !report.failed_cell) {
    advice.add("a look at the loads and the mesh there");
    return advice.take();
  }
  if (report.failed_cell)
    on_cell(model, report, advice);
  if (report.outcome == Outcome::unsolved ||
      (report.indefinite && model.study.solver == study::Solver::iterative))
    advice.add("solver: auto, which factors the matrix",
               [](study::Study& changed) { changed.solver = study::Solver::automatic; });
  if (report.outcome == Outcome::plastic_step)
    advice.add(fmt::format("a larger time.max_plastic_step than {:g}", *model.study.time.max_plastic_step));
  const bool is_held_by_contact = !model.free_body_nodes.empty(); // in static runs alone
  if (!is_held_by_contact && report.indefinite && model.study.time.scheme == study::SchemeKind::static_steps)
    advice.add(model.study.time.arc_length
                   ? "shorter steps, or a scheme with inertia"
                   : "supports that move in the place of loads, time.arc_length, or a scheme with inertia");
  if (is_held_by_contact) {
    on_singular(model, advice);
    on_lost_hold(model, advice);
    on_rolling(model, advice);
  }
  for (const auto& unmet : report.unmet)
    if (is_cause(report, unmet))
      on_criterion(model, unmet, advice);
  for (const auto& zone : model.zones)
    on_coefficients(zone, advice);
  on_scheme(model, scheme, advice);
  on_step(model.study.time, failure, advice);
  if (only_residual(report) && !is_held_by_contact)
    advice.add(fmt::format("newton.max_iterations: {}", 2 * model.study.newton.max_iterations));
  on_place(model, report, advice);
  return advice.take();
}

} // namespace rubato::run
