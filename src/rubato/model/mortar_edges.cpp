// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/mortar_edges.hpp"

#include "rubato/contact/sharp_edges.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

namespace rubato::model {
namespace {

/// [degrees] Facets of a round body that is meshed with fewer faces have errors of that size anyway.
constexpr double noted = 15;

} // namespace

std::vector<std::string> edges_in_mortar_zones(std::span<const contact::Zone> zones, const mesh::Mesh& mesh) {
  std::vector<std::string> sentences;
  for (const auto& zone : zones) {
    if (!zone.mortar || zone.obstacle || zone.meets_itself() || zone.holds_geometry())
      continue;
    for (const auto* surface : {&zone.master, &zone.slave}) {
      const bool is_master = surface == &zone.master;
      const auto edge = contact::sharpest_edge(*surface, contact::undeformed_places(mesh, *surface), noted);
      if (!edge)
        continue;
      sentences.push_back(fmt::format(
          "contact zone {}: the {} '{}' has an edge of {:.0f}° at {}; where gaps open beside an edge, mortar "
          "contact feels an overlap of a part of a face: pressures and forces near it may be wrong by far "
          "more than elsewhere; expected surfaces without edges, one zone for each smooth part, or "
          "'integration: nodes'",
          zone.settings.name, is_master ? "master" : "slave",
          is_master ? zone.settings.master : zone.settings.slave, edge->degrees,
          mesh::node_name(mesh, edge->node)));
      break;
    }
  }
  return sentences;
}

} // namespace rubato::model
