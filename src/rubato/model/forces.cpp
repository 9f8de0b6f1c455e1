// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/field_forces.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/load/nodal_forces.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/build.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace rubato::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<double> row_of(const Eigen::MatrixXd& matrix, Eigen::Index row) {
  std::vector<double> values(static_cast<std::size_t>(matrix.cols()));
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = matrix(row, static_cast<Eigen::Index>(k));
  return values;
}

class LoadBuilder {
public:
  LoadBuilder(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
              const domain::Bulk& bulk, std::span<const Reference> references, std::vector<Fault>& faults)
      : study_(study), mesh_(mesh), dofs_(dofs), bulk_(bulk), references_(references), faults_(faults) {}

  Force force_of(const study::Load& load, const std::string& path) {
    Force force{VectorXd::Zero(dofs_.dof_count), function_named(study_, load.function)};
    const Mention on{load.on, path + ".on"};
    if (load.kind == study::LoadKind::pressure)
      add_pressure(load, on, path, force);
    else if (const auto* reference = reference_of(load))
      add_on_reference(load, *reference, path, force);
    else
      add_vector(load, on, path, force);
    return force;
  }

  load::FollowerPressure follower_of(const study::Load& load, const std::string& path) {
    load::FollowerPressure follower;
    const Mention on{load.on, path + ".on"};
    auto value = study::field_function(load.components[0], load.function, study_.functions, path + ".value");
    add_on_faces(on, [&](const auto& faces) {
      follower = load::make_follower_pressure(mesh_, dofs_, bulk_.section, faces, std::move(value));
    });
    const VectorXd undeformed = VectorXd::Zero(dofs_.dof_count);
    VectorXd force = undeformed;
    for (const double t : {study_.time.begin, study_.time.end})
      load::add_follower_force(follower, undeformed, t, force); // throws now rather than in a step
    return follower;
  }

private:
  /// The reference that a force or moment acts on; null when it acts on something else.
  const Reference* reference_of(const study::Load& load) const {
    const bool may_act = load.kind == study::LoadKind::nodal_force || load.kind == study::LoadKind::moment;
    return may_act ? reference_named(references_, load.on) : nullptr;
  }

  void add_on_reference(const study::Load& load, const Reference& reference, const std::string& path,
                        Force& force) {
    const bool turns = load.kind == study::LoadKind::moment;
    if (turns && !reference.turns)
      return faults_.push_back(fault_at(
          path + ".on", fmt::format("the nodes of '{}' lie on a line or in a point, which take no moment",
                                    reference.name)));
    for (int i = 0; i < (turns ? 3 : dofs_.components); ++i) {
      const auto axis = static_cast<std::size_t>(i);
      const int row = !turns ? i : dofs_.components == 3 ? 3 + i : 2;
      if (load.components[axis] == 0.0)
        continue;
      const load::LoadedPlace at{{reference.place[0], reference.place[1], reference.place[2]},
                                 reference.dofs,
                                 row_of(reference.motion, row)};
      if (const auto* number = load.components[axis].number())
        load::add_at(at, *number, force.pattern);
      else
        add_field(load, load.components[axis], fmt::format("{}.{}", path, "xyz"[axis]), force,
                  [&](const load::VisitPlace& visit) { visit(at); });
    }
  }

  void add_pressure(const study::Load& load, const Mention& on, const std::string& path, Force& force) {
    add_on_faces(on, [&](const auto& faces) {
      const auto& pressure = load.components[0];
      if (const auto* number = pressure.number())
        load::add_pressure(mesh_, dofs_, bulk_.section, faces, *number, force.pattern);
      else
        add_field(load, pressure, path + ".value", force, [&](const load::VisitPlace& visit) {
          load::visit_pressure(mesh_, dofs_, bulk_.section, faces, visit);
        });
    });
  }

  /// Numbers together, each value that depends on the place by itself.
  void add_vector(const study::Load& load, const Mention& on, const std::string& path, Force& force) {
    Vector3d numbers = Vector3d::Zero();
    for (int i = 0; i < dofs_.components; ++i)
      if (const auto* number = load.components[static_cast<std::size_t>(i)].number())
        numbers[i] = *number;
    const auto add_fields = [&](const auto& places_of) {
      for (int i = 0; i < dofs_.components; ++i)
        if (const auto& value = load.components[static_cast<std::size_t>(i)]; value.number() == nullptr)
          add_field(load, value, fmt::format("{}.{}", path, "xyz"[static_cast<std::size_t>(i)]), force,
                    [&](const load::VisitPlace& visit) { places_of(i, visit); });
    };
    switch (load.kind) {
    case study::LoadKind::nodal_force:
      if (const auto nodes = nodes_or_fault(mesh_, on, faults_); !nodes.empty()) {
        load::add_nodal_force(mesh_, dofs_, nodes, numbers, force.pattern);
        add_fields([&](int i, const auto& visit) { load::visit_nodal_force(mesh_, dofs_, nodes, i, visit); });
      }
      break;
    case study::LoadKind::line_force: {
      const auto lines = edges(on);
      load::add_line_force(mesh_, dofs_, lines, numbers, force.pattern);
      add_fields([&](int i, const auto& visit) { load::visit_line_force(mesh_, dofs_, lines, i, visit); });
      break;
    }
    case study::LoadKind::surface_force:
      add_on_faces(on, [&](const auto& faces) {
        load::add_surface_force(mesh_, dofs_, bulk_.section, faces, numbers, force.pattern);
        add_fields([&](int i, const auto& visit) {
          load::visit_surface_force(mesh_, dofs_, bulk_.section, faces, i, visit);
        });
      });
      break;
    case study::LoadKind::gravity: {
      const auto part = heavy_part(on);
      load::add_gravity(mesh_, dofs_, part, numbers, force.pattern);
      add_fields([&](int i, const auto& visit) { load::visit_gravity(mesh_, dofs_, part, i, visit); });
      if (on.name.empty()) {
        for (int i = 0; i < dofs_.components; ++i)
          visit_masses(i, [&](const load::LoadedPlace& at) { load::add_at(at, numbers[i], force.pattern); });
        add_fields([&](int i, const auto& visit) { visit_masses(i, visit); });
      }
      break;
    }
    case study::LoadKind::moment: // acts on references
    case study::LoadKind::pressure:
      break;
    }
  }

  /// What does not change with time is part of the pattern.
  void add_field(const study::Load& load, const study::FieldValue& value, const std::string& path,
                 Force& force, const std::function<void(const load::VisitPlace&)>& visit_places) {
    auto field = study::field_function(value, {}, study_.functions, path);
    if (!field.varies_in_time()) {
      visit_places([&](const load::LoadedPlace& at) {
        load::add_at(at, field.at(at.place, study_.time.begin), force.pattern);
      });
      return;
    }
    field.function = function_named(study_, load.function);
    load::FieldForce moving{field, {}};
    visit_places([&](const load::LoadedPlace& at) {
      for (const double t : {study_.time.begin, study_.time.end})
        field.at(at.place, t); // throws now rather than in a step
      moving.places.push_back(at);
    });
    force.fields.push_back(std::move(moving));
  }

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

  /// Masses at nodes and of references.
  void visit_masses(int component, const load::VisitPlace& visit) {
    for (const auto& masses : study_.masses) {
      if (const auto* reference = reference_named(references_, masses.on)) {
        const auto& x = reference->place;
        load::LoadedPlace at{{x[0], x[1], x[2]}, reference->dofs, {}};
        for (const double weight : row_of(reference->motion, component))
          at.weights.push_back(masses.mass * weight);
        visit(at);
        continue;
      }
      for (const auto node : mesh::find_nodes(mesh_, masses.on).nodes)
        if (dofs_.has(node)) {
          const auto& x = mesh_.points[static_cast<std::size_t>(node)];
          visit({{x[0], x[1], x[2]}, {dofs_.dof(node, component)}, {masses.mass}});
        }
    }
  }

  domain::Bulk heavy_part(const Mention& on) {
    if (on.name.empty())
      return bulk_;
    domain::Bulk part{bulk_.section, {}, bulk_.laws, {}, bulk_.fields};
    const auto* group = cells_named(mesh_, on, faults_);
    if (group == nullptr)
      return part;
    for (std::size_t i = 0; i < bulk_.cells.size(); ++i)
      if (std::ranges::binary_search(group->items, bulk_.cells[i])) {
        part.cells.push_back(bulk_.cells[i]);
        part.law_of_cell.push_back(bulk_.law_of_cell[i]);
      }
    if (part.cells.empty())
      faults_.push_back(fault_at(
          on.path, fmt::format("group '{}' holds no cells that deform, expected some for gravity", on.name)));
    return part;
  }

  const study::Study& study_;
  const mesh::Mesh& mesh_;
  const domain::DofMap& dofs_;
  const domain::Bulk& bulk_;
  std::span<const Reference> references_;
  std::vector<Fault>& faults_;
};

/// Calls take(load, path) for loads that follow faces, or for the others.
template <class Take>
void for_each_load(const study::Study& study, bool follower, std::vector<Fault>& faults, const Take& take) {
  for (std::size_t i = 0; i < study.loads.size(); ++i) {
    const auto& load = study.loads[i];
    if (load.follower != follower)
      continue;
    const auto path = fmt::format("loads.{}.{}", i, study::word_of(study::load_words, load.kind));
    try {
      take(load, path);
    } catch (const InputError& error) {
      for (const auto& fault : error.faults())
        faults.push_back(fault_at(fault.path.empty() ? path + ".on" : fault.path, fault.text));
    }
  }
}

bool is_controlled(const study::Study& study, const study::Load& load) {
  return study.time.arc_length && load.function.empty();
}

} // namespace

std::vector<mesh::NodeIndex> make_arc_nodes(const study::Study& study, const mesh::Mesh& mesh,
                                            const domain::DofMap& dofs, std::vector<Fault>& faults) {
  const auto& on = study.time.arc_length->on;
  if (on == study::everywhere)
    return dofs.nodes;
  return body_nodes_or_fault(mesh, dofs, {on, "time.arc_length.on"}, "whose motion is measured", faults);
}

std::vector<Force> make_forces(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                               const domain::Bulk& bulk, std::span<const Reference> references,
                               std::vector<Fault>& faults) {
  LoadBuilder builder(study, mesh, dofs, bulk, references, faults);
  std::vector<Force> forces;
  for_each_load(study, false, faults, [&](const study::Load& load, const std::string& path) {
    forces.push_back(builder.force_of(load, path));
    forces.back().is_controlled = is_controlled(study, load);
  });
  return forces;
}

std::vector<load::FollowerPressure> make_followers(const study::Study& study, const mesh::Mesh& mesh,
                                                   const domain::DofMap& dofs, const domain::Bulk& bulk,
                                                   std::vector<Fault>& faults) {
  LoadBuilder builder(study, mesh, dofs, bulk, {}, faults);
  std::vector<load::FollowerPressure> followers;
  for_each_load(study, true, faults, [&](const study::Load& load, const std::string& path) {
    followers.push_back(builder.follower_of(load, path));
    followers.back().is_controlled = is_controlled(study, load);
  });
  return followers;
}

} // namespace rubato::model
