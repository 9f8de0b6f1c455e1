// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/massless_motion.hpp"

#include "rubato/model/model.hpp"

namespace rubato::step {

State with_massless_motion(const model::Model& model, const State& before, State now) {
  const auto nearby = model.products.nearby(now.motion.a);
  for (const auto node : model.massless_nodes)
    for (int i = 0; i < model.dofs.components; ++i) {
      const int dof = model.dofs.dof(node, i);
      now.motion.v[dof] = (now.motion.u[dof] - before.motion.u[dof]) / (now.t - before.t);
      now.motion.a[dof] = nearby[dof];
    }
  return now;
}

} // namespace rubato::step
