// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/summary_json.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/core/tolerances.hpp"
#include "rubato/model/model.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace rubato::results {

using nlohmann::ordered_json;

ordered_json check_json(const CheckResult& r) {
  ordered_json json{{"quantity", r.quantity},
                    {"at", r.over.empty() ? ordered_json(r.at) : ordered_json(r.over)},
                    {"reference", r.reference},
                    {"value", nullptr},
                    {"deviation", nullptr},
                    {"tolerance", r.tolerance},
                    {"kind", r.relative ? "relative" : "absolute"},
                    {"holds", r.holds},
                    {"source", r.source},
                    {"note", r.note}};
  if (!r.run.empty())
    json["run"] = r.run;
  if (!r.where.empty())
    json["where"] = r.where;
  if (!r.failure.empty())
    json["failure"] = r.failure;
  if (r.value) {
    json["value"] = *r.value;
    json["deviation"] = r.deviation;
  }
  return json;
}

ordered_json tolerances_json() {
  ordered_json json = ordered_json::object();
  for (const auto& entry : named_tolerances)
    json[std::string(entry.name)] = tolerances.*entry.value;
  return json;
}

ordered_json sides_json(const model::Model& model) {
  ordered_json json = ordered_json::array();
  for (const auto& zone : model.zones)
    if (!zone.choice.empty())
      json.push_back({{"zone", zone.settings.name},
                      {"slave", zone.settings.slave},
                      {"master", zone.settings.master},
                      {"slave_faces", zone.slave.faces.size()},
                      {"master_faces", zone.master.faces.size()},
                      {"because", zone.choice}});
  return json;
}

} // namespace rubato::results
