// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/watches.hpp"

#include "rubato/model/mass_scaling.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace rubato::run {
namespace {

using results::Plausibility;

/// Instants of a run at which sums over all nodes are taken: they would cost too much in every step.
constexpr double samples = 20;
/// Parts that are longer, in thicknesses, bend too stiffly with few layers of linear cells.
constexpr double slender_limit = 5;
/// Of the mass of the bodies.
constexpr double added_mass_limit = 0.05;

void append(std::vector<Plausibility>& all, const std::vector<Plausibility>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

Plausibility added_mass(const model::Model& model) {
  const auto scaling = model::scaled_masses(model);
  return {"added_mass",
          scaling.added_mass / scaling.mass,
          added_mass_limit,
          model.study.time.begin,
          "",
          "mass_scaling adds this part of the mass of the bodies; expected a shorter 'mass_scaling.step'"};
}

/// Of cells that notes have told of before the first step.
std::vector<Plausibility> told_cells(const model::Model& model) {
  return {{"locking_materials", static_cast<double>(model.locking_materials), 0, model.study.time.begin, "",
           "", true},
          {"slender_parts", model.slenderness, slender_limit, model.study.time.begin, "", "", true}};
}

} // namespace

Watches::Watches(const model::Model& model, const Watch& watch, const step::EnergyRecord& record,
                 std::vector<Plausibility> former)
    : model_(model), watch_(watch), former_(std::move(former)), energy_(model.study.name, watch, record),
      overlaps_(model, watch), recall_(model, watch), turns_(model, watch), strains_(model, watch),
      springs_(model, watch), balance_(model), work_(model), pressures_(model), waves_(model) {
  results::keep_larger(former_, told_cells(model));
  if (model.study.time.mass_scaling)
    results::keep_larger(former_, std::vector{added_mass(model)});
}

/// The first step into each twentieth of the run, and the last.
bool Watches::is_sampled(double before, double now, bool last) const {
  const auto& time = model_.study.time;
  const double part = (time.end - time.begin) / samples;
  return last || std::floor((now - time.begin) / part) > std::floor((before - time.begin) / part);
}

void Watches::note(const step::State& before, const step::State& now, const step::State& told,
                   const step::EnergyLedger& ledger, bool last) {
  overlaps_.note(before, now);
  recall_.note(before, now);
  turns_.note(now);
  springs_.note(now, ledger);
  if (!model_.ranks.is_first())
    return;
  strains_.note(told.t, told.motion.u);
  work_.note(before, told, ledger);
  pressures_.note(before, told, ledger);
  waves_.note(before, told);
  if (!is_sampled(before.t, now.t, last))
    return;
  balance_.note(before, told);
  pressures_.note_pressures(told);
}

void Watches::note_energy(double t, const step::EnergyLedger& ledger) {
  energy_.note(t, ledger, work_.giver());
}

std::vector<Plausibility> Watches::checks() const {
  std::vector<Plausibility> now;
  append(now, energy_.checks());
  append(now, springs_.checks());
  append(now, turns_.checks());
  append(now, strains_.checks());
  append(now, balance_.checks());
  append(now, work_.checks());
  append(now, pressures_.checks());
  append(now, waves_.checks(energy_.record().largest));
  auto all = former_;
  results::keep_larger(all, now);
  return all;
}

std::vector<Plausibility> Watches::tell() {
  energy_.tell();
  springs_.tell();
  auto all = checks();
  for (const auto& check : all)
    if (!check.passes() && !check.warned)
      watch_.warn(fmt::format("{}: {}", model_.study.name, results::warning_of(check)));
  if (model_.ranks.is_first())
    watch_.say(fmt::format("{}: {}", model_.study.name, results::summary_of(all)));
  return all;
}

} // namespace rubato::run
