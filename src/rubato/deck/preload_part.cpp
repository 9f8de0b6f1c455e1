// SPDX-License-Identifier: LGPL-3.0-or-later
// Preloads of bolts.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

namespace rubato::deck {
namespace {

/// The force or the shortening: one of them.
void read_amount(MapReader& map, study::Preload& preload) {
  const auto force = map.find("force");
  const auto displacement = map.find("displacement");
  preload.by_force = !displacement.has_value();
  read(force ? force : displacement, preload.value.value);
  if (!map.is_map() || force.has_value() != displacement.has_value())
    return;
  if (force)
    map.value().fault("found 'force' and 'displacement', expected one of them");
  else
    map.value().miss("force");
}

} // namespace

void read_preload(const Found& value, const Context& context, std::vector<study::Preload>& preloads) {
  for (const auto& entry : named_entries(value)) {
    study::Preload preload;
    preload.name = entry.name.text;
    MapReader map(entry.value);
    if (const auto cut = map.require("cut")) {
      MapReader plane(*cut);
      preload.cut = read_cut(plane, context);
      plane.finish();
    }
    read_amount(map, preload);
    read_name(map.find("function"), preload.value.function);
    read(map.find("lock"), preload.lock);
    map.finish();
    preloads.push_back(std::move(preload));
  }
}

} // namespace rubato::deck
