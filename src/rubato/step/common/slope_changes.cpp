// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/slope_changes.hpp"

#include "rubato/linalg/dense_lu.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/model/model.hpp"

#include <utility>

namespace rubato::step {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Connector;

namespace {

double along(const Connector& connector, const VectorXd& x) {
  double sum = 0;
  for (const auto& term : connector.row)
    sum += term.coefficient * x[term.dof];
  return sum;
}

} // namespace

double slope_change(const Connector& connector, const time::StepCoefficients& step,
                    const time::Motion& motion) {
  double change = 0;
  if (connector.force)
    change += step.stiffness * (slope_at(*connector.force, along(connector, motion.u)) - connector.stiffness);
  if (connector.damper)
    change += step.damping * (slope_at(*connector.damper, along(connector, motion.v)) - connector.damping);
  return change;
}

SlopeChanges::SlopeChanges(const model::Model& model, const Compliance& compliance,
                           const time::StepCoefficients& step)
    : model_(&model), step_(step) {
  for (std::size_t c = 0; c < model.connectors.size(); ++c)
    if (model.connectors[c].force || model.connectors[c].damper)
      places_.push_back(c);
  const auto count = static_cast<Index>(places_.size());
  rows_.resize(model.reduction.unknown_count(), count);
  answers_.resize(rows_.rows(), count);
  for (Index k = 0; k < count; ++k) {
    VectorXd row = VectorXd::Zero(model.dofs.dof_count);
    for (const auto& term : model.connectors[places_[static_cast<std::size_t>(k)]].row)
      row[term.dof] += term.coefficient;
    rows_.col(k) = model.reduction.gather(row);
    answers_.col(k) = compliance.solve(rows_.col(k));
  }
  between_ = linalg::transposed_product(rows_, answers_);
}

VectorXd SlopeChanges::adjusted(const VectorXd& residual, const time::Motion& motion) const {
  if (empty())
    return residual;
  const auto count = static_cast<Index>(places_.size());
  VectorXd changes(count);
  for (Index k = 0; k < count; ++k)
    changes[k] = slope_change(model_->connectors[places_[static_cast<std::size_t>(k)]], step_, motion);
  MatrixXd small = between_;
  VectorXd right = linalg::transposed_product(answers_, residual);
  for (Index j = 0; j < count; ++j) {
    for (Index i = 0; i < count; ++i)
      small(i, j) = (i == j ? 1 : 0) + changes[i] * small(i, j);
    right[j] *= changes[j];
  }
  const auto factors = linalg::DenseLu::of(std::move(small));
  if (!factors)
    return residual;
  const VectorXd y = factors->solve(std::move(right));
  return y.allFinite() ? VectorXd(residual - linalg::product(rows_, y)) : residual;
}

} // namespace rubato::step
