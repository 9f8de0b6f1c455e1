// SPDX-License-Identifier: LGPL-3.0-or-later
/// The fields of a state at the mesh's nodes, and the resultants of contact.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/field.hpp"
#include "rubato/step/state.hpp"
#include "rubato/study/outputs.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace rubato::results {

/// A field that owns its values.
struct OwnedField {
  std::string name;
  int components = 1;
  std::vector<double> values; ///< node-major
  std::vector<std::string> component_names;
  NodalField view() const { return {name, components, values, component_names, ""}; }
};

/// At the nodes: displacement, velocity, acceleration; stress (averaged at the nodes) and von_mises; where a
/// material flows, cumulated_plastic_strain; with contact also contact_pressure (≥ 0; of ties and bilateral
/// zones < 0 where it pulls), contact_gap (> 0 open; 0 where nothing faces the node), contact_slip (along the
/// master's first and second tangent, of the last step), contact_status (0 open, 1 sticking, 2 slipping),
/// contact_cumulated_slip and contact_friction_work (since the run began; of several points on a node the
/// largest slip and the sum of the works). Nodes off the slave surfaces carry 0. Those of them that `output`
/// writes, and of the following those that it names: strain and plastic_strain (as tensors, averaged at the
/// nodes), tresca, mean_stress, principal_stress, forces.
std::vector<OwnedField> nodal_fields(const model::Model& model, const step::State& now,
                                     const study::FieldOutput& output = {});
/// Parts of these: stress and von_mises; tresca, mean_stress and principal_stress of a field of stresses;
/// strain; plastic_strain; cumulated_plastic_strain.
std::vector<OwnedField> stress_fields(const model::Model& model, const step::State& now);
std::vector<OwnedField> other_stress_fields(const OwnedField& stress);
OwnedField strain_field(const model::Model& model, const step::State& now);
OwnedField plastic_strain_field(const model::Model& model, const step::State& now);
OwnedField cumulated_plastic_strain_field(const model::Model& model, const step::State& now);

/// By which cells, springs and connectors resist, one a dof [force]: what external forces, inertia, damping,
/// contact and supports balance.
Eigen::VectorXd internal_force(const model::Model& model, const step::State& now);

/// Of contact on the nodes, one a dof [force].
Eigen::VectorXd contact_force(const model::Model& model, const step::State& now);

/// Of a model with temperatures.
OwnedField temperature_field(const model::Model& model, double t);
std::vector<OwnedField> contact_fields(const model::Model& model, const step::State& now);

} // namespace rubato::results
