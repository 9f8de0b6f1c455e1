// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact points of a model as the contact predictor sees them.
#pragma once

#include "rubato/step/common/contact_evaluator.hpp"
#include "rubato/step/interface/contact_predictor.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::step {

/// Every point that may touch, in the frame where `contact` measured it with the surface at d = `moved`, with
/// its force of the last step, from the outcomes in `state`.
void take_points(const model::Model& model, const ContactEvaluator& side, const Frozen& frozen,
                 const Compliance& compliance, const ContactIterate& contact, const Eigen::VectorXd& moved,
                 const State& state, std::vector<PredictorPoint>& points);

using PointsOfZones = std::vector<std::vector<std::size_t>>;

/// Those of each zone that have a force, or with the surface at d penetrate or have lost half of the gap that
/// they were measured with. Others are open without doubt and may keep their frames.
void find_touching(std::span<const PredictorPoint> points, const Eigen::VectorXd& d, PointsOfZones& touching);

/// Takes these to the frames where `contact` measured them anew, and their springs to their forces. Points
/// that have nothing to touch any more lose their forces.
void move_frames(const model::Model& model, const ContactEvaluator& side, const Frozen& frozen,
                 const Compliance& compliance, const ContactIterate& contact, const Eigen::VectorXd& moved,
                 const PointsOfZones& touching, std::span<PredictorPoint> points);

/// What their forces put on the surface, internal side, one an interface dof [force].
Eigen::VectorXd force_on_surface(std::span<const PredictorPoint> points, Eigen::Index interface_dofs);

/// Whether contact is by a method whose normal problem the prediction solves to its end, in every round of
/// loops: all zones then have it.
bool prediction_is_exact(const model::Model& model);

/// Whether an attempt that starts so guesses its contact first.
bool starts_from_prediction(const model::Model& model, Start start);

/// Statuses and multipliers that belong to the predicted forces.
void take_prediction(const model::Model& model, std::span<const PredictorPoint> points, State& state);

} // namespace rubato::step
