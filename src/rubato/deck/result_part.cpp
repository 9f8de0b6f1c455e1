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
  read_name(node, probe.node);
  read_name(group, probe.node);
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
  std::vector<std::string> formats;
  if (!read_names(value, formats))
    return;
  const auto list = value->tree().is(Tree::Kind::list) ? items(value) : std::vector<Value>{*value};
  for (const auto& format : list)
    if (const auto choice = read_choice(format, {study::field_formats.begin(), study::field_formats.end()}))
      (*choice == 0 ? fields.vtu : fields.med) = true;
}

} // namespace

void read_probes(const Found& value, const Context& context, std::vector<study::Probe>& probes) {
  for (const auto& entry : named_entries(value))
    probes.push_back(read_probe(entry, context));
}

void read_fields(const Found& value, study::FieldOutput& fields) {
  if (!value)
    return;
  MapReader map(*value);
  read_formats(map.find("formats"), fields);
  read(map.find("at"), fields.at);
  read(map.find("every"), fields.every);
  read(map.find("last"), fields.last);
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
