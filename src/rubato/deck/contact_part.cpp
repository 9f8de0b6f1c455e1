// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace rubato::deck {
namespace {

constexpr int most_gauss_points = 7;

/// `nodes`, or `{gauss: n}`.
void read_integration(const Found& value, study::ContactZone& zone) {
  if (!value)
    return;
  if (value->tree().is(Tree::Kind::map)) {
    MapReader map(*value);
    read(map.require("gauss"), zone.gauss_points, from_to(1, most_gauss_points));
    map.finish();
  } else if (!value->tree().is(Tree::Kind::word) || value->tree().text != "nodes") {
    value->fault(fmt::format("found {}, expected nodes or {{gauss: n}}", described(value->tree())));
  }
}

void read_coefficients(const Found& value, study::ContactZone& zone) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("normal"), zone.normal_coefficient, above(0));
  read(map.find("tangential"), zone.tangential_coefficient, above(0));
  map.finish();
}

/// `newton`, `fixed_point`, or `{by: fixed_point, tolerance: …, max_loops: …}`.
void read_level(const Found& value, bool has_tolerance, study::Level& level) {
  if (!value || !value->tree().is(Tree::Kind::map)) {
    read(value, level.by, study::iteration_words);
    return;
  }
  MapReader map(*value);
  if (!read(map.require("by"), level.by, study::iteration_words))
    return;
  if (level.by == study::Iteration::newton)
    for (const auto* key : {"tolerance", "max_loops"})
      map.refuse(key, "by newton the level has no loop of its own, fixed_point has one");
  if (has_tolerance)
    read(map.find("tolerance"), level.tolerance, between(0, 1));
  else
    map.refuse("tolerance", "the status loop ends when no status changes");
  read(map.find("max_loops"), level.max_loops, from_to(1, 10'000));
  map.finish();
}

void read_iterations(const Found& value, study::ContactZone& zone) {
  if (!value)
    return;
  MapReader map(*value);
  const auto geometry = map.find("geometry");
  read_level(geometry, true, zone.geometry);
  if (study::is_nodal(zone.method) && zone.geometry.by == study::Iteration::newton)
    geometry->fault(fmt::format("{} holds its relations during a loop, expected fixed_point",
                                study::word_of(study::contact_method_words, zone.method)));
  read_level(map.find("friction"), true, zone.threshold);
  const auto status = map.find("status");
  read_level(status, false, zone.status);
  if (zone.method == study::ContactMethod::nodal_pcg && zone.status.by == study::Iteration::fixed_point)
    status->fault("nodal_pcg finds the points that touch by itself, expected newton");
  map.finish();
}

/// What a friction method goes with; the first one by itself.
std::span<const study::FrictionMethod> friction_methods_of(study::ContactMethod method) {
  using enum study::FrictionMethod;
  static constexpr std::array exact{augmented_lagrangian, penalty};
  static constexpr std::array soft{penalty, augmented_lagrangian};
  static constexpr std::array nodal{nodal_penalty};
  if (study::is_nodal(method))
    return nodal;
  return method == study::ContactMethod::penalty ? std::span<const study::FrictionMethod>(soft) : exact;
}

std::string either(std::span<const study::FrictionMethod> methods) {
  std::string text;
  for (const auto method : methods)
    text +=
        fmt::format("{}{}", text.empty() ? "" : " or ", study::word_of(study::friction_method_words, method));
  return text;
}

void read_friction(MapReader& map, study::ContactZone& zone) {
  const auto friction = map.find("friction");
  read(friction, zone.friction, at_least(0));
  if (zone.method == study::ContactMethod::nodal_pcg && zone.friction > 0)
    friction->fault(fmt::format("found {}, nodal_pcg is without friction, expected 0 or the method "
                                "nodal_lagrange",
                                zone.friction));
  const auto allowed = friction_methods_of(zone.method);
  zone.friction_method = allowed.front();
  const auto method = map.find("friction_method");
  if (read(method, zone.friction_method, study::friction_method_words) &&
      std::ranges::find(allowed, zone.friction_method) == allowed.end())
    method->fault(fmt::format("found {} with the contact method {}, expected {}",
                              study::word_of(study::friction_method_words, zone.friction_method),
                              study::word_of(study::contact_method_words, zone.method), either(allowed)));
}

/// A group or an obstacle, one of them.
void read_master(MapReader& map, const Context& context, const std::map<std::string, Function>& functions,
                 study::ContactZone& zone) {
  const auto master = map.find("master");
  const auto obstacle = map.find("obstacle");
  if (map.is_map() && master.has_value() == obstacle.has_value())
    map.value().fault(master ? "found both 'master' and 'obstacle', expected one of them"
                             : "'master' or 'obstacle' is missing");
  read(master, zone.master);
  if (obstacle)
    zone.obstacle = read_obstacle(*obstacle, context, functions);
}

void read_normals(MapReader& map, study::ContactZone& zone) {
  const auto normal = map.find("normal");
  read(normal, zone.normal, study::contact_normal_words);
  if (zone.obstacle && zone.normal != study::ContactNormal::master)
    normal->fault(fmt::format("found {}, an obstacle gives the normal itself, expected master",
                              study::word_of(study::contact_normal_words, zone.normal)));
  if (zone.obstacle)
    map.refuse("clamped_normal", "no projection on an obstacle is ever clamped");
  else
    read(map.find("clamped_normal"), zone.clamped_normal, study::clamped_normal_words);
}

study::ContactZone read_zone(const NamedValue& entry, const Context& context,
                             const std::map<std::string, Function>& functions) {
  study::ContactZone zone;
  zone.name = entry.name.text;
  zone.at = entry.name.at;
  MapReader map(entry.value);
  read_master(map, context, functions, zone);
  const auto slave = map.require("slave");
  if (read(slave, zone.slave) && zone.slave.text == zone.master.text)
    slave->fault(
        fmt::format("found {} as slave and as master, expected two surfaces", shown(zone.slave.text)));
  read(map.find("method"), zone.method, study::contact_method_words);
  if (study::is_nodal(zone.method))
    zone.geometry.by = study::Iteration::fixed_point;
  read_friction(map, zone);
  read_normals(map, zone);
  const auto integration = map.find("integration");
  read_integration(integration, zone);
  if (study::is_nodal(zone.method) && zone.gauss_points > 0)
    integration->fault(fmt::format("{} has one relation a node, expected nodes; augmented_lagrangian and "
                                   "penalty take Gauss points",
                                   study::word_of(study::contact_method_words, zone.method)));
  read(map.find("exclude_nodes"), zone.exclude_nodes);
  read(map.find("initially_active"), zone.initially_active);
  read_coefficients(map.find("coefficients"), zone);
  read_iterations(map.find("iterate"), zone);
  read(map.find("history_force"), zone.history_force);
  read(map.find("restitution"), zone.restitution, from_to(0, 1));
  map.finish();
  return zone;
}

} // namespace

void read_contact(const Found& value, const Context& context,
                  const std::map<std::string, Function>& functions, std::vector<study::ContactZone>& zones) {
  const auto entries = named_entries(value);
  for (const auto& entry : entries)
    zones.push_back(read_zone(entry, context, functions));
  const auto by_cg = [](const study::ContactZone& zone) {
    return zone.method == study::ContactMethod::nodal_pcg;
  };
  if (std::ranges::none_of(zones, by_cg) || std::ranges::all_of(zones, by_cg))
    return;
  const auto other = std::ranges::find_if_not(zones, by_cg);
  entries[static_cast<std::size_t>(other - zones.begin())].value.fault(fmt::format(
      "found the method {} beside nodal_pcg, which solves for all zones together, expected nodal_pcg "
      "in every zone or in none",
      study::word_of(study::contact_method_words, other->method)));
}

} // namespace rubato::deck
