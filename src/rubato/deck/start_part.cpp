// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs to the ground, and how the bodies move when the run begins.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

namespace rubato::deck {
namespace {

study::Springs read_springs_of(const Value& value, const Context& context) {
  study::Springs springs;
  springs.at = value.at();
  MapReader map(value);
  read(map.require("on"), springs.on);
  bool given = false;
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto stiffness = find_axis(map, axis, context)) {
      read(stiffness, springs.stiffness[axis], above(0));
      given = true;
    }
  map.finish();
  if (!given && map.is_map())
    value.fault("has no stiffness, expected at least one of x, y, z");
  return springs;
}

/// A map of components, at least one of them.
void read_vector(const Found& value, const Context& context, std::array<std::optional<double>, 3>& vector) {
  if (!value)
    return;
  MapReader map(*value);
  bool given = false;
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto component = find_axis(map, axis, context)) {
      read(component, vector[axis]);
      given = true;
    }
  map.finish();
  if (!given && map.is_map())
    value->fault("has no component, expected at least one of x, y, z");
}

study::InitialMotion read_motion(const Value& value, const Context& context) {
  study::InitialMotion initial;
  initial.at = value.at();
  MapReader map(value);
  read(map.require("on"), initial.on);
  const auto displacement = map.find("displacement");
  const auto velocity = map.find("velocity");
  read_vector(displacement, context, initial.displacement);
  read_vector(velocity, context, initial.velocity);
  map.finish();
  if (!displacement && !velocity && map.is_map())
    value.fault("says nothing, expected 'displacement' or 'velocity'");
  return initial;
}

/// Why a run begins in no other way than its own; empty when it may.
std::string_view own_beginning(const Context& context, const study::TimeStepping& time) {
  if (time.start == study::StartKind::from_run)
    return "the run starts from the end of another one, whose motion it has";
  if (time.start == study::StartKind::at_rest_unloaded)
    return "start: at_rest_unloaded begins at rest, expected start: consistent";
  if (context.scheme == study::SchemeKind::static_steps)
    return "the scheme static finds equilibrium wherever it begins";
  return {};
}

} // namespace

void read_springs(const Found& value, const Context& context, std::vector<study::Springs>& springs) {
  for (const auto& item : items(value))
    springs.push_back(read_springs_of(item, context));
}

void read_initial(const Found& value, const Context& context, const study::TimeStepping& time,
                  std::vector<study::InitialMotion>& initial) {
  for (const auto& item : items(value))
    initial.push_back(read_motion(item, context));
  if (const auto reason = own_beginning(context, time); !reason.empty() && !initial.empty())
    value->fault(std::string(reason));
}

} // namespace rubato::deck
