// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/domain/linear_domain.hpp"
#include "rubato/domain/nonlinear_cells.hpp"
#include "rubato/domain/nonlinear_domain.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/linalg/sparse_sum.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/contact_mass.hpp"
#include "rubato/model/gauges.hpp"
#include "rubato/model/mass_scaling.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/own_cells.hpp"
#include "rubato/study/damping.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rubato::model {
namespace {

using Eigen::VectorXd;

/// One side without mass is enough for pressures to be continuous: the slave's.
void free_contact_of_mass(Model& model) {
  auto surfaces = massless_surfaces(model.mesh, model.bulk, model.dofs, model.reduction, model.zones,
                                    linalg::whole_of(model.mass, model.sharing()));
  std::ranges::move(surfaces.notes, std::back_inserter(model.notes));
  model.massless_nodes = std::move(surfaces.nodes);
  if (model.massless_nodes.empty())
    return;
  take_mass_off(surfaces.extrapolation, model.mass);
  model.products.extrapolate(std::move(surfaces.extrapolation));
}

/// Without a copy, which Eigen makes on assignment.
void take(SparseMatrix& to, SparseMatrix&& from) {
  to.swap(from);
}

SparseMatrix diagonal_matrix(const VectorXd& diagonal) {
  SparseMatrix matrix(diagonal.size(), diagonal.size());
  matrix.resizeNonZeros(diagonal.size());
  std::copy(diagonal.begin(), diagonal.end(), matrix.valuePtr());
  std::iota(matrix.innerIndexPtr(), matrix.innerIndexPtr() + diagonal.size(), 0);
  std::iota(matrix.outerIndexPtr(), matrix.outerIndexPtr() + diagonal.size() + 1, 0);
  return matrix;
}

void add_springs(const Model& model, SparseMatrix& stiffness) {
  for (const auto& spring : model.springs)
    if (model.counts(spring.dof))
      stiffness.coeffRef(spring.dof, spring.dof) += spring.stiffness;
  if (model.sharing().is_first())
    add_connectors(model, stiffness);
  add_gauges(model, stiffness);
}

/// The stiffness of nonlinear bodies is not assembled.
domain::Domain make_explicit_domain(const Model& model, std::span<const double> mass_factors) {
  const auto& bulk = model.bulk;
  const auto own = own_cells(model);
  const domain::BlockPattern pattern(model.mesh, own.constant, model.dofs, model.threads);
  auto constant = domain::assemble_constant_stiffness(model.mesh, bulk, pattern);
  VectorXd springs = VectorXd::Zero(constant.rows());
  for (const auto& spring : model.springs)
    springs[spring.dof] += spring.stiffness;
  if (!model.springs.empty())
    linalg::add_scaled(1, diagonal_matrix(springs), constant);
  add_connectors(model, constant);
  const auto cells =
      std::make_shared<domain::NonlinearCells>(model.mesh, bulk, model.dofs, own.nonlinear, model.threads);
  cells->find_rates(model.mesh, bulk, mass_factors);
  return {domain::NonlinearDomain(std::move(constant), std::nullopt, cells, model.dofs.components, model.heat,
                                  law_springs(model), model.threads, line_springs(model)),
          domain::initial_states(model.mesh, bulk)};
}

void add_to_damping(const VectorXd& diagonal, Model& model) {
  if (model.damping.nonZeros() > 0)
    linalg::add_scaled(1, diagonal_matrix(diagonal), model.damping);
  else
    take(model.damping, diagonal_matrix(diagonal));
}

/// `workers`: those whose parts it puts together.
domain::Domain make_domain(const Model& model, const domain::BlockPattern& pattern, const Workers& workers) {
  auto stiffness = domain::assemble_stiffness(model.mesh, model.bulk, pattern);
  add_springs(model, stiffness);
  auto states = domain::initial_states(model.mesh, model.bulk);
  const int components = model.dofs.components;
  auto lines = line_springs(model);
  if (domain::is_linear(model.bulk) && lines.empty())
    return {domain::LinearDomain(std::move(stiffness), components, model.heat, law_springs(model), workers),
            std::move(states)};
  auto constant = domain::assemble_constant_stiffness(model.mesh, model.bulk, pattern);
  add_springs(model, constant);
  if (model.sharing().is_first()) {
    add_lines(lines, 1, stiffness);
    add_lines(lines, 0, constant);
  }
  const auto cells = std::make_shared<domain::NonlinearCells>(model.mesh, model.bulk, model.dofs,
                                                              own_cells(model).nonlinear, model.threads);
  cells->find_places(constant);
  return {domain::NonlinearDomain(std::move(constant), std::move(stiffness), cells, components, model.heat,
                                  law_springs(model), workers, std::move(lines)),
          std::move(states)};
}

void add_point_masses(Model& model) {
  for (const auto& [node, mass] : model.point_masses)
    for (int i = 0; i < model.dofs.components; ++i) {
      const int dof = model.dofs.dof(node, i);
      if (model.lumped_mass.size() > 0)
        model.lumped_mass[dof] += mass;
      else if (model.counts(dof))
        model.mass.coeffRef(dof, dof) += mass;
    }
}

void add_masses_of_references(Model& model) {
  if (model.sharing().is_first())
    add_reference_masses(model, model.mass);
}

/// Rayleigh's coefficients, one a material.
struct Rayleigh {
  std::vector<double> stiffness;
  std::vector<double> mass;

  static bool any(const std::vector<double>& factors) {
    return std::ranges::any_of(factors, [](double factor) { return factor != 0; });
  }
};

Rayleigh rayleigh_of(const std::vector<study::Material>& materials) {
  Rayleigh rayleigh;
  for (const auto& material : materials) {
    const auto [stiffness, mass] = study::rayleigh_coefficients(material);
    rayleigh.stiffness.push_back(stiffness);
    rayleigh.mass.push_back(mass);
  }
  return rayleigh;
}

void assemble_implicit(Model& model) {
  const auto& bulk = model.bulk;
  model.parts = implicit_parts(model);
  model.own_followers = own_followers(model);
  const domain::BlockPattern pattern(model.mesh, own_cells(model).all, model.dofs, model.threads);
  model.domain = make_domain(model, pattern, {model.threads, model.sharing()});
  if (model.study.time.scheme == study::SchemeKind::static_steps)
    return;
  take(model.mass, domain::assemble_mass(model.mesh, bulk, pattern));
  add_point_masses(model);
  model.products = Products(model.mass, model.dofs.components, attached_masses(model), model.sharing());
  if (model.study.time.contact_mass == study::ContactMass::redistributed)
    free_contact_of_mass(model);
  add_masses_of_references(model);
  const auto rayleigh = rayleigh_of(model.study.materials);
  if (!Rayleigh::any(rayleigh.stiffness) && !Rayleigh::any(rayleigh.mass))
    return;
  take(model.damping, domain::assemble_stiffness(model.mesh, bulk, pattern, rayleigh.stiffness));
  linalg::add_scaled(1, domain::assemble_mass(model.mesh, bulk, pattern, rayleigh.mass), model.damping);
}

/// Only what the steps multiply with: of nonlinear bodies no stiffness, of damping by the mass a diagonal.
void assemble_explicit(Model& model) {
  const auto& bulk = model.bulk;
  const auto rayleigh = rayleigh_of(model.study.materials);
  const bool linear =
      domain::is_linear(bulk) && std::ranges::none_of(model.study.connectors, &study::Connector::rotates);
  const bool by_stiffness = Rayleigh::any(rayleigh.stiffness);
  std::optional<domain::BlockPattern> pattern;
  model.parts = explicit_parts(model);
  if (linear || by_stiffness)
    pattern.emplace(model.mesh, own_cells(model).all, model.dofs, model.threads);
  const auto scaling = model.study.time.mass_scaling ? scaled_masses(model) : MassScaling{};
  model.domain =
      linear ? make_domain(model, *pattern, model.threads) : make_explicit_domain(model, scaling.factors);
  model.lumped_mass = domain::lumped_mass(model.mesh, bulk, model.dofs);
  if (model.study.time.mass_scaling) {
    for (Eigen::Index i = 0; i < scaling.added.size(); ++i)
      model.lumped_mass[i] += scaling.added[i];
    model.notes.push_back(described(scaling, model.study.time));
    model.added_mass = scaling.added_mass / scaling.mass;
  }
  add_point_masses(model);
  if (by_stiffness)
    take(model.damping, domain::assemble_stiffness(model.mesh, bulk, *pattern, rayleigh.stiffness));
  if (Rayleigh::any(rayleigh.mass))
    add_to_damping(counted_once(model, domain::lumped_mass(model.mesh, bulk, model.dofs, rayleigh.mass)),
                   model);
}

} // namespace

void assemble_matrices(Model& model) {
  if (study::is_explicit(model.study.time.scheme))
    assemble_explicit(model);
  else
    assemble_implicit(model);
  if (model.study.time.scheme == study::SchemeKind::static_steps)
    return;
  if (model.sharing().is_first())
    add_dashpots(model, model.damping);
  model.has_damping = !model.sharing().all(model.damping.nonZeros() == 0);
  if (model.has_damping)
    model.damping.conservativeResize(model.dofs.dof_count, model.dofs.dof_count);
  model.dampers = law_dampers(model);
  model.modal_damping = make_modal_damping(model);
}

} // namespace rubato::model
