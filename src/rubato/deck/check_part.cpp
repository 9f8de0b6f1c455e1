// SPDX-License-Identifier: LGPL-3.0-or-later
// Checks: numbers of a run that must come out.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <string>

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

/// "tip.y": the probe and the component; the name alone of a scalar.
void read_probe_component(const Value& value, study::Check& check) {
  std::string written;
  if (!read_name(value, written))
    return;
  const auto [name, component] = quantity_of(written);
  check.probe = name;
  check.component = component;
}

/// "interface.normal", "interface.force.x": the zone and the column of its table.
void read_resultant(const Value& value, study::CheckedResultant& checked) {
  std::string written;
  if (!read_name(value, written))
    return;
  const auto dot = written.find('.');
  if (dot == std::string::npos) {
    value.fault(fmt::format("found {}, expected a contact zone and a resultant, as in {}.normal",
                            shown(written), written));
    return;
  }
  checked.zone = written.substr(0, dot);
  checked.quantity = written.substr(dot + 1);
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

/// What is checked.
void read_subject(MapReader& map, study::Check& check) {
  const auto probe = map.find("probe");
  const auto energy = map.find("energy");
  const auto resultant = map.find("resultant");
  const auto field = map.find("field");
  const auto on = map.find("on");
  if (probe)
    read_probe_component(*probe, check);
  read_name(energy, check.energy);
  if (resultant)
    read_resultant(*resultant, check.resultant.emplace());
  if (field)
    read_field_component(*field, check.field.emplace());
  if (on && !field)
    on->fault("goes with 'field' only: a probe has its node already");
  else if (on)
    read_name(on, check.field->on);
}

/// The instant, or what of the whole history.
void read_when(MapReader& map, study::Check& check) {
  const auto over = map.find("over");
  if (!over)
    read(map.require("at"), check.at);
  else if (read(over, check.when, study::checked_time_words))
    map.refuse("at", "goes without 'over': that is a value of the whole history");
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

study::Check read_check(const Value& value) {
  study::Check check;
  MapReader map(value);
  read_subject(map, check);
  read_when(map, check);
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

void read_checks(const Found& value, std::vector<study::Check>& checks) {
  for (const auto& item : items(value))
    checks.push_back(read_check(item));
}

} // namespace rubato::deck
