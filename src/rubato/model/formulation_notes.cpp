// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/formulation_notes.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/material/make_point_law.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/layers.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/unseen_motions.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/validate.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace rubato::model {
namespace {

using study::Formulation;
using study::Material;

/// From here on linear cells that are integrated in full keep their volume more than their shape.
constexpr double nearly_incompressible = 0.45;
/// Above this ratio pressures of quadratic cells that are integrated in full alternate: the force of 16 × 8
/// QUAD8 between rough plates is 2.6 % too large, and pressures deviate by a quarter of their mean.
constexpr double quadratic_limit = 0.49;
/// Fewer layers are too stiff in bending.
constexpr int enough_layers = 4;

/// Places in `bulk.cells` of the cells of each material.
std::vector<std::vector<std::size_t>> cells_by_material(const study::Study& study, const domain::Bulk& bulk) {
  std::vector<std::vector<std::size_t>> cells(study.materials.size());
  for (std::size_t i = 0; i < bulk.cells.size(); ++i)
    cells[static_cast<std::size_t>(bulk.law_of_cell[i])].push_back(i);
  return cells;
}

/// "QUAD4", "QUAD4 and TRIA3".
std::string names_of(const std::set<CellType>& types) {
  const auto names = transformed<std::string>(types, [](CellType type) { return cell::topology(type).name; });
  return joined(names, " and ");
}

/// Whether the study so changed keeps its rules.
bool may_be(const study::Study& study, const Material& material, Formulation formulation) {
  auto changed = study;
  std::ranges::find(changed.materials, material.name, &Material::name)->formulation = formulation;
  return study::broken_rules(changed).empty();
}

/// Poisson's ratio of small strain; 0 where it depends on the place or the law has several.
double poisson_of(const Material& material) {
  if (study::is_hyperelastic(material.law))
    return material::small_strain_moduli(material).poisson;
  return material.law == study::LawKind::orthotropic || material.in_place.contains("poisson")
             ? 0
             : material.poisson;
}

/// Returns what keeps the volume of a material: plastic flow or a ratio above `from`; empty if nothing does.
std::string what_keeps_volume(const Material& material, double from) {
  if (material.law == study::LawKind::plastic && from < quadratic_limit)
    return "plastic flow";
  const double poisson = poisson_of(material);
  return poisson > from ? fmt::format("Poisson's ratio {:.4g}", poisson) : "";
}

constexpr std::string_view by_quadratic = "'mesh: {convert: quadratic}'";
constexpr std::string_view by_mean_dilatation = "'formulation: mean_dilatation'";
constexpr std::string_view by_other_cells = "a mesh of hexahedra, wedges or tetrahedra";

bool is_pyramid(CellType type) {
  return type == CellType::pyra5 || type == CellType::pyra13;
}

/// Returns what to write so that cells of that type do not lock.
std::string cure_of_locking(const Model& model, const Material& material, CellType type) {
  if (is_pyramid(type))
    return std::string(by_other_cells);
  const bool averages = study::averages_dilatation(type, model.study.physics);
  if (averages && may_be(model.study, material, Formulation::mean_dilatation))
    return std::string(by_mean_dilatation);
  if (averages || study::wanted_formulation(material) == Formulation::mean_dilatation)
    return std::string(by_quadratic);
  return fmt::format("{} with {}", by_quadratic, by_mean_dilatation);
}

/// Adds a note for cells of one material whose volume stays: linear cells are too stiff, pressures of
/// quadratic cells alternate from point to point. Cells in plane stress change their thickness and do
/// neither.
void note_locking(const Model& model, const Material& material, const std::vector<std::size_t>& cells,
                  CellFindings& findings) {
  const auto physics = model.study.physics;
  const std::array reasons{what_keeps_volume(material, nearly_incompressible),
                           what_keeps_volume(material, quadratic_limit)};
  if (physics == study::Physics::plane_stress)
    return;
  std::map<std::pair<int, std::string>, std::set<CellType>> found; // by order and cure
  for (const auto i : cells) {
    const auto type = model.mesh.type_of(model.bulk.cells[i]);
    const int order = cell::topology(type).order;
    if (!reasons[order == 1 ? 0 : 1].empty() &&
        study::formulation_of(material, physics, type) == Formulation::full)
      found[{order, cure_of_locking(model, material, type)}].insert(type);
  }
  findings.locking += found.empty() ? 0 : 1;
  for (const auto& [of, types] : found)
    findings.notes.push_back(
        fmt::format("material '{}': its {} cells {}, as {} keeps their volume; {} cures it", material.name,
                    names_of(types), of.first == 1 ? "are too stiff" : "have pressures that alternate",
                    reasons[of.first == 1 ? 0 : 1], of.second));
}

/// Whether supports hold every node of the cell along the axis that is nearest to a direction.
bool is_held_along(const Model& model, mesh::CellIndex cell, const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  for (Eigen::Index i = 1; i < direction.size(); ++i)
    if (std::abs(direction[i]) > std::abs(direction[axis]))
      axis = i;
  return std::ranges::all_of(model.mesh.nodes_of(cell), [&](mesh::NodeIndex node) {
    return model.reduction.is_prescribed(model.dofs.dof(node, static_cast<int>(axis)));
  });
}

/// Cells of one body and material.
struct Part {
  std::size_t cells = 0;   ///< QUAD4 and HEXA8 that are integrated in full
  std::size_t slender = 0; ///< of these, in few layers of a long part
  const Layers* first = nullptr;
  std::set<CellType> types = {};
};

/// Whether few layers of such cells are too stiff in bending.
bool bends_too_stiffly(const Model& model, const Material& material, CellType type) {
  return (type == CellType::quad4 || type == CellType::hexa8) &&
         study::formulation_of(material, model.study.physics, type) == Formulation::full;
}

std::map<int, Part> parts_of(const Model& model, const Material& material, const Bodies& bodies,
                             const std::vector<Layers>& layers, const std::vector<std::size_t>& cells) {
  std::map<int, Part> parts;
  for (const auto i : cells) {
    const auto cell = model.bulk.cells[i];
    const auto type = model.mesh.type_of(cell);
    if (!bends_too_stiffly(model, material, type))
      continue;
    auto& part = parts[bodies.of(model.mesh.nodes_of(cell).front())];
    ++part.cells;
    part.types.insert(type);
    const auto& own = layers[i];
    if (own.count == 0 || own.count >= enough_layers || own.length <= slender * own.thickness ||
        is_held_along(model, cell, own.across))
      continue;
    ++part.slender;
    if (part.first == nullptr)
      part.first = &own;
  }
  return parts;
}

/// Linear cells bend by shear that the part has not. Of each material the first part that consists of such
/// cells for the most part.
void note_bending(const Model& model, const Material& material, const Bodies& bodies,
                  const std::vector<Layers>& layers, const std::vector<std::size_t>& cells,
                  CellFindings& findings) {
  const auto parts = parts_of(model, material, bodies, layers, cells);
  const auto found = std::ranges::find_if(
      parts, [](const auto& part) { return 2 * part.second.slender > part.second.cells; });
  if (found == parts.end())
    return;
  const auto& part = found->second;
  findings.slenderness = std::max(findings.slenderness, part.first->length / part.first->thickness);
  const auto cure = may_be(model.study, material, Formulation::enhanced)
                        ? fmt::format("'formulation: enhanced' or {}", by_quadratic)
                        : std::string(by_quadratic);
  findings.notes.push_back(
      fmt::format("material '{}': {} layer{} of {} across a part {:.2g} times as long as thick "
                  "{} too stiff in bending; {} "
                  "cures it",
                  material.name, part.first->count, part.first->count == 1 ? "" : "s", names_of(part.types),
                  part.first->length / part.first->thickness, part.first->count == 1 ? "is" : "are", cure));
}

} // namespace

namespace {

/// Hourglasses of cells of one point give way where the material yields, of which implicit steps keep no
/// account.
void check_one_point(const study::Study& study, const Material& material, std::vector<Fault>& faults) {
  const auto path = fmt::format("materials.{}.formulation", material.name);
  const auto refuse = [&](const std::string& text) {
    faults.push_back(fault_at(path, fmt::format("{}: {}", path, text)));
  };
  const auto scheme = study.time.scheme;
  if (material.law == study::LawKind::plastic && !study::is_explicit(scheme))
    refuse(fmt::format("the scheme {} takes reduced QUAD4 and HEXA8 of materials that do not yield only, "
                       "expected {}",
                       word_of(study::scheme_words, scheme),
                       study.physics == study::Physics::plane_stress ? "full" : "mean_dilatation"));
  else if (scheme == study::SchemeKind::energy_momentum)
    refuse("the scheme energy_momentum takes no reduced QUAD4 and HEXA8, expected full");
  if (study::is_heated(study, material))
    refuse("found thermal expansion of reduced QUAD4 and HEXA8, which follow no temperature; expected full");
}

} // namespace

void check_formulations(const study::Study& study, const mesh::Mesh& mesh, const domain::Bulk& bulk,
                        std::vector<Fault>& faults) {
  const auto cells = cells_by_material(study, bulk);
  for (std::size_t m = 0; m < cells.size(); ++m) {
    const auto& material = study.materials[m];
    if (!material.formulation || *material.formulation == Formulation::full || cells[m].empty())
      continue;
    std::set<CellType> types;
    for (const auto i : cells[m])
      types.insert(mesh.type_of(bulk.cells[i]));
    const auto has_it = [&](CellType type) {
      return study::formulation_of(material, study.physics, type) == *material.formulation;
    };
    if (std::ranges::none_of(types, has_it))
      faults.push_back(fault_at(
          fmt::format("materials.{}.formulation", material.name),
          fmt::format("materials.{}.formulation: its {} cells have no {}, {}; expected full", material.name,
                      names_of(types), word_of(study::formulation_words, *material.formulation),
                      *material.formulation == Formulation::mean_dilatation
                          ? "all but TRIA3, TETRA4 and pyramids have"
                      : *material.formulation == Formulation::reduced
                          ? "QUAD4, QUAD8, HEXA8, HEXA20, PENTA6 and PENTA15 have"
                          : "QUAD4 and HEXA8 have")));
    if (*material.formulation == Formulation::reduced && std::ranges::any_of(types, study::has_one_point))
      check_one_point(study, material, faults);
  }
}

CellFindings examine_formulations(const Model& model) {
  CellFindings findings;
  const auto& materials = model.study.materials;
  const auto cells = cells_by_material(model.study, model.bulk);
  bool may_bend = false;
  for (std::size_t m = 0; m < cells.size(); ++m) {
    note_locking(model, materials[m], cells[m], findings);
    may_bend = may_bend || std::ranges::any_of(cells[m], [&](std::size_t i) {
                 return bends_too_stiffly(model, materials[m], model.mesh.type_of(model.bulk.cells[i]));
               });
  }
  for (auto& note : notes_on_unseen_motions(model))
    findings.notes.push_back(std::move(note));
  if (!may_bend)
    return findings;
  const Bodies bodies(model.mesh, model.bulk);
  const auto layers = layers_of(model.mesh, model.bulk);
  for (std::size_t m = 0; m < cells.size(); ++m)
    note_bending(model, materials[m], bodies, layers, cells[m], findings);
  return findings;
}

} // namespace rubato::model
