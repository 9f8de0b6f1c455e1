// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/echo_json.hpp"
#include "rubato/study/study.hpp"
#include "rubato/study/table_words.hpp"

#include <nlohmann/json.hpp>

namespace rubato::study {
namespace {

Json echo(const PrintedTable& table) {
  Json map{{word(table_of_words, table.of), table.on.empty() ? std::string(everywhere) : table.on},
           {"quantities", table.quantities}};
  put_name(map, "label", table.label);
  map["totals"] = word(table_totals_words, table.totals);
  map["every"] = table.every;
  return map;
}

} // namespace

Json echo(const Cut& cut, int dimension) {
  Json map{{"point", first(cut.point, dimension)}, {"normal", first(cut.normal, dimension)}};
  put_name(map, "on", cut.on);
  put_name(map, "cells", cut.cells);
  return map;
}

Json echo(const Probe& probe, int dimension) {
  auto map = Json::object();
  if (probe.take == ProbeTake::node) {
    put_name(map, "node", probe.node);
  } else {
    put_name(map, "on", probe.node);
    map["take"] = word(probe_take_words, probe.take);
  }
  if (probe.point)
    map["point"] = first(*probe.point, dimension);
  if (probe.section)
    map["section"] = echo(*probe.section, dimension);
  if (probe.contact)
    map["contact"] = {{"zone", probe.contact->zone}, {"about", first(probe.contact->about, dimension)}};
  if (!probe.minus.empty())
    map["minus"] = probe.minus;
  if (probe.section || probe.contact || !probe.minus.empty())
    return map;
  map["field"] = word(probe_field_words, probe.field);
  if (probe.place != ProbePlace::nodes)
    map["place"] = word(probe_place_words, probe.place);
  if (probe.about)
    map["about"] = first(*probe.about, dimension);
  return map;
}

Json echo(const FieldOutput& fields) {
  auto formats = Json::array();
  if (fields.vtu)
    formats.push_back("vtu");
  if (fields.med)
    formats.push_back("med");
  if (fields.vtkhdf)
    formats.push_back("vtkhdf");
  if (fields.frd)
    formats.push_back("frd");
  Json map{{"formats", formats}};
  if (!fields.only.empty())
    map["only"] = fields.only;
  else
    map["also"] = fields.also;
  map["digits"] = fields.digits;
  map["at"] = fields.at;
  map["every"] = fields.every;
  map["last"] = fields.last;
  if (fields.frd || fields.frd_binary)
    map["frd"] = word(frd_words, fields.frd_binary);
  if (fields.frd || fields.step != 1)
    map["step"] = fields.step;
  if (!fields.tables.empty())
    for (const auto& table : fields.tables)
      map["tables"].push_back(echo(table));
  return map;
}

Json echo(const CheckpointOutput& checkpoint) {
  return {{"at", checkpoint.at}, {"every", checkpoint.every}, {"last", checkpoint.last}};
}

Json echo(const Check& check) {
  auto map = Json::object();
  if (check.field) {
    const auto& field = *check.field;
    map["field"] = field.component.empty() ? field.name : field.name + "." + field.component;
    put_name(map, "on", field.on);
  } else if (check.resultant) {
    map["resultant"] = check.resultant->zone + "." + check.resultant->quantity;
  } else if (!check.energy.empty()) {
    map["energy"] = check.energy;
  } else {
    map["probe"] = check.component.empty() ? check.probe : check.probe + "." + check.component;
  }
  if (check.when == CheckedTime::instant)
    map["at"] = check.at;
  else
    map["over"] = word(checked_time_words, check.when);
  if (check.run.empty())
    map["reference"] = check.reference;
  put_name(map, "run", check.run);
  map["tolerance"] = check.tolerance;
  map["kind"] = word(check_kind_words, check.relative);
  map["source"] = word(check_source_words, check.source);
  map["note"] = check.note;
  return map;
}

} // namespace rubato::study
