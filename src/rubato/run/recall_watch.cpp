// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/recall_watch.hpp"

#include "rubato/domain/bulk.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::run {
namespace {

/// Of γ Δp in a step.
constexpr double most = 0.1;

double largest_recall(const study::Study& study) {
  double recall = 0;
  if (study::is_explicit(study.time.scheme))
    return recall;
  for (const auto& material : study.materials)
    if (material.law == study::LawKind::plastic)
      for (const auto& stress : material.plasticity.kinematic)
        recall = std::max(recall, stress.recall);
  return recall;
}

} // namespace

RecallWatch::RecallWatch(const model::Model& model, const Watch& watch)
    : model_(model), watch_(watch), recall_(largest_recall(model.study)) {}

void RecallWatch::note(const step::State& before, const step::State& now) {
  if (recall_ == 0)
    return;
  const auto found = model_.domain.plastic_step(before.bulk_points, now.bulk_points);
  if (recall_ * found.growth <= most)
    return;
  watch_.warn(fmt::format("{}: in the step from t = {:g} to {:g} plastic strain grows by {:.2g} in {}, too "
                          "much for back stresses that recall {:g}: their stress is some percent off; "
                          "expected time.max_plastic_step: {:.2g}, or shorter steps",
                          model_.study.name, before.t, now.t, found.growth,
                          domain::cell_label(model_.mesh, found.cell), recall_, most / recall_));
  recall_ = 0;
}

} // namespace rubato::run
