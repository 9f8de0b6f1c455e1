// SPDX-License-Identifier: LGPL-3.0-or-later
/// What explicit runs carry from step to step.
#pragma once

#include "rubato/contact/explicit_memory.hpp"
#include "rubato/domain/law_path.hpp"
#include "rubato/domain/quadrature_states.hpp"
#include "rubato/step/energy_ledger.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace rubato::step {

/// What surveys have found of cells of finite strain.
struct ExplicitSurvey {
  double growth = 0; ///< of λ_K as Domain::growth gives it; 0: not found yet
  int interval = 20; ///< steps to the next one
  int made = 0;      ///< steps since this one
};

/// All that ExplicitMotion carries from step to step: whoever goes back to it does the same steps again, to
/// the last bit.
struct ExplicitMemory {
  double t = 0;
  double step = 0;
  std::int64_t steps = 0;
  Eigen::VectorXd u, v, residual_force, contact_force, damping_force;
  std::vector<double> load_factors, load_displacements; ///< one a load
  std::vector<double> reactions;                        ///< one a support that moves, one a dependent dof
  std::vector<contact::ExplicitZoneMemory> zones;
  EnergyLedger energy;
  domain::QuadratureStates bulk_points;
  domain::LawPath path;
  ExplicitSurvey survey;
};

} // namespace rubato::step
