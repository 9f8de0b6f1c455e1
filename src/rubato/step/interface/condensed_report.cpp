// SPDX-License-Identifier: LGPL-3.0-or-later
// What a step on the points alone says at its end.
#include "rubato/model/model.hpp"
#include "rubato/step/interface/condensed.hpp"

namespace rubato::step {

using Eigen::VectorXd;

StepReport Condensed::ended(Outcome outcome, const Frozen& frozen) {
  report_.outcome = outcome;
  if (bulk_)
    bulk_->fill(report_, equilibrium_);
  if (report_.failed() && outcome != Outcome::indefinite) // nothing has been evaluated then
    name_failure(outcome, frozen);
  return report_;
}

void Condensed::name_failure(Outcome outcome, const Frozen& frozen) {
  report_.worst = equilibrium_.residual().allFinite() ? worst_on_surface() : equilibrium_.worst();
  if (outcome != Outcome::not_finite && outcome != Outcome::cell_failed)
    side_.name_unmet(frozen, report_.iterations > 0 ? &previous() : nullptr, now(), report_);
  name_residual_growth(report_);
}

std::vector<WorstNode> Condensed::worst_on_surface() const {
  std::vector<mesh::NodeIndex> nodes;
  for (const int dof : system_.compliance->dof_of_interface_dof())
    nodes.push_back(model_.node_of(dof));
  const VectorXd left = scheme_.contact_weight() * (force() - surface_.applied);
  return worst_nodes(left, nodes, surface_scale());
}

} // namespace rubato::step
