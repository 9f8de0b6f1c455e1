// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <utility>

namespace rubato::deck {
namespace {

constexpr int most_gauss_points = 7;

/// `nodes`, or `{gauss: n}`.
void read_integration(const Found& value, ContactZone& zone) {
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

void read_coefficients(const Found& value, ContactZone& zone) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("normal"), zone.normal_coefficient, above(0));
  read(map.find("tangential"), zone.tangential_coefficient, above(0));
  map.finish();
}

void read_iterations(const Found& value, ContactZone& zone) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("geometry"), zone.geometry, geometry_iteration_words);
  read(map.find("friction"), zone.friction_threshold, friction_iteration_words);
  read(map.find("status"), zone.status, status_iteration_words);
  map.finish();
}

ContactZone read_zone(const NamedValue& entry) {
  ContactZone zone;
  zone.name = entry.name.text;
  zone.at = entry.name.at;
  MapReader map(entry.value);
  const bool master_read = read(map.require("master"), zone.master);
  const auto slave = map.require("slave");
  if (read(slave, zone.slave) && master_read && zone.slave.text == zone.master.text)
    slave->fault(
        fmt::format("found {} as slave and as master, expected two surfaces", shown(zone.slave.text)));
  read(map.find("friction"), zone.friction, at_least(0));
  read(map.find("method"), zone.method, contact_method_words);
  read(map.find("normal"), zone.normal, contact_normal_words);
  read(map.find("clamped_normal"), zone.clamped_normal, clamped_normal_words);
  read_integration(map.find("integration"), zone);
  read(map.find("exclude_nodes"), zone.exclude_nodes);
  read(map.find("initially_active"), zone.initially_active);
  read_coefficients(map.find("coefficients"), zone);
  read_iterations(map.find("iterate"), zone);
  map.finish();
  return zone;
}

} // namespace

void read_contact(const Found& value, std::vector<ContactZone>& zones) {
  for (const auto& entry : named_entries(value))
    zones.push_back(read_zone(entry));
}

} // namespace rubato::deck
