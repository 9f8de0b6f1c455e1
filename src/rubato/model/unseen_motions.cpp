// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/unseen_motions.hpp"

#include "rubato/domain/behaviour.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

namespace rubato::model {
namespace {

bool has_lower_order(const Model& model, std::size_t i) {
  const auto* behaviour = model.bulk.behaviour(i);
  const auto type = model.mesh.type_of(model.bulk.cells[i]);
  return behaviour != nullptr &&
         kind_of(model.bulk, *behaviour, type).formulation == element::Formulation::lower_order;
}

bool is_held(const Model& model, const mesh::SurfaceFace& side) {
  for (int c = 0; c < model.dofs.components; ++c)
    if (std::ranges::all_of(side.nodes(), [&](mesh::NodeIndex node) {
          return model.reduction.is_prescribed(model.dofs.dof(node, c));
        }))
      return true;
  return false;
}

/// Bit s of a cell: nothing is beside its side s, and no support holds that side.
std::map<mesh::CellIndex, std::uint32_t> open_sides(const Model& model) {
  std::map<mesh::CellIndex, std::uint32_t> open;
  for (const auto& side : mesh::skin(model.mesh, model.bulk.cells))
    if (!is_held(model, side))
      open[side.owner] |= 1U << side.side;
  return open;
}

bool share_a_corner(const cell::CellSide& a, const cell::CellSide& b) {
  return std::ranges::any_of(a.nodes,
                             [&](auto node) { return std::ranges::find(b.nodes, node) != b.nodes.end(); });
}

/// Directions in which both of two opposite sides are open.
int open_directions(CellType type, std::uint32_t open) {
  const auto sides = cell::topology(type).sides;
  int count = 0;
  for (std::size_t a = 0; a < sides.size(); ++a)
    for (std::size_t b = a + 1; b < sides.size(); ++b)
      if ((open >> a & 1U) != 0 && (open >> b & 1U) != 0 && !share_a_corner(sides[a], sides[b]))
        ++count;
  return count;
}

/// Returns whether nothing beside a cell resists the motions without strain at its points: of QUAD8 and
/// HEXA20, and of PENTA6 the twist about its axis. PENTA15 has none.
bool is_unseen(CellType type, std::uint32_t open) {
  if (cell::topology(type).corner_count != 6)
    return open_directions(type, open) >= 2;
  const auto sides = cell::topology(type).sides;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (cell::topology(sides[s].type).corner_count == 4 && (open >> s & 1U) == 0)
      return false;
  return type == CellType::penta6;
}

struct Found {
  std::size_t first = 0, count = 0;
};

} // namespace

std::vector<std::string> notes_on_unseen_motions(const Model& model) {
  std::map<int, Found> found; // by material
  std::optional<std::map<mesh::CellIndex, std::uint32_t>> open;
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
    if (!has_lower_order(model, i))
      continue;
    if (!open)
      open = open_sides(model);
    const auto at = open->find(model.bulk.cells[i]);
    if (at == open->end() || !is_unseen(model.mesh.type_of(at->first), at->second))
      continue;
    auto& of_material = found.try_emplace(model.bulk.law_of_cell[i], Found{i, 0}).first->second;
    ++of_material.count;
  }
  std::vector<std::string> notes;
  for (const auto& [law, of_material] : found)
    notes.push_back(fmt::format(
        "material '{}': {} reduced cell{}, the first {}, ha{} no neighbours in two directions and can deform "
        "without stress; two cells across, or 'formulation: full', cures it",
        model.study.materials[static_cast<std::size_t>(law)].name, of_material.count,
        of_material.count == 1 ? "" : "s",
        domain::cell_label(model.mesh, model.bulk.cells[of_material.first]),
        of_material.count == 1 ? "s" : "ve"));
  return notes;
}

} // namespace rubato::model
