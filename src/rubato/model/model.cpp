// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/model.hpp"

#include "rubato/contact/shared_nodes.hpp"
#include "rubato/core/function.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/mesh/convert.hpp"
#include "rubato/mesh/generate.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/mesh/made_groups.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/mesh/refine.hpp"
#include "rubato/mesh/rounding.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/coarse_slaves.hpp"
#include "rubato/model/formulation_notes.hpp"
#include "rubato/model/gauges.hpp"
#include "rubato/model/large_contact.hpp"
#include "rubato/model/lone_nodes.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/model/relations.hpp"
#include "rubato/model/rigid_motions.hpp"
#include "rubato/model/rigid_sides.hpp"
#include "rubato/model/shared_nodes_note.hpp"
#include "rubato/model/soft_springs.hpp"
#include "rubato/study/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

namespace rubato::model {

Model::Model() = default;
Model::Model(const Model& other) = default;
Model::Model(Model&& other) noexcept = default;
Model& Model::operator=(const Model& other) = default;
Model& Model::operator=(Model&& other) noexcept = default;
Model::~Model() = default;

namespace {

using Eigen::VectorXd;

void number_unknowns(Model& model) {
  const auto count = static_cast<std::size_t>(model.dofs.dof_count);
  model.node_of_dof.resize(count);
  for (const auto node : model.dofs.nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      model.node_of_dof[static_cast<std::size_t>(model.dofs.dof(node, i))] = node;
  for (const auto& zone : model.zones) {
    model.multiplier_offsets.push_back(model.multiplier_count);
    model.multiplier_count += zone.multiplier_count();
  }
}

void stop_on(const std::vector<Fault>& faults) {
  if (!faults.empty())
    throw InputError(faults);
}

/// Instants at which supports end and preloads are locked, those locked before at the begin. Within the run
/// they are stops of its steps.
void note_releases(Model& model) {
  auto& time = model.study.time;
  std::set<double> instants;
  for (const auto& support : model.study.supports)
    if (support.until && *support.until < time.end)
      instants.insert(*support.until);
  for (const auto& preload : model.study.preload)
    if (preload.lock && *preload.lock < time.end)
      instants.insert(std::max(*preload.lock, time.begin));
  model.releases.assign(instants.begin(), instants.end());
  for (const double release : model.releases)
    if (release > time.begin && std::ranges::find(time.stops, release) == time.stops.end())
      time.stops.push_back(release);
}

double value_of(const std::optional<Function>& function, double t) {
  return function ? value_at(*function, t) : 1.0;
}

mesh::Mesh source_mesh(const study::MeshSource& source) {
  mesh::Mesh mesh;
  if (source.file.empty()) {
    mesh = mesh::generate(source.bodies, source.refine);
  } else {
    mesh = mesh::read_mesh(source.file, source.file_mesh);
    mesh::mend_orientation(mesh);
  }
  mesh = mesh::converted(mesh, source.convert);
  if (!source.file.empty() && source.refine > 1)
    mesh = mesh::refined(mesh, source.refine);
  return mesh::with_groups(std::move(mesh), source.groups);
}

/// Explicit steps solve for no multipliers of contact: ties are relations there.
bool ties_are_relations(const Model& model) {
  return study::is_explicit(model.study.time.scheme) &&
         std::ranges::any_of(model.zones, [](const auto& zone) { return zone.settings.tie; });
}

/// Makes the reduction, with the ties of zones that there are where they are relations; returns notes.
std::vector<std::string> set_reduction(Model& model, const Stage& stage, std::vector<Fault>& faults) {
  std::vector<std::string> notes;
  const auto ties = ties_are_relations(model) ? std::span<const contact::Zone>(model.zones)
                                              : std::span<const contact::Zone>();
  model.reduction = make_reduction(model.study, model.mesh, model.dofs, model.references, faults, notes,
                                   model.preloads, stage, ties);
  return notes;
}

/// Everything but the matrices, on a mesh that is cut already.
Model lay_out(const study::Study& asked, mesh::Mesh mesh, std::vector<PreloadedCut> preloads,
              const Stage& stage) {
  Model model;
  model.study = asked;
  note_releases(model);
  const auto& study = model.study;
  model.mesh = std::move(mesh);
  model.preloads = std::move(preloads);
  if (study.physics == study::Physics::axisymmetric)
    mesh::snap_to_axis(model.mesh);
  std::vector<Fault> faults;
  read_field_files(model.study, model.mesh, faults);
  stop_on(faults);
  model.bulk = make_bulk(study, model.mesh, faults);
  const auto known = faults.size();
  check_shapes(study, model.mesh, model.bulk.cells, faults);
  // What comes next integrates over cells.
  if (model.bulk.cells.empty() || faults.size() > known)
    stop_on(faults);
  check_law_fields(study, model.mesh, model.bulk, faults);
  check_formulations(study, model.mesh, model.bulk, faults);
  if (faults.size() > known)
    stop_on(faults);
  auto numbered = rigid_faces(study, model.mesh);
  numbered.insert(numbered.end(), model.bulk.cells.begin(), model.bulk.cells.end());
  model.dofs = domain::number_dofs(model.mesh, numbered, element::component_count(study.physics));
  add_nodes(lone_nodes(study, model.mesh, model.dofs), model.dofs);
  model.references = make_references(study, model.mesh, model.dofs, faults);
  auto notes_on_relations = set_reduction(model, stage, faults);
  model.heat = make_heat(study, model.mesh, model.dofs, model.bulk, faults);
  model.springs = make_springs(study, model.mesh, model.dofs, faults);
  model.connectors = make_connectors(study, model.mesh, model.dofs, model.references, faults);
  model.point_masses = make_point_masses(study, model.mesh, model.dofs, model.references, faults);
  model.forces = make_forces(study, model.mesh, model.dofs, model.bulk, model.references, faults);
  model.followers = make_followers(study, model.mesh, model.dofs, model.bulk, faults);
  add_preload_forces(model, stage);
  if (study.time.arc_length)
    model.arc_nodes = make_arc_nodes(study, model.mesh, model.dofs, faults);
  model.zones = make_zones(study, model.mesh, model.bulk, model.dofs, model.reduction, faults);
  carry_obstacles(model);
  if (ties_are_relations(model) && faults.empty())
    notes_on_relations = set_reduction(model, stage, faults);
  std::ranges::move(notes_on_relations, std::back_inserter(model.notes));
  if (std::isinf(stage.released)) // later ones go on from what is
    model.initial = make_initial_motion(study, model.mesh, model.dofs, model.reduction, faults);
  model.probe_nodes = make_probe_nodes(study, model.mesh, model.dofs, model.references, faults, model.notes);
  model.probe_cells = make_probe_cells(study, model.mesh, model.bulk, faults, model.notes);
  model.probe_cuts =
      make_probe_cuts(study, model.mesh, model.dofs, model.bulk, model.heat.get(), faults, model.preloads);
  check_probed_zones(model, faults);
  check_compared_places(study, model.mesh, faults);
  stop_on(faults);
  model.shared_nodes = contact::points_of_shared_nodes(model.zones);
  if (const auto note = note_on_shared_nodes(model))
    model.notes.push_back(*note);
  std::ranges::move(notes_on_rigid_slaves(model), std::back_inserter(model.notes));
  std::ranges::move(notes_on_coarse_slaves(model), std::back_inserter(model.notes));
  std::ranges::move(notes_on_tied_gaps(model), std::back_inserter(model.notes));
  auto cells = examine_formulations(model);
  std::ranges::move(cells.notes, std::back_inserter(model.notes));
  model.locking_materials = cells.locking;
  model.slenderness = cells.slenderness;
  if (study.time.scheme == study::SchemeKind::static_steps) {
    mark_soft_springs(model);
    model.gauges = make_gauges(model, model.notes);
    check_supported(model, faults);
    model.free_body_nodes = free_body_nodes(model);
  } else {
    check_masses(model, faults);
    check_point_masses(model, faults);
    check_lone_masses(model, faults);
    check_massless_slaves(model, faults);
  }
  stop_on(faults);
  std::ranges::move(notes_on_large_contact(model), std::back_inserter(model.notes));
  number_unknowns(model);
  return model;
}

/// Contact goes on from one stage to the next: both have the same points.
void check_same_zones(const Model& first, const Model& stage, std::vector<Fault>& faults) {
  for (std::size_t z = 0; z < first.zones.size(); ++z) {
    const auto& before = first.zones[z];
    const auto& after = stage.zones.at(z);
    if (before.slave.nodes != after.slave.nodes || before.points.size() != after.points.size() ||
        before.multiplier_count() != after.multiplier_count())
      faults.push_back(
          fault_at("contact." + before.settings.name,
                   "another surface becomes the slave; expected 'master' and 'slave' in the deck"));
  }
}

/// What is wrong once supports have ended.
void check_stage(const Model& first, double release) {
  std::vector<Fault> faults;
  try {
    check_same_zones(first, lay_out(first.study, first.mesh, first.preloads, {.released = release}), faults);
  } catch (const InputError& error) {
    faults = error.faults();
  }
  for (auto& fault : faults)
    fault.text += fmt::format(" (from t = {} on, where a support ends or a preload is locked)", release);
  stop_on(faults);
}

Model lay_out(const study::Study& study, mesh::Mesh mesh) {
  study::validate(study);
  std::vector<Fault> faults;
  auto preloads = split_at_preloads(study, mesh, faults);
  stop_on(faults);
  auto model = lay_out(study, std::move(mesh), std::move(preloads), Stage{});
  for (const double release : model.releases)
    check_stage(model, release);
  return model;
}

Model assembled(Model model, const Workers& workers) {
  std::tie(model.threads, model.ranks) = std::tie(workers.threads, workers.ranks);
  assemble_matrices(model);
  move_ground(model);
  add_base_inertia(model);
  return model;
}

} // namespace

mesh::Mesh load_mesh(const study::MeshSource& source) {
  try {
    return source_mesh(source);
  } catch (const InputError& error) {
    auto faults = error.faults();
    for (auto& fault : faults)
      if (to_string(fault.at).empty() && fault.path.empty())
        fault.path = source.file.empty() ? "mesh.generate" : "mesh.file";
    throw InputError(std::move(faults));
  }
}

std::vector<std::vector<Fault>> faults_of(std::span<const study::Study> studies) {
  std::vector<std::vector<Fault>> faults(studies.size());
  std::optional<mesh::Mesh> mesh;
  const study::MeshSource* source = nullptr;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    try {
      if (source == nullptr || *source != studies[i].mesh) {
        mesh = load_mesh(studies[i].mesh);
        source = &studies[i].mesh;
      }
      lay_out(studies[i], *mesh);
    } catch (const InputError& error) {
      faults[i] = error.faults();
    }
  }
  return faults;
}

Model build_model(const study::Study& study, mesh::Mesh mesh, const Workers& workers) {
  return assembled(lay_out(study, std::move(mesh)), workers);
}

Model build_model(const study::Study& study, const Workers& workers) {
  return build_model(study, load_mesh(study.mesh), workers);
}

Model build_stage(const Model& first, double release, const VectorXd& shortening) {
  return assembled(lay_out(first.study, first.mesh, first.preloads, {release, shortening}), first.workers());
}

namespace {

void add_force(const Force& part, double t, VectorXd& force) {
  linalg::add_scaled(value_of(part.function, t), part.pattern, force);
  for (const auto& field : part.fields)
    load::add_field_force(field, t, force);
}

} // namespace

VectorXd external_force(const Model& model, double t, double load_factor) {
  VectorXd force = VectorXd::Zero(model.dofs.dof_count);
  for (const auto& part : model.forces)
    if (!part.is_controlled)
      add_force(part, t, force);
  if (model.study.time.arc_length) {
    VectorXd controlled = VectorXd::Zero(force.size());
    for (const auto& part : model.forces)
      if (part.is_controlled)
        add_force(part, t, controlled);
    linalg::add_scaled(load_factor, controlled, force);
  }
  for (const auto& pull : model.ground) {
    linalg::add_scaled(pull.at(t), pull.stiffness, force);
    if (pull.damping.size() > 0)
      linalg::add_scaled(pull.rate(t), pull.damping, force);
  }
  return force;
}

void add_follower_forces(const Model& model, double t, const VectorXd& u, VectorXd& force,
                         double load_factor) {
  VectorXd controlled;
  for (const auto& follower : model.followers) {
    if (!follower.is_controlled) {
      load::add_follower_force(follower, u, t, force);
      continue;
    }
    controlled.setZero(force.size());
    load::add_follower_force(follower, u, t, controlled);
    linalg::add_scaled(load_factor, controlled, force);
  }
}

void add_follower_tangent(const Model& model, double t, const VectorXd& u, double factor,
                          SparseMatrix& matrix, double load_factor) {
  for (const auto& follower : model.parts ? model.own_followers : model.followers)
    load::add_follower_tangent(follower, u, t, (follower.is_controlled ? load_factor : 1) * factor, matrix);
}

VectorXd controlled_force(const Model& model, double t, const VectorXd& u) {
  VectorXd force = VectorXd::Zero(model.dofs.dof_count);
  for (const auto& part : model.forces)
    if (part.is_controlled)
      add_force(part, t, force);
  for (const auto& follower : model.followers)
    if (follower.is_controlled)
      load::add_follower_force(follower, u, t, force);
  return force;
}

bool is_damped(const Model& model) {
  return model.has_damping || !model.modal_damping.empty() || !model.dampers.empty() ||
         domain::has_dashpots(model.domain.line_springs());
}

VectorXd damping_force(const Model& model, const VectorXd& u, const VectorXd& v) {
  VectorXd force =
      model.has_damping ? linalg::product_of(model.damping, v, model.sharing()) : VectorXd::Zero(v.size());
  if (!model.modal_damping.empty())
    linalg::add_scaled(1, model.modal_damping.force(v), force);
  domain::add_beyond_matrix(model.dampers, v, force);
  domain::add_line_damping(model.domain.line_springs(), u, v, force);
  return force;
}

std::string node_label(const mesh::Mesh& mesh, mesh::NodeIndex node) {
  const auto& x = mesh.points[static_cast<std::size_t>(node)];
  const auto name = mesh::node_name(mesh, node);
  return mesh.dimension == 2 ? fmt::format("{} ({:.6g}, {:.6g})", name, x[0], x[1])
                             : fmt::format("{} ({:.6g}, {:.6g}, {:.6g})", name, x[0], x[1], x[2]);
}

} // namespace rubato::model
