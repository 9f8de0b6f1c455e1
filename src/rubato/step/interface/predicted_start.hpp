// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact of a step predicted before it is solved: which points will touch, stick and slip, and how
/// hard.
#pragma once

#include "rubato/step/common/contact_evaluator.hpp"
#include "rubato/step/common/reach.hpp"
#include "rubato/step/interface/predictor_points.hpp"
#include "rubato/step/interface/surface_motion.hpp"

#include <vector>

namespace rubato::step {

/// Buffers that predictions reuse.
struct PredictorScratch {
  ContactPredictor predictor;
  std::vector<PredictorPoint> points;
  PointsOfZones touching;

  /// The compliance must outlive this.
  PredictorScratch(Compliance& compliance, double force_weight, int components, NormalSolution how_far);
};

/// What a prediction works on.
struct PredictorSite {
  const model::Model& model;
  EffectiveSystem& system;
  ContactEvaluator& side;
  const Frozen& frozen;
  Equilibrium& equilibrium;
  Progress& progress;
};

/// Takes `trial` to statuses and multipliers of predicted forces and its surfaces, and those of `surface`, to
/// where these push them: contact in frames that follow the surface, until the forces fit the frames they
/// lead to, beginning where the forces of the last step would push it. Points that press in the end touch at
/// first, all others are open. With free bodies the base is where these come to rest. `now` is contact
/// there, of the points that are predicted. Nothing that comes of it counts when the progress has stopped.
void predict_contact(const PredictorSite& site, SurfaceMotion& surface, Reach& reach,
                     PredictorScratch& scratch, ContactIterate& now, State& trial);

} // namespace rubato::step
