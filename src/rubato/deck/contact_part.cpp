// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/parts.hpp"
#include "rubato/deck/rows.hpp"

#include <fmt/format.h>

#include <utility>

namespace rubato::deck {
namespace {

/// "nodes or {gauss: n}"
std::string integrations() {
  std::string text;
  for (const auto& entry : study::contact_integrations)
    text += fmt::format(fmt::runtime(entry.most_order > 0 ? "{}{{{}: n}}" : "{}{}"),
                        text.empty() ? "" : " or ", entry.name);
  return text;
}

/// `nodes`, or a map of the rule's name and its order, `{gauss: n}`.
void read_integration(const Found& value, study::ContactRule& rule) {
  if (!value)
    return;
  const auto& tree = value->tree();
  if (tree.is(Tree::Kind::map)) {
    MapReader map(*value);
    bool known = false;
    for (const auto& entry : study::contact_integrations)
      if (const auto order = entry.most_order > 0 && !known ? map.find(entry.name) : Found()) {
        rule.by = entry.method;
        read(order, rule.order, study::from_to(1, entry.most_order));
        known = true;
      }
    if (known)
      return map.finish();
  } else if (tree.is(Tree::Kind::word)) {
    for (const auto& entry : study::contact_integrations)
      if (entry.most_order == 0 && tree.text == entry.name) {
        rule = {entry.method, 0};
        return;
      }
  }
  value->fault(fmt::format("found {}, expected {}", described(tree), integrations()));
}

/// `known`: whether the zone has the method that the deck asks for.
void read_coefficients(const Found& value, bool known, study::ContactZone& zone) {
  if (!value)
    return;
  MapReader map(*value);
  if (known)
    read_numbers_of(map, study::contact_methods, study::entry_of(zone.method), "the method", zone);
  else
    pass_numbers(map, study::contact_methods);
  read(map.find("tangential"), zone.tangential_coefficient);
  if (known && zone.method != study::ContactMethod::exponential)
    map.refuse("curve", fmt::format("{} has no curve of pressures, exponential has one",
                                    study::entry_of(zone.method).name));
  else
    read(map.find("curve"), zone.curve, study::exponential_curve_words);
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
    read(map.find("tolerance"), level.tolerance);
  else
    map.refuse("tolerance", "the status loop ends when no status changes");
  read(map.find("max_loops"), level.max_loops);
  map.finish();
}

void read_iterations(const Found& value, study::ContactZone& zone) {
  if (!value)
    return;
  MapReader map(*value);
  read_level(map.find("geometry"), true, zone.geometry);
  read_level(map.find("friction"), true, zone.threshold);
  read_level(map.find("status"), false, zone.status);
  map.finish();
}

/// A number, or an expression or a table of the place.
void read_coefficient(MapReader& map, const Context& context, study::ContactZone& zone) {
  study::FieldValue value;
  read_field_value(map.find("friction"), context, value);
  if (const auto* number = value.number()) {
    zone.friction = *number;
    return;
  }
  zone.friction = 1;
  zone.friction_in_place = std::move(value);
}

void read_friction(MapReader& map, const Context& context, study::ContactZone& zone) {
  read_coefficient(map, context, zone);
  zone.friction_method = study::usual_friction_method(zone.method);
  read(map.find("friction_method"), zone.friction_method, study::friction_method_words);
}

/// Master (a group or an obstacle) and slave, or one of the keys that stand for both.
void read_surfaces(MapReader& map, const Context& context, study::ContactZone& zone) {
  const auto between = map.find("between");
  const auto self = map.find("self");
  const auto all = map.find("all");
  if (!read_names(between, zone.between) && between)
    map.spoil("between");
  read_name(self, zone.self);
  read(all, zone.all);
  read_name(map.find("master"), zone.master);
  if (const auto obstacle = map.find("obstacle"))
    zone.obstacle = read_obstacle(*obstacle, context);
  read_name(between || self || zone.all ? map.find("slave") : map.require("slave"), zone.slave);
}

void read_normals(MapReader& map, study::ContactZone& zone) {
  read(map.find("normal"), zone.normal, study::contact_normal_words);
  read(map.find("smoothing"), zone.smoothing);
  if (zone.obstacle)
    map.refuse("clamped_normal", "no projection on an obstacle is ever clamped");
  else
    read(map.find("clamped_normal"), zone.clamped_normal, study::clamped_normal_words);
}

/// What is added to the gaps of the mesh.
void read_offsets(MapReader& map, const Context& context, study::ContactZone& zone) {
  if (const auto interference = map.find("interference"))
    zone.interference = read_field(*interference, context);
  if (const auto gap = map.find("gap"))
    zone.gap = read_field(*gap, context);
}

/// What only surfaces have that touch and part.
void read_touching(MapReader& map, const Context& context, bool known_method, study::ContactZone& zone) {
  read_friction(map, context, zone);
  read_offsets(map, context, zone);
  read_normals(map, zone);
  read(map.find("bilateral"), zone.bilateral);
  read(map.find("freeze"), zone.freeze);
  read(map.find("nodal_pairs"), zone.nodal_pairs);
  read(map.find("initially_active"), zone.initially_active);
  read_coefficients(map.find("coefficients"), known_method, zone);
  read_iterations(map.find("iterate"), zone);
  read(map.find("restitution"), zone.restitution);
}

/// The keys of read_touching, but for friction, which a rule is about.
void refuse_touching(MapReader& map, const Context& context, study::ContactZone& zone) {
  read_coefficient(map, context, zone);
  for (const auto* key :
       {"friction_method", "interference", "gap", "normal", "clamped_normal", "smoothing", "bilateral",
        "freeze", "nodal_pairs", "initially_active", "coefficients", "iterate", "restitution"})
    map.refuse(key, "surfaces that are tied (tie: true) neither touch nor part nor slide");
}

study::ContactZone read_zone(const NamedValue& entry, const Context& context) {
  study::ContactZone zone;
  zone.name = entry.name.text;
  MapReader map(entry.value);
  read_surfaces(map, context, zone);
  const auto method = map.find("method");
  const bool known = read(method, zone.method, study::contact_method_words) || !method;
  zone.geometry.by = study::entry_of(zone.method).geometry;
  read(map.find("tie"), zone.tie);
  if (zone.tie)
    refuse_touching(map, context, zone);
  else
    read_touching(map, context, known, zone);
  zone.integration = study::usual_integration(zone, context.scheme.value_or(study::TimeStepping{}.scheme));
  read_integration(map.find("integration"), zone.integration);
  read(map.find("projection_tolerance"), zone.projection_tolerance);
  read_names(map.find("exclude_nodes"), zone.exclude_nodes);
  read(map.find("history_force"), zone.history_force);
  map.finish();
  return zone;
}

} // namespace

void read_contact(const Found& value, const Context& context, std::vector<study::ContactZone>& zones) {
  for (const auto& entry : named_entries(value))
    zones.push_back(read_zone(entry, context));
}

} // namespace rubato::deck
