// SPDX-License-Identifier: LGPL-3.0-or-later
// Checks: numbers of a run that must come out.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rubato::deck {
namespace {

/// "tip.y" taken apart at its last dot.
struct Quantity {
  std::string name;
  std::string component; ///< empty without a dot
};

Quantity quantity_of(const std::string& written) {
  const auto dot = written.rfind('.');
  if (dot == std::string::npos)
    return {written, {}};
  return {written.substr(0, dot), written.substr(dot + 1)};
}

/// "tip.y": the probe and the component.
void read_probe_component(const Value& value, const Context& context, study::Check& check) {
  std::string written;
  if (!read_name(value, written))
    return;
  const auto [name, axis] = quantity_of(written);
  if (name == written) {
    value.fault(fmt::format("found {}, expected a probe and a component, as in tip.y", shown(written)));
    return;
  }
  check.probe = name;
  const auto axes = study::axis_words.begin() + (context.physics ? study::dimension_of(*context.physics) : 3);
  const auto found = std::find(study::axis_words.begin(), axes, axis);
  if (found == axes)
    value.fault(fmt::format("found the component {}, expected {}", shown(axis),
                            axes == study::axis_words.end() ? "x, y or z" : "x or y"));
  else
    check.component = static_cast<int>(found - study::axis_words.begin());
}

/// "displacement.y", or "displacement" for every component.
void read_field_component(const Value& value, study::CheckedField& checked) {
  std::string written;
  if (!read_name(value, written))
    return;
  const auto [name, component] = quantity_of(written);
  checked.name = name;
  checked.component = component;
}

/// What is checked: a probe or a field.
void read_subject(MapReader& map, const Context& context, study::Check& check) {
  const auto probe = map.find("probe");
  const auto field = map.find("field");
  const auto on = map.find("on");
  if (map.is_map() && probe.has_value() == field.has_value())
    map.value().fault(probe ? "found both 'probe' and 'field', expected one of them"
                            : "'probe' or 'field' is missing");
  if (probe)
    read_probe_component(*probe, context, check);
  if (field)
    read_field_component(*field, check.field.emplace());
  if (on && !field)
    on->fault("goes with 'field' only: a probe has its node already");
  else if (on)
    read_name(on, check.field->on);
}

/// A number, unless another run stands in for it.
void read_reference(MapReader& map, study::Check& check) {
  read(map.find("kind"), check.relative, study::check_kind_words);
  if (!check.run.empty() || check.source == study::CheckSource::other_run)
    map.refuse("reference", "goes without 'run': the difference from another run is held against 0");
  else if (check.field)
    map.find("reference");
  else
    read(map.require("reference"), check.reference);
}

study::Check read_check(const Value& value, const Context& context) {
  study::Check check;
  MapReader map(value);
  read_subject(map, context, check);
  read(map.require("at"), check.at);
  const bool has_run = read_name(map.find("run"), check.run);
  check.source = has_run ? study::CheckSource::other_run : study::CheckSource::external;
  read(map.find("source"), check.source, study::check_source_words);
  read_reference(map, check);
  read(map.require("tolerance"), check.tolerance);
  read(map.find("note"), check.note);
  map.finish();
  return check;
}

} // namespace

void read_checks(const Found& value, const Context& context, std::vector<study::Check>& checks) {
  for (const auto& item : items(value))
    checks.push_back(read_check(item, context));
}

} // namespace rubato::deck
