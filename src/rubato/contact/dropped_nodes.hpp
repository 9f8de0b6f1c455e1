// SPDX-License-Identifier: LGPL-3.0-or-later
/// Results of mortar nodes without a dual function of their own. The master covers too little of them.
///
/// Receivers are the nodes that have their function. A dropped node reports means of its receivers; its force
/// and its area are 0.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/zone_state.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace rubato::contact {

/// Sets the pressures of such nodes in the outcomes of `state`, and `of_receivers`. The mean counts receivers
/// without contact as 0. A node is closed where a receiver is: it sticks where all closed receivers stick.
/// `status`: one a point.
void report_dropped_nodes(std::span<const PointEvaluation> points, std::span<const Status> status,
                          ZoneState& state);

/// The status and the tangential traction of a point as results have them. They agree with its pressure.
Status reported_status(const ZoneState& state, std::size_t point);
Eigen::Vector3d reported_traction(const ZoneState& state, std::size_t point);

} // namespace rubato::contact
