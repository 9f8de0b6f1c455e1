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
    const auto places = contact::undeformed_places(mesh, zone.slave);
    const auto edge =
        contact::sharpest_edge(zone.slave, places, {.above = noted, .up_to = contact::sharp_edge});
    if (edge)
      sentences.push_back(fmt::format(
          "contact zone {}: the slave '{}' has an edge of {:.0f}° at {}, where one normal stands for both "
          "sides: forces near it may be wrong by several percent; expected it as master, one zone for each "
          "smooth part, or 'integration: nodes'",
          zone.settings.name, zone.settings.slave, edge->degrees, mesh::node_name(mesh, edge->node)));
  }
  return sentences;
}

} // namespace rubato::model
