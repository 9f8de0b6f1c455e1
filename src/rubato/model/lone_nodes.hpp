// SPDX-License-Identifier: LGPL-3.0-or-later
/// Nodes without cells that have displacements of their own: points that equations, connectors and masses
/// name.
#pragma once

#include "rubato/domain/dof_map.hpp"
#include "rubato/model/fwd.hpp"

#include <vector>

namespace rubato {
struct Fault;
} // namespace rubato
namespace rubato::study {
struct Study;
} // namespace rubato::study

namespace rubato::model {

/// Nodes without unknowns that an equation, a connector or a mass names alone, ascending.
std::vector<mesh::NodeIndex> lone_nodes(const study::Study& study, const mesh::Mesh& mesh,
                                        const domain::DofMap& dofs);
/// Gives them unknowns, in the order of the mesh.
void add_nodes(std::span<const mesh::NodeIndex> nodes, domain::DofMap& dofs);

/// Returns the nodes of the model that belong neither to a body nor to a rigid surface.
std::vector<mesh::NodeIndex> lone_nodes_of(const Model& model);

/// Faults of lone nodes that can move and have no mass: their accelerations are not determined.
void check_lone_masses(const Model& model, std::vector<Fault>& faults);

} // namespace rubato::model
