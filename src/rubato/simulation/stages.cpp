// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/simulation/stages.hpp"

#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::simulation {
namespace {

/// Steps may end at a neighbour of the release that differs by rounding.
double nearest(std::span<const double> instants, double release) {
  return *std::ranges::min_element(instants, {}, [&](double t) { return std::abs(t - release); });
}

} // namespace

Stages::Stages(const model::Model& first, std::span<const double> instants) : first_(&first) {
  for (const double release : first.releases)
    ends_.push_back(nearest(instants, release));
}

std::size_t Stages::stage_ending_at(double t) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(ends_, t) - ends_.begin());
}

bool Stages::go_to_begin_at(double t, const Eigen::VectorXd& shortening) {
  return go_to(static_cast<std::size_t>(std::ranges::upper_bound(ends_, t) - ends_.begin()), shortening);
}

void Stages::lock_preloads_at(double t, const Eigen::VectorXd& u, Eigen::VectorXd& shortening) const {
  for (std::size_t i = 0; i < ends_.size(); ++i)
    if (ends_[i] == t)
      model::lock_preloads(*first_, first_->releases[i], u, shortening);
}

bool Stages::go_to(std::size_t stage, const Eigen::VectorXd& shortening) {
  if (stage == stage_)
    return false;
  later_ = stage == 0 ? nullptr
                      : std::make_unique<const model::Model>(
                            model::build_stage(*first_, first_->releases[stage - 1], shortening));
  stage_ = stage;
  return true;
}

} // namespace rubato::simulation
