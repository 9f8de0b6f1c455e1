// SPDX-License-Identifier: LGPL-3.0-or-later
// What tightens bolts, and where their shortening is kept.
#include "rubato/model/build.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>

namespace rubato::model {
namespace {

/// −n·(u_t − u_o) of the first pair, as a row over the dofs, times a factor.
Eigen::VectorXd shortening_row(const PreloadedCut& cut, const domain::DofMap& dofs, double factor = 1) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(dofs.dof_count);
  const auto& pair = cut.pairs.front();
  for (int i = 0; i < dofs.components; ++i) {
    row[dofs.dof(pair.in_front, i)] = -factor * cut.normal[i];
    row[dofs.dof(pair.behind, i)] = factor * cut.normal[i];
  }
  return row;
}

/// A preload that the deck locks before the begin is locked at the begin.
double lock_of(const study::Preload& preload, const study::TimeStepping& time) {
  return std::max(*preload.lock, time.begin);
}

} // namespace

bool is_locked(const study::Preload& preload, const Stage& stage) {
  return preload.lock && *preload.lock <= stage.released;
}

void add_preload_forces(Model& model, const Stage& stage) {
  for (std::size_t i = 0; i < model.preloads.size(); ++i) {
    const auto& preload = model.study.preload[i];
    if (!preload.by_force || is_locked(preload, stage))
      continue;
    model.forces.push_back({shortening_row(model.preloads[i], model.dofs, preload.value.value),
                            function_named(model.study, preload.value.function),
                            {}});
  }
}

void lock_preloads(const Model& first, double release, const Eigen::VectorXd& u,
                   Eigen::VectorXd& shortening) {
  for (std::size_t i = 0; i < first.preloads.size(); ++i) {
    const auto& preload = first.study.preload[i];
    if (preload.lock && lock_of(preload, first.study.time) == release)
      shortening[static_cast<Eigen::Index>(i)] = shortening_row(first.preloads[i], first.dofs).dot(u);
  }
}

} // namespace rubato::model
