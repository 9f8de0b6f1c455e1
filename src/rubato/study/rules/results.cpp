// SPDX-License-Identifier: LGPL-3.0-or-later
// Probes, fields, checkpoints and checks: what is kept of a run, and what must come out.
#include "rubato/study/rules/rules.hpp"
#include "rubato/study/stored_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rubato::study {
namespace {

void check_probe(Rules& rules, const Probe& probe, const std::string& path) {
  if (probe.node.empty() != probe.point.has_value())
    rules.broken({path, path + ".node", path + ".on", path + ".point"},
                 probe.point ? "found both 'node' and 'point', expected one of them"
                             : "'node', 'point' or 'on' is missing");
  if (probe.take != ProbeTake::node && probe.node.empty())
    rules.broken({path + ".take", path + ".on"},
                 "goes with 'on' only: it says what is taken of the nodes of a group");
  for (std::size_t axis = 0; probe.point && axis < probe.point->size(); ++axis) {
    const auto at = fmt::format("{}.point.{}", path, axis);
    rules.number(at, probe.point->at(axis));
    if (probe.point->at(axis) != 0)
      rules.axis(at, axis);
  }
}

void check_instants(Rules& rules, const std::string& path, const std::vector<double>& instants) {
  rules.ascending(path, instants);
  for (std::size_t i = 0; i < instants.size(); ++i)
    rules.instant(fmt::format("{}.{}", path, i), instants[i]);
}

void check_probed(Rules& rules, const Check& check, const std::string& path) {
  std::vector<std::string> names;
  std::ranges::transform(rules.study.probes, std::back_inserter(names), &Probe::name);
  if (std::ranges::find(names, check.probe) == names.end())
    rules.broken({path + ".probe", "probes"},
                 fmt::format("no probe is called {}{}", shown(check.probe), suggestion(check.probe, names)));
  if (check.component < 0 || check.component >= dimension_of(rules.study.physics))
    rules.broken(
        {path + ".probe", "physics"},
        fmt::format("found the component {}, expected {}",
                    check.component >= 0 && check.component < 3
                        ? shown(std::string(axis_words.at(static_cast<std::size_t>(check.component))))
                        : fmt::format("{}", check.component),
                    dimension_of(rules.study.physics) == 3 ? "x, y or z" : "x or y"));
}

void check_field(Rules& rules, const CheckedField& checked, const std::string& path) {
  const auto fields = stored_fields(dimension_of(rules.study.physics));
  const auto field = std::ranges::find(fields, checked.name, &StoredField::name);
  if (field == fields.end()) {
    std::vector<std::string> names;
    std::ranges::transform(fields, std::back_inserter(names), &StoredField::name);
    rules.broken({path + ".field", "physics"}, fmt::format("no field is called {}{}", shown(checked.name),
                                                           suggestion(checked.name, names)));
    return;
  }
  const auto& component = checked.component;
  if (component.empty() || std::ranges::find(field->components, component) != field->components.end())
    return;
  rules.broken({path + ".field", "physics"},
               field->components.empty()
                   ? fmt::format("found the component {}, but {} has none", shown(component), field->name)
                   : fmt::format("found the component {} of {}{}", shown(component), field->name,
                                 suggestion(component, field->components)));
}

/// `run` and `source: other_run` mean each other; fields know no other source.
void check_source(Rules& rules, const Check& check, const std::string& path) {
  const auto at = path + ".source";
  if (check.field) {
    if (check.run.empty())
      rules.broken({path, path + ".run"}, "'run' is missing: a field is compared with that of another run");
    return;
  }
  if (!check.run.empty() && check.source != CheckSource::other_run)
    rules.broken({at, path + ".run"},
                 fmt::format("found {} beside 'run', expected 'other_run'",
                             shown(std::string(word_of(check_source_words, check.source)))));
  if (check.run.empty() && check.source == CheckSource::other_run)
    rules.broken({at, path + ".run"}, "found 'other_run', but 'run', which names it, is missing");
}

void check_one(Rules& rules, const Check& check, const std::string& path) {
  if (check.field)
    check_field(rules, *check.field, path);
  else
    check_probed(rules, check, path);
  rules.instant(path + ".at", check.at);
  check_source(rules, check, path);
  rules.number(path + ".reference", check.reference);
  const bool has_reference = check.run.empty() && check.source != CheckSource::other_run && !check.field;
  if (has_reference && check.relative && check.reference == 0)
    rules.broken({path + ".reference", path + ".kind"},
                 "found 0, to which nothing can be relative, expected 'kind: absolute' with it");
  rules.number(path + ".tolerance", check.tolerance, bounds::check_tolerance);
}

} // namespace

void check_probes(Rules& rules) {
  std::vector<std::string> names;
  for (const auto& probe : rules.study.probes) {
    rules.chosen_name("probes." + probe.name, probe.name, names);
    check_probe(rules, probe, "probes." + probe.name);
    names.push_back(probe.name);
  }
}

void check_output(Rules& rules) {
  const auto& fields = rules.study.fields;
  const auto& checkpoint = rules.study.checkpoint;
  check_instants(rules, "fields.at", fields.at);
  rules.whole_number("fields.every", fields.every, bounds::every);
  check_instants(rules, "checkpoint.at", checkpoint.at);
  rules.whole_number("checkpoint.every", checkpoint.every, bounds::every);
}

void check_checks(Rules& rules) {
  for (std::size_t i = 0; i < rules.study.checks.size(); ++i)
    check_one(rules, rules.study.checks[i], fmt::format("checks.{}", i));
}

} // namespace rubato::study
