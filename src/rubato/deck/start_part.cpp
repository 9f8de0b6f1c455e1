// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs, dashpots and masses, and how the bodies move when the run begins.
#include "rubato/deck/parts.hpp"
#include "rubato/study/bounds.hpp"

#include <fmt/format.h>

namespace rubato::deck {
namespace {

study::Springs read_springs_of(const Value& value) {
  study::Springs springs;
  MapReader map(value);
  read_name(map.require("on"), springs.on);
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    read(map.find(study::axis_words[axis]), springs.stiffness[axis],
         study::bounds::spring); // 0 stands for none
  map.finish();
  return springs;
}

/// Force by what `key` has.
void read_law(const Value& value, std::string_view key, std::optional<LinearTable>& law) {
  LinearTable table;
  table.outside = LinearTable::Outside::linear;
  MapReader map(value);
  const bool has_places = read(map.require(key), table.at);
  const bool has_forces = read(map.require("forces"), table.values);
  read(map.find("outside"), table.outside, study::outside_words);
  map.finish();
  if (has_places && has_forces)
    law = std::move(table);
}

study::Connector read_connector(const Value& value, const Context& context) {
  study::Connector connector;
  MapReader map(value);
  read_name(map.require("on"), connector.on);
  read_name(map.find("to"), connector.to);
  if (std::array<double, 3> along{}; read_point(map.find("along"), context, along))
    connector.along = along;
  read(map.find("rotates"), connector.rotates);
  if (std::array<double, 3> anchor{}; read_point(map.find("anchor"), context, anchor))
    connector.anchor = anchor;
  read(map.find("stiffness"), connector.stiffness, study::bounds::connector);
  read(map.find("damping"), connector.damping, study::bounds::connector);
  if (const auto law = map.find("force"))
    read_law(*law, "elongations", connector.force);
  if (const auto law = map.find("damper"))
    read_law(*law, "rates", connector.damper);
  map.finish();
  return connector;
}

study::PointMasses read_masses_of(const Value& value) {
  study::PointMasses masses;
  MapReader map(value);
  read_name(map.require("on"), masses.on);
  read(map.require("mass"), masses.mass, study::bounds::point_mass);
  std::vector<double> inertia;
  if (const auto given = map.find("inertia"); read(given, inertia)) {
    if (inertia.size() == masses.inertia.size())
      std::ranges::copy(inertia, masses.inertia.begin());
    else
      given->fault(fmt::format("found {} numbers, expected three, about x, y and z", inertia.size()));
  }
  map.finish();
  return masses;
}

/// A map of components, at least one of them.
void read_vector(const Found& value, std::array<std::optional<double>, 3>& vector) {
  if (!value)
    return;
  MapReader map(*value);
  bool given = false;
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto component = map.find(study::axis_words[axis])) {
      read(component, vector[axis]);
      given = true;
    }
  map.finish();
  if (!given && map.is_map())
    value->fault("has no component, expected at least one of x, y, z");
}

study::InitialMotion read_motion(const Value& value) {
  study::InitialMotion initial;
  MapReader map(value);
  read_name(map.require("on"), initial.on);
  read_vector(map.find("displacement"), initial.displacement);
  read_vector(map.find("velocity"), initial.velocity);
  map.finish();
  return initial;
}

} // namespace

void read_modal_damping(const Found& value, std::optional<study::ModalDamping>& damping) {
  if (!value)
    return;
  MapReader map(*value);
  study::ModalDamping found;
  const bool has_modes = read(map.require("modes"), found.modes, study::bounds::damped_modes);
  const auto ratio = map.require("ratio");
  bool has_ratios = false;
  if (ratio && ratio->tree().is(Tree::Kind::list))
    has_ratios = read(ratio, found.ratios);
  else if (double all = 0; read(ratio, all)) {
    found.ratios = {all};
    has_ratios = true;
  }
  map.finish();
  if (has_modes && has_ratios)
    damping = found;
}

void read_springs(const Found& value, std::vector<study::Springs>& springs) {
  for (const auto& item : items(value))
    springs.push_back(read_springs_of(item));
}

void read_connectors(const Found& value, const Context& context, std::vector<study::Connector>& connectors) {
  for (const auto& item : items(value))
    connectors.push_back(read_connector(item, context));
}

void read_masses(const Found& value, std::vector<study::PointMasses>& masses) {
  for (const auto& item : items(value))
    masses.push_back(read_masses_of(item));
}

void read_initial(const Found& value, std::vector<study::InitialMotion>& initial) {
  for (const auto& item : items(value))
    initial.push_back(read_motion(item));
}

} // namespace rubato::deck
