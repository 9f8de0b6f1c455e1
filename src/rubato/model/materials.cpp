// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/behaviour.hpp"
#include "rubato/material/law_field.hpp"
#include "rubato/material/make_point_law.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace rubato::model {
namespace {

/// More of one kind say no more than the first few.
constexpr std::size_t listed_faults = 10;

using mesh::CellIndex;

/// Which material each bulk cell of the mesh has.
class Assignment {
public:
  Assignment(const study::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults)
      : study_(study), mesh_(mesh), faults_(faults), dimension_(element::component_count(study.physics)),
        material_(static_cast<std::size_t>(mesh.cell_count()), -1) {
    for (CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
      if (cell::topology(mesh.type_of(cell)).dimension == dimension_)
        bulk_.push_back(cell);
  }

  std::vector<CellIndex> cells() const { return bulk_; }
  int of(CellIndex cell) const { return material_[static_cast<std::size_t>(cell)]; }

  void give(int index) {
    const auto& material = study_.materials[static_cast<std::size_t>(index)];
    if (material.everywhere) {
      give(index, bulk_);
      if (bulk_.empty())
        faults_.push_back(fault_at("materials." + material.name,
                                   fmt::format("the mesh has no {} cells, expected some for material '{}'",
                                               bulk_noun(), material.name)));
    }
    for (std::size_t i = 0; i < material.cells.size(); ++i) {
      const Mention name{material.cells[i], fmt::format("materials.{}.cells.{}", material.name, i)};
      if (const auto* group = cells_named(mesh_, name, faults_))
        give_group(index, name, group->items);
    }
  }

  void report_cells_without_material() {
    const auto bare = [&](CellIndex cell) { return of(cell) < 0; };
    const auto count = std::ranges::count_if(bulk_, bare);
    if (count == 0)
      return;
    const auto first = *std::ranges::find_if(bulk_, bare);
    const auto path = study_.materials.empty() ? "materials" : "materials." + study_.materials.front().name;
    faults_.push_back(fault_at(
        path,
        fmt::format("{} of {} cells have no material, the first one is cell {} ({}); expected one for every "
                    "cell (`cells: all`, or a group)",
                    count, bulk_.size(), mesh::cell_name(mesh_, first),
                    cell::topology(mesh_.type_of(first)).name)));
  }

private:
  const char* bulk_noun() const { return dimension_ == 3 ? "solid" : "surface"; }

  void give(int index, std::span<const CellIndex> cells) {
    for (const auto cell : cells) {
      auto& now = material_[static_cast<std::size_t>(cell)];
      if (now >= 0 && now != index && std::ranges::find(clashes_, std::pair(now, index)) == clashes_.end()) {
        clashes_.emplace_back(now, index);
        faults_.push_back(
            fault_at("materials." + study_.materials[static_cast<std::size_t>(index)].name,
                     fmt::format("material '{}' is given to cells that have material '{}' already",
                                 study_.materials[static_cast<std::size_t>(index)].name,
                                 study_.materials[static_cast<std::size_t>(now)].name)));
      }
      now = index;
    }
  }

  void give_group(int index, const Mention& name, std::span<const CellIndex> items) {
    std::vector<CellIndex> cells;
    std::ranges::copy_if(items, std::back_inserter(cells), [&](CellIndex cell) {
      return cell::topology(mesh_.type_of(cell)).dimension == dimension_;
    });
    if (cells.empty())
      faults_.push_back(fault_at(
          name.path, fmt::format("group '{}' holds {} cells, expected {} cells for material '{}'", name.name,
                                 cell::topology(mesh_.type_of(items.front())).name, bulk_noun(),
                                 study_.materials[static_cast<std::size_t>(index)].name)));
    give(index, cells);
  }

  const study::Study& study_;
  const mesh::Mesh& mesh_;
  std::vector<Fault>& faults_;
  int dimension_;
  std::vector<CellIndex> bulk_;
  std::vector<int> material_;
  std::vector<std::pair<int, int>> clashes_;
};

} // namespace

namespace {

element::StrainKind strain_kind(study::StrainKind kind) {
  switch (kind) {
  case study::StrainKind::green_lagrange:
    return element::StrainKind::green_lagrange;
  case study::StrainKind::logarithmic:
    return element::StrainKind::logarithmic;
  case study::StrainKind::small:
    break;
  }
  return element::StrainKind::small;
}

element::Formulation formulation(study::Formulation kind) {
  switch (kind) {
  case study::Formulation::mean_dilatation:
    return element::Formulation::mean_dilatation;
  case study::Formulation::enhanced:
    return element::Formulation::enhanced;
  case study::Formulation::reduced:
    return element::Formulation::reduced;
  case study::Formulation::full:
    break;
  }
  return element::Formulation::full;
}

/// Null where cells are linear and integrated in full.
std::shared_ptr<const domain::Behaviour> behaviour_of(const study::Study& study,
                                                      const study::Material& material) {
  const auto wanted = study::wanted_formulation(material);
  if (study::has_constant_stiffness(material) && wanted == study::Formulation::full)
    return nullptr;
  domain::Behaviour behaviour{material::make_point_law(material, study.physics),
                              strain_kind(study::strain_of(material)), formulation(wanted),
                              study::is_linear(study, material)};
  if (study::is_heated(study, material))
    behaviour.expansion = material::expansion_strain(material::make_law(material), *material.expansion);
  return std::make_shared<const domain::Behaviour>(std::move(behaviour));
}

/// Reduced linear bodies have one stiffness where no cell of theirs has forces against hourglasses.
void find_constant_reduced(const study::Study& study, const mesh::Mesh& mesh, domain::Bulk& bulk) {
  std::vector<char> has_hourglasses(study.materials.size(), 0);
  for (std::size_t i = 0; i < bulk.cells.size(); ++i)
    if (study::has_one_point(mesh.type_of(bulk.cells[i])))
      has_hourglasses[static_cast<std::size_t>(bulk.law_of_cell[i])] = 1;
  for (std::size_t m = 0; m < bulk.behaviours.size(); ++m) {
    const auto& material = study.materials[m];
    if (bulk.behaviours[m] == nullptr || has_hourglasses[m] != 0 || is_heated(study, material) ||
        material.formulation != study::Formulation::reduced || !study::has_constant_stiffness(material))
      continue;
    auto behaviour = *bulk.behaviours[m];
    behaviour.constant = true;
    bulk.behaviours[m] = std::make_shared<const domain::Behaviour>(std::move(behaviour));
  }
}

} // namespace

domain::Bulk make_bulk(const study::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults) {
  domain::Bulk bulk;
  bulk.section = {study.physics, study.thickness};
  Assignment assignment(study, mesh, faults);
  bool any_field = false;
  for (std::size_t i = 0; i < study.materials.size(); ++i) {
    const auto& material = study.materials[i];
    const auto field = material::law_field(material, study.physics);
    any_field = any_field || field != nullptr;
    bulk.fields.push_back(field);
    bulk.laws.push_back(field ? material::Law{} : material::make_law(material));
    bulk.behaviours.push_back(field && field->varies_tangent() ? nullptr : behaviour_of(study, material));
    assignment.give(static_cast<int>(i));
  }
  if (faults.empty())
    assignment.report_cells_without_material();
  if (!any_field)
    bulk.fields.clear();
  if (std::ranges::none_of(bulk.behaviours, [](const auto& one) { return one != nullptr; }))
    bulk.behaviours.clear();
  bulk.cells = assignment.cells();
  for (const auto cell : bulk.cells)
    bulk.law_of_cell.push_back(std::max(0, assignment.of(cell)));
  find_constant_reduced(study, mesh, bulk);
  return bulk;
}

namespace {

/// The first component in which a node of the cell is free, "node N5 (1, 0) can move in y"; empty when all
/// are held.
std::string freedom_of(const Model& model, CellIndex cell) {
  for (const auto node : model.mesh.nodes_of(cell))
    for (int i = 0; i < model.dofs.components; ++i)
      if (!model.reduction.is_prescribed(model.dofs.dof(node, i)))
        return fmt::format("node {} can move in {}", node_label(model.mesh, node), "xyz"[i]);
  return "";
}

} // namespace

void check_masses(const Model& model, std::vector<Fault>& faults) {
  std::vector<char> told(model.bulk.laws.size(), 0);
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
    const auto law = static_cast<std::size_t>(model.bulk.law_of_cell[i]);
    if (material::density(model.bulk.laws[law]) > 0 || told[law] != 0)
      continue;
    const auto freedom = freedom_of(model, model.bulk.cells[i]);
    if (freedom.empty())
      continue;
    told[law] = 1;
    const auto& material = model.study.materials[law];
    faults.push_back(fault_at("materials." + material.name,
                              fmt::format("materials.{}.density: found 0, but {}; expected more than 0, or "
                                          "supports that hold every node of its cells in all components",
                                          material.name, freedom)));
  }
}

/// Nodes that are nowhere. True when there are some: whatever they carry has no shape.
template <class Tell> bool tell_lost_nodes(const mesh::Mesh& mesh, const Tell& tell) {
  std::size_t count = 0;
  for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node)
    if (!mesh.points[static_cast<std::size_t>(node)].allFinite() && ++count <= listed_faults)
      tell(fmt::format("node {} has a coordinate that is not finite", node_label(mesh, node)));
  if (count > listed_faults)
    tell(fmt::format("and {} more nodes like these", count - listed_faults));
  return count > 0;
}

void check_shapes(const study::Study& study, const mesh::Mesh& mesh, std::span<const CellIndex> cells,
                  std::vector<Fault>& faults) {
  const auto& file = study.mesh.file;
  const auto where = file.empty() ? "" : fmt::format("mesh file '{}': ", file);
  const auto tell = [&](const std::string& text) { faults.push_back(fault_at("mesh.file", text)); };
  if (tell_lost_nodes(mesh, [&](const std::string& text) { tell(where + text); }))
    return;
  const auto bad = domain::cell_faults(mesh, cells, study.physics);
  for (const auto& fault : std::span(bad).first(std::min(bad.size(), listed_faults)))
    tell(where + fault.text);
  if (bad.size() > listed_faults)
    tell(fmt::format("{}and {} more cells like these", where, bad.size() - listed_faults));
}

} // namespace rubato::model
