// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/model_parts.hpp"

#include "rubato/contact/shared_nodes.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/model/model.hpp"

namespace rubato::test {

ModelParts::ModelParts(const model::Model& model)
    : whole(model), study(model.study), mesh(model.mesh), bulk(model.bulk), dofs(model.dofs),
      domain(model.domain), mass(model.mass), damping(model.damping), lumped_mass(model.lumped_mass),
      reduction(model.reduction), zones(model.zones), shared_nodes(model.shared_nodes),
      preloads(model.preloads), probe_cuts(model.probe_cuts), massless_nodes(model.massless_nodes),
      free_body_nodes(model.free_body_nodes), notes(model.notes) {}

mesh::NodeIndex ModelParts::node_of(int dof) const {
  return whole.node_of(dof);
}

} // namespace rubato::test
