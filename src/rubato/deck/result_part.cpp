// SPDX-License-Identifier: LGPL-3.0-or-later
// Probes, fields and checkpoints: what is kept of a run.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rubato::deck {
namespace {

study::Probe read_probe(const NamedValue& entry, const Context& context) {
  study::Probe probe;
  probe.name = entry.name.text;
  probe.at = entry.name.at;
  MapReader map(entry.value);
  const auto node = map.find("node");
  const auto group = map.find("on");
  const auto point = map.find("point");
  const int places = (node ? 1 : 0) + (group ? 1 : 0) + (point ? 1 : 0);
  if (map.is_map() && places != 1)
    entry.value.fault(
        places > 1 ? fmt::format("found {}, expected one of them", !point   ? "both 'node' and 'on'"
                                                                   : !group ? "both 'node' and 'point'"
                                                                   : !node  ? "both 'on' and 'point'"
                                                                            : "'node', 'on' and 'point'")
                   : "'node', 'point' or 'on' is missing");
  read(node, probe.node);
  read(group, probe.node);
  if (const auto take = map.find("take"); read(take, probe.take, study::probe_take_words) && !group)
    take->fault("goes with 'on' only: it says what is taken of the nodes of a group");
  if (std::array<double, 3> place{}; read_point(point, context, place))
    probe.point = place;
  read(map.find("field"), probe.field, study::probe_field_words);
  map.finish();
  return probe;
}

void read_formats(const Found& value, study::FieldOutput& fields) {
  fields.vtu = !value;
  std::vector<study::Name> formats;
  if (!read(value, formats))
    return;
  const auto list = value->tree().is(Tree::Kind::list) ? items(value) : std::vector<Value>{*value};
  for (const auto& format : list)
    if (const auto choice = read_choice(format, {"vtu", "med"}))
      (*choice == 0 ? fields.vtu : fields.med) = true;
}

void read_instants_within(const Found& at, const Context& context, std::vector<double>& instants) {
  if (read(at, instants) && ascends(at, instants))
    for (const auto& instant : items(at)) {
      double number = 0;
      read(Found(instant), number);
      require_within(instant, number, context);
    }
}

} // namespace

void require_within(const Value& value, double instant, const Context& context) {
  if (context.time && !context.time->contains(instant))
    value.fault(fmt::format("found {}, expected an instant of the run, {} to {}", instant, context.time->low,
                            context.time->high));
}

void read_probes(const Found& value, const Context& context, std::vector<study::Probe>& probes) {
  for (const auto& entry : named_entries(value))
    probes.push_back(read_probe(entry, context));
}

void read_fields(const Found& value, const Context& context, study::FieldOutput& fields) {
  if (!value)
    return;
  MapReader map(*value);
  read_formats(map.find("formats"), fields);
  read_instants_within(map.find("at"), context, fields.at);
  read(map.find("every"), fields.every, at_least(0));
  read(map.find("last"), fields.last);
  map.finish();
}

void read_checkpoint(const Found& value, const Context& context, study::CheckpointOutput& checkpoint) {
  if (!value)
    return;
  MapReader map(*value);
  read_instants_within(map.find("at"), context, checkpoint.at);
  read(map.find("every"), checkpoint.every, at_least(0));
  read(map.find("last"), checkpoint.last);
  map.finish();
}

} // namespace rubato::deck
