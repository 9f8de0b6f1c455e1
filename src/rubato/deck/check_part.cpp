// SPDX-License-Identifier: LGPL-3.0-or-later
// Checks: numbers of a run that must come out.
#include "rubato/deck/parts.hpp"
#include "rubato/study/stored_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rubato::deck {
namespace {

/// "tip.y" taken apart at its last dot.
struct Quantity {
  study::Name name;
  std::string component; ///< empty without a dot
};

Quantity quantity_of(const study::Name& written) {
  const auto dot = written.text.rfind('.');
  if (dot == std::string::npos)
    return {written, {}};
  return {{written.text.substr(0, dot), written.at}, written.text.substr(dot + 1)};
}

/// "tip.y": the probe and the component.
void read_probe_component(const Value& value, const Context& context, const std::vector<study::Probe>& probes,
                          study::Check& check) {
  study::Name written;
  if (!read(Found(value), written))
    return;
  auto [name, axis] = quantity_of(written);
  if (name.text == written.text) {
    value.fault(fmt::format("found {}, expected a probe and a component, as in tip.y", shown(written.text)));
    return;
  }
  check.probe = std::move(name);
  std::vector<std::string> names;
  std::ranges::transform(probes, std::back_inserter(names), &study::Probe::name);
  if (std::ranges::find(names, check.probe.text) == names.end())
    value.fault(
        fmt::format("no probe is called {}{}", shown(check.probe.text), suggestion(check.probe.text, names)));
  const auto axes = study::axis_words.begin() + (context.physics ? study::dimension_of(*context.physics) : 3);
  const auto found = std::find(study::axis_words.begin(), axes, axis);
  if (found == axes)
    value.fault(fmt::format("found the component {}, expected {}", shown(axis),
                            axes == study::axis_words.end() ? "x, y or z" : "x or y"));
  else
    check.component = static_cast<int>(found - study::axis_words.begin());
}

/// "displacement.y", or "displacement" for every component.
void read_field_component(const Value& value, const Context& context, study::CheckedField& checked) {
  study::Name written;
  if (!read(Found(value), written) || !context.physics)
    return;
  const auto [name, component] = quantity_of(written);
  const auto fields = study::stored_fields(study::dimension_of(*context.physics));
  const auto field = std::ranges::find(fields, name.text, &study::StoredField::name);
  if (field == fields.end()) {
    std::vector<std::string> names;
    std::ranges::transform(fields, std::back_inserter(names), &study::StoredField::name);
    value.fault(fmt::format("no field is called {}{}", shown(name.text), suggestion(name.text, names)));
    return;
  }
  checked.name = name.text;
  checked.component = component;
  if (name.text == written.text || std::ranges::find(field->components, component) != field->components.end())
    return;
  value.fault(field->components.empty()
                  ? fmt::format("found the component {}, but {} has none", shown(component), field->name)
                  : fmt::format("found the component {} of {}{}", shown(component), field->name,
                                suggestion(component, field->components)));
}

/// What is checked: a probe or a field.
void read_subject(MapReader& map, const Context& context, const std::vector<study::Probe>& probes,
                  study::Check& check) {
  const auto probe = map.find("probe");
  const auto field = map.find("field");
  const auto on = map.find("on");
  if (map.is_map() && probe.has_value() == field.has_value())
    map.value().fault(probe ? "found both 'probe' and 'field', expected one of them"
                            : "'probe' or 'field' is missing");
  if (probe)
    read_probe_component(*probe, context, probes, check);
  if (field)
    read_field_component(*field, context, check.field.emplace());
  if (on && !field)
    on->fault("goes with 'field' only: a probe has its node already");
  else if (on)
    read(on, check.field->on);
}

/// `run` and `source: other_run` mean each other.
void read_source(MapReader& map, study::Check& check) {
  const bool has_run = read(map.find("run"), check.run);
  check.source = has_run ? study::CheckSource::other_run : study::CheckSource::external;
  const auto source = map.find("source");
  if (!read(source, check.source, study::check_source_words) || check.field)
    return;
  if (has_run && check.source != study::CheckSource::other_run)
    source->fault(fmt::format("found {} beside 'run', expected 'other_run'",
                              shown(std::string(study::word_of(study::check_source_words, check.source)))));
  if (!has_run && check.source == study::CheckSource::other_run)
    source->fault("found 'other_run', but 'run', which names it, is missing");
}

/// A number, unless another run stands in for it.
void read_reference(MapReader& map, study::Check& check) {
  const auto kind = map.find("kind");
  const bool kind_known = !kind || read(kind, check.relative, study::check_kind_words);
  if (!check.run.text.empty() || check.source == study::CheckSource::other_run) {
    map.refuse("reference", "goes without 'run': the difference from another run is held against 0");
    return;
  }
  if (check.field) {
    map.find("reference");
    map.value().fault("'run' is missing: a field is compared with that of another run");
    return;
  }
  const auto reference = map.require("reference");
  if (read(reference, check.reference) && kind_known && check.relative && check.reference == 0)
    reference->fault("found 0, to which nothing can be relative, expected 'kind: absolute' with it");
}

study::Check read_check(const Value& value, const Context& context, const std::vector<study::Probe>& probes) {
  study::Check check;
  check.where = value.at();
  MapReader map(value);
  read_subject(map, context, probes, check);
  if (const auto at = map.require("at"); read(at, check.at))
    require_within(*at, check.at, context);
  read_source(map, check);
  read_reference(map, check);
  read(map.require("tolerance"), check.tolerance, above(0));
  read(map.find("note"), check.note);
  map.finish();
  return check;
}

} // namespace

void read_checks(const Found& value, const Context& context, const std::vector<study::Probe>& probes,
                 std::vector<study::Check>& checks) {
  for (const auto& item : items(value))
    checks.push_back(read_check(item, context, probes));
}

} // namespace rubato::deck
