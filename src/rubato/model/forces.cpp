// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/nodal_forces.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/build.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rubato::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

class LoadBuilder {
public:
  LoadBuilder(const mesh::Mesh& mesh, const domain::DofMap& dofs, const domain::Bulk& bulk,
              std::vector<Fault>& faults)
      : mesh_(mesh), dofs_(dofs), bulk_(bulk), faults_(faults) {}

  VectorXd pattern(const study::Load& load, const Mention& on) {
    VectorXd force = VectorXd::Zero(dofs_.dof_count);
    const Vector3d value(load.components[0], load.components[1], load.components[2]);
    switch (load.kind) {
    case study::LoadKind::nodal_force:
      if (const auto nodes = nodes_or_fault(mesh_, on, faults_); !nodes.empty())
        load::add_nodal_force(mesh_, dofs_, nodes, value, force);
      break;
    case study::LoadKind::line_force:
      load::add_line_force(mesh_, dofs_, edges(on), value, force);
      break;
    case study::LoadKind::surface_force:
      add_on_faces(on, [&](const auto& faces) {
        load::add_surface_force(mesh_, dofs_, bulk_.section, faces, value, force);
      });
      break;
    case study::LoadKind::pressure:
      add_on_faces(on, [&](const auto& faces) {
        load::add_pressure(mesh_, dofs_, bulk_.section, faces, load.components[0], force);
      });
      break;
    case study::LoadKind::gravity:
      add_gravity(on, value, force);
      break;
    }
    return force;
  }

private:
  std::vector<load::Face> edges(const Mention& on) {
    std::vector<load::Face> edges;
    const auto* group = cells_named(mesh_, on, faults_);
    if (group == nullptr)
      return edges;
    for (const auto cell : group->items) {
      const auto type = mesh_.type_of(cell);
      if (cell::topology(type).dimension != 1) {
        faults_.push_back(
            fault_at(on.path, fmt::format("group '{}' holds {} cells, expected edges for a line force",
                                          on.name, cell::topology(type).name)));
        return {};
      }
      edges.push_back({type, mesh_.nodes_of(cell)});
    }
    return edges;
  }

  template <class Add> void add_on_faces(const Mention& on, const Add& add) {
    const auto* group = cells_named(mesh_, on, faults_);
    if (group == nullptr)
      return;
    const auto oriented = mesh::oriented_faces(mesh_, group->items);
    for (const auto& text : mesh::faults_of(mesh_, oriented))
      faults_.push_back(fault_at(on.path, fmt::format("loaded surface '{}': {}", on.name, text)));
    std::vector<load::Face> faces;
    std::ranges::transform(oriented.faces, std::back_inserter(faces), [](const auto& side) {
      return load::Face{side.type, side.nodes()};
    });
    add(faces);
  }

  void add_gravity(const Mention& on, const Vector3d& acceleration, VectorXd& force) {
    if (on.name.empty()) {
      load::add_gravity(mesh_, dofs_, bulk_, acceleration, force);
      return;
    }
    const auto* group = cells_named(mesh_, on, faults_);
    if (group == nullptr)
      return;
    domain::Bulk part{bulk_.section, {}, bulk_.laws, {}};
    for (std::size_t i = 0; i < bulk_.cells.size(); ++i)
      if (std::ranges::binary_search(group->items, bulk_.cells[i])) {
        part.cells.push_back(bulk_.cells[i]);
        part.law_of_cell.push_back(bulk_.law_of_cell[i]);
      }
    if (part.cells.empty())
      faults_.push_back(fault_at(
          on.path, fmt::format("group '{}' holds no cells that deform, expected some for gravity", on.name)));
    load::add_gravity(mesh_, dofs_, part, acceleration, force);
  }

  const mesh::Mesh& mesh_;
  const domain::DofMap& dofs_;
  const domain::Bulk& bulk_;
  std::vector<Fault>& faults_;
};

} // namespace

std::vector<Force> make_forces(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                               const domain::Bulk& bulk, std::vector<Fault>& faults) {
  LoadBuilder builder(mesh, dofs, bulk, faults);
  std::vector<Force> forces;
  for (std::size_t i = 0; i < study.loads.size(); ++i) {
    const auto& load = study.loads[i];
    const Mention on{load.on, fmt::format("loads.{}.{}.on", i, study::word_of(study::load_words, load.kind))};
    try {
      forces.push_back({builder.pattern(load, on), function_named(study, load.function)});
    } catch (const InputError& error) {
      for (const auto& fault : error.faults())
        faults.push_back(fault_at(on.path, fault.text));
    }
  }
  return forces;
}

} // namespace rubato::model
