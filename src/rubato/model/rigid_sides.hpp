// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact surfaces that relations make rigid.
#pragma once

#include "rubato/constraint/reduction.hpp"
#include "rubato/core/error.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/model/fwd.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::model {

/// Whether no more unknowns move the nodes than rigid motions have, although relations concern them.
bool is_rigid(std::span<const mesh::NodeIndex> nodes, const domain::DofMap& dofs,
              const constraint::Reduction& reduction);

/// A sentence for each zone whose slave is rigid while its master deforms: where the slave's faces are the
/// finer ones its points have more pressures than the master can tell apart.
std::vector<std::string> notes_on_rigid_slaves(const Model& model);

/// A fault for each zone whose slave is to have no mass, but moves by a relation with what has: contact
/// forces would act against that mass as if there were none, and reflect what meets, friction included.
void check_massless_slaves(const Model& model, std::vector<Fault>& faults);

} // namespace rubato::model
