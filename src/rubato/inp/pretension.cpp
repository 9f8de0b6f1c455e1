// SPDX-License-Identifier: LGPL-3.0-or-later
// Bolts that *PRE-TENSION SECTION cuts, and gaps between nodes.
#include "rubato/core/naming.hpp"
#include "rubato/inp/points.hpp"
#include "rubato/inp/steps.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace rubato::inp {
namespace {

/// The normal on the data line; nothing given: that of the faces.
std::optional<Eigen::Vector3d> given_normal(Reading& reading, const Block& block) {
  const auto fields = mesh::inp::fields_at(block, 0);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < std::min<std::size_t>(fields.size(), 3); ++i)
    normal[static_cast<Eigen::Index>(i)] =
        mesh::inp::require_number(fields[i], "a component of the normal", reading.faults, 0).value_or(0);
  return normal.norm() > 0 ? std::optional(Eigen::Vector3d(normal.normalized())) : std::nullopt;
}

/// One load or support on the node as the force or the shortening of the cut.
template <class Entries, class Value>
std::optional<study::Amplitude> take_entry(Entries& entries, const std::string& node, const Value& value) {
  const auto found = std::ranges::find(entries, node, &Entries::value_type::on);
  if (found == entries.end())
    return std::nullopt;
  auto amplitude = value(*found);
  entries.erase(found);
  return amplitude;
}

} // namespace

void read_pretension(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto surface_name = mesh::inp::require_value(block, "SURFACE", "a surface", reading.faults);
  const auto node_word = mesh::inp::require_value(block, "NODE", "a node", reading.faults);
  const auto* const surface = surface_name.empty() ? nullptr
                                                   : mesh::inp::find_surface(reading.content, placed.scope,
                                                                             surface_name, reading.faults);
  const auto node = node_word.empty() ? std::nullopt : one_node(reading, placed.scope, node_word);
  if (surface == nullptr || !node)
    return;
  if (surface->cut_cells.empty() || is_of_body(reading, *node))
    return reading.faults.add(
        node_word, "found a pre-tension section without faces, or with a node of elements, expected faces "
                   "within a body and a node of its own");
  study::Preload preload;
  preload.name = chosen_name(reading, "preload", surface->label);
  const auto normal = given_normal(reading, block).value_or(surface->cut_normal);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    preload.cut.point.at(axis) = surface->cut_point[static_cast<Eigen::Index>(axis)];
    preload.cut.normal.at(axis) = normal[static_cast<Eigen::Index>(axis)];
  }
  preload.cut.cells = surface->cut_cells;
  reading.used_nodes.insert(*node);
  reading.places["preload." + preload.name] = node_word.at();
  reading.pretensions.emplace_back(node_name(reading, *node), std::move(preload));
}

void add_pretensions(Reading& reading, study::Study& study) {
  for (const auto& [node, pretension] : reading.pretensions) {
    const auto force = take_entry(study.loads, node, [](const study::Load& load) {
      const auto* const number = load.components[0].number();
      return study::Amplitude{number == nullptr ? 0 : *number, load.function};
    });
    std::optional<study::Amplitude> shortening;
    while (const auto found = take_entry(study.supports, node, [](const study::Support& support) {
             const auto& given = support.components[0];
             return given ? study::Amplitude{given->value.number() == nullptr ? 0 : *given->value.number(),
                                             given->function}
                          : study::Amplitude{};
           }))
      shortening = found->value != 0 || !shortening ? found : shortening;
    auto preload = pretension;
    preload.by_force = force.has_value();
    preload.value = force ? *force : shortening.value_or(study::Amplitude{});
    if (preload.value.value > 0)
      study.preload.push_back(std::move(preload));
    else if (preload.value.value < 0)
      reading.faults.add(reading.places.at("preload." + preload.name),
                         fmt::format("found the pre-tension {}, expected one above 0", preload.value.value));
  }
}

} // namespace rubato::inp
