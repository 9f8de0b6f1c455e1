// SPDX-License-Identifier: LGPL-3.0-or-later
// Probes, fields and checks: what is kept of a run.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rubato::deck {
namespace {

void read_point(const Value& value, const Context& context, Probe& probe) {
  std::vector<double> numbers;
  if (!read(Found(value), numbers))
    return;
  const auto wanted =
      context.physics ? static_cast<std::size_t>(dimension_of(*context.physics)) : numbers.size();
  if (numbers.size() != wanted || numbers.size() > 3) {
    value.fault(
        fmt::format("found {} coordinates, expected {}", numbers.size(), std::min<std::size_t>(wanted, 3)));
    return;
  }
  probe.point.emplace();
  std::ranges::copy(numbers, probe.point->begin());
}

Probe read_probe(const NamedValue& entry, const Context& context) {
  Probe probe;
  probe.name = entry.name.text;
  probe.at = entry.name.at;
  MapReader map(entry.value);
  const auto node = map.find("node");
  const auto point = map.find("point");
  if (map.is_map() && node.has_value() == point.has_value())
    entry.value.fault(node ? "found both 'node' and 'point', expected one of them"
                           : "'node' or 'point' is missing");
  read(node, probe.node);
  if (point)
    read_point(*point, context, probe);
  read(map.find("field"), probe.field, probe_field_words);
  map.finish();
  return probe;
}

void require_within(const Value& value, double instant, const Context& context) {
  if (context.time && !context.time->contains(instant))
    value.fault(fmt::format("found {}, expected an instant of the run, {} to {}", instant, context.time->low,
                            context.time->high));
}

/// "tip.y": the probe and the component.
void read_probe_component(const Found& value, const Context& context, const std::vector<Probe>& probes,
                          Check& check) {
  Name written;
  if (!read(value, written))
    return;
  const auto dot = written.text.rfind('.');
  if (dot == std::string::npos) {
    value->fault(fmt::format("found {}, expected a probe and a component, as in tip.y", shown(written.text)));
    return;
  }
  check.probe = {written.text.substr(0, dot), written.at};
  std::vector<std::string> names;
  names.reserve(probes.size());
  for (const auto& probe : probes)
    names.push_back(probe.name);
  if (std::ranges::find(names, check.probe.text) == names.end())
    value->fault(
        fmt::format("no probe is called {}{}", shown(check.probe.text), suggestion(check.probe.text, names)));
  const auto axis = written.text.substr(dot + 1);
  const auto axes = axis_words.begin() + (context.physics ? dimension_of(*context.physics) : 3);
  const auto found = std::find(axis_words.begin(), axes, axis);
  if (found == axes)
    value->fault(fmt::format("found the component {}, expected {}", shown(axis),
                             axes == axis_words.end() ? "x, y or z" : "x or y"));
  else
    check.component = static_cast<int>(found - axis_words.begin());
}

Check read_check(const Value& value, const Context& context, const std::vector<Probe>& probes) {
  Check check;
  check.where = value.at();
  MapReader map(value);
  read_probe_component(map.require("probe"), context, probes, check);
  if (const auto at = map.require("at"); read(at, check.at))
    require_within(*at, check.at, context);
  const auto reference = map.require("reference");
  const bool reference_read = read(reference, check.reference);
  read(map.require("tolerance"), check.tolerance, above(0));
  const auto kind = map.find("kind");
  const bool kind_known = !kind || read(kind, check.relative, check_kind_words);
  read(map.find("source"), check.source, check_source_words);
  read(map.find("note"), check.note);
  map.finish();
  if (reference_read && kind_known && check.relative && check.reference == 0)
    reference->fault("found 0, to which nothing can be relative, expected 'kind: absolute' with it");
  return check;
}

void read_formats(const Found& value, FieldOutput& fields) {
  fields.vtu = !value;
  std::vector<Name> formats;
  if (!read(value, formats))
    return;
  const auto list = value->tree().is(Tree::Kind::list) ? items(value) : std::vector<Value>{*value};
  for (const auto& format : list)
    if (const auto choice = read_choice(format, {"vtu", "med"}))
      (*choice == 0 ? fields.vtu : fields.med) = true;
}

} // namespace

void read_probes(const Found& value, const Context& context, std::vector<Probe>& probes) {
  for (const auto& entry : named_entries(value))
    probes.push_back(read_probe(entry, context));
}

void read_fields(const Found& value, const Context& context, FieldOutput& fields) {
  if (!value)
    return;
  MapReader map(*value);
  read_formats(map.find("formats"), fields);
  const auto at = map.find("at");
  if (read(at, fields.at) && ascends(at, fields.at))
    for (const auto& instant : items(at)) {
      double number = 0;
      read(Found(instant), number);
      require_within(instant, number, context);
    }
  read(map.find("every"), fields.every, at_least(0));
  read(map.find("last"), fields.last);
  map.finish();
}

void read_checks(const Found& value, const Context& context, const std::vector<Probe>& probes,
                 std::vector<Check>& checks) {
  for (const auto& item : items(value))
    checks.push_back(read_check(item, context, probes));
}

} // namespace rubato::deck
