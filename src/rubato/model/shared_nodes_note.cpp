// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/shared_nodes_note.hpp"

#include "rubato/contact/shared_nodes.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::model {
namespace {

/// Points on both sides of an edge of one surface are no surprise.
bool is_in_several_zones(std::span<const contact::PointOfZone> points) {
  return std::ranges::any_of(points, [&](const auto& point) { return point.zone != points.front().zone; });
}

} // namespace

std::optional<std::string> note_on_shared_nodes(const Model& model) {
  const auto count = std::ranges::count_if(model.shared_nodes, is_in_several_zones);
  const auto first = std::ranges::find_if(model.shared_nodes, is_in_several_zones);
  if (count == 0 || study::is_explicit(model.study.time.scheme))
    return std::nullopt;
  const auto& [zone, point] = first->front();
  return fmt::format("{} slave node{} of several contact zones with friction, the first {}: where two zones "
                     "press on a node, friction acts there only along directions tangential to both",
                     count, count == 1 ? "" : "s",
                     mesh::node_name(model.mesh, model.zones[zone].points[point].nodes.front()));
}

} // namespace rubato::model
