// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/watches.hpp"

#include "rubato/model/formulation_notes.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::run {
namespace {

using results::Plausibility;

/// How many instants of a run sums over all nodes are taken at: in every step they would cost too much.
constexpr double samples = 20;
/// In parts of the mass of the bodies.
constexpr double added_mass_limit = 0.05;

void append(std::vector<Plausibility>& all, const std::vector<Plausibility>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

bool rubs(const model::Model& model) {
  return std::ranges::any_of(model.zones, [](const auto& zone) { return zone.settings.friction > 0; });
}

/// The checks that the model decides before the first step. Notes of the model warn of its cells.
std::vector<Plausibility> checks_of(const model::Model& model) {
  const double t = model.study.time.begin;
  std::vector<Plausibility> checks{
      {"locking_materials", static_cast<double>(model.locking_materials), 0, t, "", "", true},
      {"slender_parts", model.slenderness, model::slender, t, "", "", true}};
  if (model.study.time.mass_scaling)
    checks.push_back({"added_mass", model.added_mass, added_mass_limit, t, "",
                      "mass_scaling adds this part of the mass of the bodies; expected a shorter "
                      "'time.mass_scaling.step'"});
  return checks;
}

} // namespace

Watches::Watches(const model::Model& model, const Watch& watch, const step::EnergyRecord& record,
                 std::vector<Plausibility> former)
    : model_(model), watch_(watch), former_(std::move(former)),
      energy_(model.study.name, watch, record, rubs(model)), overlaps_(model, watch), recall_(model, watch),
      turns_(model, watch), strains_(model, watch), springs_(model, watch), balance_(model), work_(model),
      pressures_(model), waves_(model) {
  results::keep_larger(former_, checks_of(model));
}

/// Takes the first step into each twentieth of the run, and the last step.
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
  pressures_.note(before, told);
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
