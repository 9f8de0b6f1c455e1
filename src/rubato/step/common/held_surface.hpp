// SPDX-License-Identifier: LGPL-3.0-or-later
/// Springs where contact holds a surface. A tangent of bodies that contact alone keeps from buckling or from
/// rolling away is not positive definite; with these springs in it, it is, and serves as the matrix of
/// iterations. They act on corrections alone and leave no force: where contact does hold, nothing moves
/// against them, and iterations converge as without them.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/common/bulk_tangent.hpp"
#include "rubato/step/common/contact_evaluator.hpp"

#include <vector>

namespace rubato::step {

/// Along the normal of points that slip, in every direction of points that stick, or of all that touch; of
/// the nodes of both sides. Each as stiff as `diagonal`, an entry a dof, at its node, less where the node has
/// little of the point.
std::vector<NodeSpring> springs_of_contact(const model::Model& model, const ContactIterate& contact,
                                           const Eigen::VectorXd& diagonal, Held held);

} // namespace rubato::step
