// SPDX-License-Identifier: LGPL-3.0-or-later
// Probes, fields, checkpoints and checks: what is kept of a run, and what must come out.
#include "rubato/study/rules/rules.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/table_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace rubato::study {
namespace {

void check_axes(Rules& rules, const std::array<double, 3>& vector, const std::string& path) {
  for (std::size_t axis = 0; axis < vector.size(); ++axis) {
    const auto at = fmt::format("{}.{}", path, axis);
    rules.number(at, vector[axis]);
    if (vector[axis] != 0)
      rules.axis(at, axis);
  }
}

/// Zones that `all` finds have names that only the model knows.
void check_zone(Rules& rules, const std::string& zone, const std::string& path) {
  std::vector<std::string> zones;
  for (const auto& one : rules.study.contact)
    if (!one.all)
      zones.push_back(one.name);
  const bool finds_zones =
      std::ranges::any_of(rules.study.contact, [](const ContactZone& one) { return one.all; });
  if (!finds_zones && std::ranges::find(zones, zone) == zones.end())
    rules.broken({path, "contact"},
                 fmt::format("no contact zone is called {}{}", shown(zone), suggestion(zone, zones)));
}

void check_contact_force(Rules& rules, const ContactForce& force, const std::string& path) {
  check_axes(rules, force.about, path + ".about");
  check_zone(rules, force.zone, path + ".zone");
}

/// What a probe is of, but for its place: differences are of two of one kind.
std::string kind_of(const Probe& probe) {
  if (probe.contact)
    return "a contact zone";
  const auto field = std::string(word_of(probe_field_words, probe.field));
  return probe.section ? "a section" : probe.about ? field + " with its moment" : field;
}

void check_difference(Rules& rules, const Probe& probe, const std::string& path) {
  const auto at = path + ".minus";
  if (probe.minus.size() != 2) {
    rules.broken(
        {at}, fmt::format("found {} probes, expected two: the first minus the second", probe.minus.size()));
    return;
  }
  std::vector<const Probe*> found;
  std::vector<std::string> names;
  for (const auto& other : rules.study.probes)
    if (other.minus.empty())
      names.push_back(other.name);
  for (const auto& name : probe.minus) {
    const auto other = std::ranges::find(rules.study.probes, name, &Probe::name);
    if (other == rules.study.probes.end())
      rules.broken({at, "probes"},
                   fmt::format("no probe is called {}{}", shown(name), suggestion(name, names)));
    else if (!other->minus.empty())
      rules.broken({at, "probes"},
                   fmt::format("{} is a difference itself, expected probes that are none", shown(name)));
    else
      found.push_back(&*other);
  }
  if (found.size() == 2 && kind_of(*found[0]) != kind_of(*found[1]))
    rules.broken({at, "probes"},
                 fmt::format("{} is of {} and {} of {}, expected two of one kind", shown(found[0]->name),
                             kind_of(*found[0]), shown(found[1]->name), kind_of(*found[1])));
}

void check_moment(Rules& rules, const Probe& probe, const std::string& path) {
  check_axes(rules, *probe.about, path + ".about");
  if (!is_force(probe.field) || probe.take != ProbeTake::sum)
    rules.broken({path + ".about", path + ".field", path + ".take"},
                 "goes with the sum of a reaction, internal_force or contact_force over 'on' only: it is the "
                 "place that the moment is about");
}

void check_probe_place(Rules& rules, const Probe& probe, const std::string& path) {
  const int places = (probe.node.empty() ? 0 : 1) + (probe.point ? 1 : 0) + (probe.section ? 1 : 0) +
                     (probe.contact ? 1 : 0) + (probe.minus.empty() ? 0 : 1);
  if (places != 1)
    rules.broken(
        {path, path + ".node", path + ".on", path + ".point", path + ".section", path + ".contact",
         path + ".minus"},
        places > 1
            ? "found several of 'node', 'on', 'point', 'section', 'contact' and 'minus', expected one of "
              "them"
            : "'node', 'point', 'on', 'section', 'contact' or 'minus' is missing");
  if (probe.take != ProbeTake::node && probe.node.empty())
    rules.broken({path + ".take", path + ".on"},
                 "goes with 'on' only: it says what is taken of the nodes of a group");
  if (probe.point)
    check_axes(rules, *probe.point, path + ".point");
  if (probe.section)
    check_cut(rules, *probe.section, path + ".section");
  if (probe.contact)
    check_contact_force(rules, *probe.contact, path + ".contact");
  if (probe.about)
    check_moment(rules, probe, path);
  if (!probe.minus.empty())
    check_difference(rules, probe, path);
}

/// What cells have is taken of a group, or is that of the point nearest to a place.
void check_in_cells(Rules& rules, const Probe& probe, const std::string& path) {
  const auto at = path + ".place";
  if (probe.place == ProbePlace::nodes)
    return;
  if (!is_of_cells(probe.field))
    rules.broken({path + ".field", at},
                 fmt::format("found {}, which cells do not have, expected 'place: nodes' with it",
                             word_of(probe_field_words, probe.field)));
  if (probe.take == ProbeTake::node && !probe.point)
    rules.broken({at, path + ".node"}, "goes with 'point', or with 'on' and 'take'");
  if (probe.take == ProbeTake::sum)
    rules.broken({path + ".take", at}, "found sum, expected mean, min or max of what cells have");
}

void check_probe(Rules& rules, const Probe& probe, const std::string& path) {
  check_probe_place(rules, probe, path);
  check_in_cells(rules, probe, path);
  if (is_of_contact(probe.field) && rules.study.contact.empty())
    rules.broken({path + ".field", "contact"}, fmt::format("found {}, but the study has no contact",
                                                           word_of(probe_field_words, probe.field)));
  if (probe.field == ProbeField::temperature && rules.study.temperatures.empty())
    rules.broken({path + ".field", "temperature"}, "found temperature, but the study has no temperatures");
  const bool of_reference = is_reference(rules.study, probe.node);
  const auto at = path + (probe.take == ProbeTake::node ? ".node" : ".on");
  if (probe.field == ProbeField::rotation)
    check_rotation(rules, probe.node, {at, path + ".node", path + ".field", "relations"});
  if (of_reference && !is_of_reference(probe.field))
    rules.broken(
        {path + ".field", at},
        fmt::format("found {}, but '{}' is a reference, which has displacement, velocity, acceleration "
                    "and rotation; its group has the others",
                    word_of(probe_field_words, probe.field), probe.node));
}

void check_instants(Rules& rules, const std::string& path, const std::vector<double>& instants) {
  rules.ascending(path, instants);
  for (std::size_t i = 0; i < instants.size(); ++i)
    rules.instant(fmt::format("{}.{}", path, i), instants[i]);
}

/// "x, y or z"
std::string alternatives(const std::vector<std::string>& words) {
  std::string text = words.front();
  for (std::size_t i = 1; i < words.size(); ++i)
    text += (i + 1 < words.size() ? ", " : " or ") + words[i];
  return text;
}

void check_probed(Rules& rules, const Check& check, const std::string& path) {
  std::vector<std::string> names;
  std::ranges::transform(rules.study.probes, std::back_inserter(names), &Probe::name);
  const auto probe = std::ranges::find(rules.study.probes, check.probe, &Probe::name);
  if (probe == rules.study.probes.end()) {
    rules.broken({path + ".probe", "probes"},
                 fmt::format("no probe is called {}{}", shown(check.probe), suggestion(check.probe, names)));
    return;
  }
  const auto components = components_of(*probe, rules.study);
  const auto& component = check.component;
  if (component.empty() && !components.empty())
    rules.broken({path + ".probe", "probes"},
                 fmt::format("found {}, expected a probe and a component, as in {}.{}", shown(check.probe),
                             check.probe, components.back()));
  else if (!component.empty() && components.empty())
    rules.broken({path + ".probe", "probes"},
                 fmt::format("found the component {}, but {} has none", shown(component),
                             probe->minus.empty() ? kind_of(*probe) : "the difference"));
  else if (!component.empty() && std::ranges::find(components, component) == components.end())
    rules.broken({path + ".probe", "physics"}, fmt::format("found the component {}, expected {}",
                                                           shown(component), alternatives(components)));
}

void check_energy(Rules& rules, const Check& check, const std::string& path) {
  const std::vector<std::string> known(energy_quantities.begin(), energy_quantities.end());
  if (std::ranges::find(known, check.energy) == known.end())
    rules.broken({path + ".energy"}, fmt::format("no energy is called {}{}", shown(check.energy),
                                                 suggestion(check.energy, known)));
}

void check_resultant(Rules& rules, const CheckedResultant& checked, const std::string& path) {
  check_zone(rules, checked.zone, path + ".resultant");
  const auto known = resultant_quantities(dimension_of(rules.study.physics));
  if (std::ranges::find(known, checked.quantity) == known.end())
    rules.broken({path + ".resultant", "physics"},
                 fmt::format("no resultant is called {}{}", shown(checked.quantity),
                             suggestion(checked.quantity, known)));
}

void check_field(Rules& rules, const CheckedField& checked, const std::string& path) {
  auto fields = stored_fields(dimension_of(rules.study.physics));
  std::erase_if(fields, [](const StoredField& field) { return field.place != FieldPlace::nodes; });
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

/// What is checked; one of four.
void check_subject(Rules& rules, const Check& check, const std::string& path) {
  const int subjects = (check.probe.empty() ? 0 : 1) + (check.energy.empty() ? 0 : 1) +
                       (check.resultant ? 1 : 0) + (check.field ? 1 : 0);
  if (subjects != 1)
    rules.broken({path, path + ".probe", path + ".energy", path + ".resultant", path + ".field"},
                 subjects == 0 ? "'probe', 'energy', 'resultant' or 'field' is missing"
                               : "found several of 'probe', 'energy', 'resultant' and 'field', "
                                 "expected one of them");
  else if (check.field)
    check_field(rules, *check.field, path);
  else if (check.resultant)
    check_resultant(rules, *check.resultant, path);
  else if (!check.energy.empty())
    check_energy(rules, check, path);
  else
    check_probed(rules, check, path);
}

void check_when(Rules& rules, const Check& check, const std::string& path) {
  if (check.when == CheckedTime::instant)
    rules.instant(path + ".at", check.at);
  else if (!check.run.empty())
    rules.broken({path + ".over", path + ".run"},
                 "goes without 'run': the difference from another run is that of an instant, 'at'");
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
  check_subject(rules, check, path);
  check_when(rules, check, path);
  check_source(rules, check, path);
  rules.number(path + ".reference", check.reference);
  const bool has_reference = check.run.empty() && check.source != CheckSource::other_run && !check.field;
  if (has_reference && check.relative && check.reference == 0)
    rules.broken({path + ".reference", path + ".kind"},
                 "found 0, to which nothing can be relative, expected 'kind: absolute' with it");
  rules.number(path + ".tolerance", check.tolerance, bounds::check_tolerance);
}

void check_chosen_fields(Rules& rules, const std::vector<std::string>& fields, const std::string& path) {
  const auto known = stored_field_names();
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (const auto at = fmt::format("{}.{}", path, i); std::ranges::find(known, fields[i]) == known.end())
      rules.broken({at, path},
                   fmt::format("no field is called {}{}", shown(fields[i]), suggestion(fields[i], known)));
    else if (rules.study.contact.empty() && fields[i].starts_with("contact_"))
      rules.broken({at, path, "contact"},
                   fmt::format("found {}, but the study has no contact", shown(fields[i])));
}

void check_table(Rules& rules, const PrintedTable& table, const std::string& path) {
  const auto known = table_words(table.of);
  if (table.quantities.empty())
    rules.broken({path + ".quantities"}, "found no quantities, expected at least one");
  for (const auto& quantity : table.quantities)
    if (std::ranges::find(known, quantity) == known.end())
      rules.broken({path + ".quantities"},
                   fmt::format("found {}, expected for {} some of: {}", shown(quantity),
                               word_of(table_of_words, table.of), fmt::join(known, ", ")));
  const bool has_energy = std::ranges::any_of(
      table.quantities, [](const auto& quantity) { return quantity == "ENER" || quantity == "ELSE"; });
  if (has_energy && !stores_half_of_products(rules.study))
    rules.broken({path + ".quantities", "materials"},
                 "found ENER or ELSE, which tables have of elastic materials with small strains alone");
  if (table.of == TableOf::faces && table.on.empty())
    rules.broken({path + ".faces"}, "found all faces, expected a group of faces");
  if (table.of == TableOf::zones && !table.on.empty())
    check_zone(rules, table.on, path + ".zones");
  if (table.of == TableOf::zones && rules.study.contact.empty())
    rules.broken({path + ".zones"}, "found a table of contact, but the study has no contact");
  rules.whole_number(path + ".every", table.every, bounds::every);
}

} // namespace

void check_cut(Rules& rules, const Cut& cut, const std::string& path) {
  check_axes(rules, cut.point, path + ".point");
  check_axes(rules, cut.normal, path + ".normal");
  if (std::ranges::all_of(cut.normal, [](double x) { return x == 0; }))
    rules.broken({path + ".normal"}, "found a vector of length 0, expected one that points somewhere");
}

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
  check_chosen_fields(rules, fields.only, "fields.only");
  check_chosen_fields(rules, fields.also, "fields.also");
  if (!fields.only.empty() && !fields.also.empty())
    rules.broken({"fields.also", "fields.only"},
                 "goes without 'only', which names all fields that are written");
  rules.whole_number("fields.digits", fields.digits, bounds::digits);
  const auto& checkpoint = rules.study.checkpoint;
  check_instants(rules, "fields.at", fields.at);
  rules.whole_number("fields.every", fields.every, bounds::every);
  check_instants(rules, "checkpoint.at", checkpoint.at);
  rules.whole_number("checkpoint.every", checkpoint.every, bounds::every);
  rules.whole_number("fields.step", fields.step, bounds::step_number);
  for (std::size_t i = 0; i < fields.tables.size(); ++i)
    check_table(rules, fields.tables[i], fmt::format("fields.tables.{}", i));
}

void check_checks(Rules& rules) {
  for (std::size_t i = 0; i < rules.study.checks.size(); ++i)
    check_one(rules, rules.study.checks[i], fmt::format("checks.{}", i));
}

} // namespace rubato::study
