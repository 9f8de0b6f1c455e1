// SPDX-License-Identifier: LGPL-3.0-or-later
// Probes, fields and checkpoints: what is kept of a run.
#include "rubato/core/naming.hpp"
#include "rubato/deck/parts.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/table_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace rubato::deck {
namespace {

study::Cut read_section(const Value& value, const Context& context) {
  MapReader map(value);
  auto cut = read_cut(map, context);
  read_name(map.find("on"), cut.on);
  map.finish();
  return cut;
}

study::ContactForce read_contact_force(const Value& value, const Context& context) {
  study::ContactForce force;
  MapReader map(value);
  read_name(map.require("zone"), force.zone);
  read_point(map.require("about"), context, force.about);
  map.finish();
  return force;
}

/// What says where a probe is.
constexpr std::array<std::string_view, 6> places_of_probes{"node",    "point",   "on",
                                                           "section", "contact", "minus"};

/// A fault unless there is one of the places.
void check_places(const NamedValue& entry, const MapReader& map, const std::vector<std::string>& given) {
  if (!map.is_map() || given.size() == 1)
    return;
  if (given.empty())
    entry.value.fault("'node', 'point', 'on', 'section', 'contact' or 'minus' is missing");
  else
    entry.value.fault(fmt::format("found {}, expected one of them",
                                  given.size() == 2 ? fmt::format("both '{}' and '{}'", given[0], given[1])
                                                    : fmt::format("'{}'", fmt::join(given, "', '"))));
}

/// Forces of a group are summed: together they hold the body.
void read_take(const Found& value, const Found& group, study::Probe& probe) {
  if (!value && group && study::is_force(probe.field))
    probe.take = study::ProbeTake::sum;
  if (read(value, probe.take, study::probe_take_words) && !group)
    value->fault("goes with 'on' only: it says what is taken of the nodes of a group");
}

void read_probe_place(const Found& value, bool has_field, study::Probe& probe) {
  if (read(value, probe.place, study::probe_place_words) && !has_field)
    value->fault("goes with 'point' or 'on': cells and their points have fields");
}

study::Probe read_probe(const NamedValue& entry, const Context& context) {
  study::Probe probe;
  probe.name = entry.name.text;
  MapReader map(entry.value);
  std::map<std::string_view, Found> places;
  std::vector<std::string> given;
  for (const auto place : places_of_probes)
    if (places[place] = map.find(place); places[place])
      given.emplace_back(place);
  check_places(entry, map, given);
  read_name(places["node"], probe.node);
  read_name(places["on"], probe.node);
  if (std::array<double, 3> point{}; read_point(places["point"], context, point))
    probe.point = point;
  if (places["section"])
    probe.section = read_section(*places["section"], context);
  if (places["contact"])
    probe.contact = read_contact_force(*places["contact"], context);
  read_names(places["minus"], probe.minus);
  const auto field = map.find("field");
  const bool has_field = !(places["section"] || places["contact"] || places["minus"]);
  if (read(field, probe.field, study::probe_field_words) && !has_field)
    field->fault("goes with 'node', 'point' or 'on': sections and contact have forces, differences what "
                 "their probes have");
  read_take(map.find("take"), places["on"], probe);
  if (std::array<double, 3> about{}; read_point(map.find("about"), context, about))
    probe.about = about;
  read_probe_place(map.find("place"), has_field, probe);
  map.finish();
  return probe;
}

void read_formats(const Found& value, study::FieldOutput& fields) {
  fields.vtu = !value;
  std::vector<std::string> formats;
  if (!read_names(value, formats))
    return;
  const auto list = value->tree().is(Tree::Kind::list) ? items(value) : std::vector<Value>{*value};
  for (const auto& format : list)
    if (const auto choice = read_choice(format, {study::field_formats.begin(), study::field_formats.end()}))
      (*choice == 0   ? fields.vtu
       : *choice == 1 ? fields.med
       : *choice == 2 ? fields.vtkhdf
                      : fields.frd) = true;
}

/// A table is of what its first key names: nodes, cells, faces or zones.
study::PrintedTable read_table(const Value& value) {
  study::PrintedTable table;
  MapReader map(value);
  int given = 0;
  for (const auto& word : study::table_of_words)
    if (read_name(map.find(word.text), table.on)) {
      table.of = word.value;
      ++given;
    }
  if (map.is_map() && given != 1)
    value.fault("expected one of the keys 'nodes', 'cells', 'faces' and 'zones'");
  if (table.on == study::everywhere)
    table.on.clear();
  read_names(map.require("quantities"), table.quantities);
  read_name(map.find("label"), table.label);
  read(map.find("totals"), table.totals, study::table_totals_words);
  read(map.find("every"), table.every);
  map.finish();
  return table;
}

void read_chosen_fields(const Found& value, std::vector<std::string>& fields) {
  std::vector<std::string> names;
  if (!read_names(value, names))
    return;
  const auto known = study::stored_field_names();
  const auto list = value->tree().is(Tree::Kind::list) ? items(value) : std::vector<Value>{*value};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::ranges::find(known, names[i]) != known.end())
      fields.push_back(names[i]);
    else
      list[i].fault(fmt::format("no field is called {}{}", shown(names[i]), suggestion(names[i], known)));
}

} // namespace

study::Cut read_cut(MapReader& map, const Context& context) {
  study::Cut cut;
  read_point(map.require("point"), context, cut.point);
  read_point(map.require("normal"), context, cut.normal);
  read_name(map.find("cells"), cut.cells);
  return cut;
}

void read_probes(const Found& value, const Context& context, std::vector<study::Probe>& probes) {
  for (const auto& entry : named_entries(value))
    probes.push_back(read_probe(entry, context));
}

void read_fields(const Found& value, study::FieldOutput& fields) {
  if (!value)
    return;
  MapReader map(*value);
  read_formats(map.find("formats"), fields);
  read_chosen_fields(map.find("only"), fields.only);
  read_chosen_fields(map.find("also"), fields.also);
  read(map.find("digits"), fields.digits);
  read(map.find("at"), fields.at);
  read(map.find("every"), fields.every);
  read(map.find("last"), fields.last);
  read(map.find("frd"), fields.frd_binary, study::frd_words);
  read(map.find("step"), fields.step);
  if (const auto tables = map.find("tables"))
    for (const auto& table : items(*tables))
      fields.tables.push_back(read_table(table));
  map.finish();
}

void read_checkpoint(const Found& value, study::CheckpointOutput& checkpoint) {
  if (!value)
    return;
  MapReader map(*value);
  read(map.find("at"), checkpoint.at);
  read(map.find("every"), checkpoint.every);
  read(map.find("last"), checkpoint.last);
  map.finish();
}

} // namespace rubato::deck
