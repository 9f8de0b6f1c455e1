// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the blocks of a state in .frd files.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/ccx_contact.hpp"
#include "rubato/results/frd.hpp"
#include "rubato/results/nodal_fields.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::results {

/// DISP, VELO, NDTEMP, STRESS, TOSTRAIN, FORC, PE and CONTACT of the fields that are given. FORC is
/// balanced_force.
std::vector<FrdBlock> frd_blocks(const model::Model& model, const step::State& now,
                                 std::span<const OwnedField> fields, ContactLister& contact);

/// Forces by which cells, springs and contact resist, one a dof [force]: loads, reactions and inertia balance
/// them. CalculiX prints them as RF.
Eigen::VectorXd balanced_force(const model::Model& model, const step::State& now);

/// Settings of the .frd file of a run.
FrdSettings frd_settings(const model::Model& model);

} // namespace rubato::results
