// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/energy_watch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace rubato::run {
namespace {

/// Of the largest energy so far. What contact gives and takes where points part and meet stays below it.
constexpr double worth_a_warning = 1e-2;
/// Schemes that damp begin with an energy of their own where a load jumps (docs/theory/energy.md) and give it
/// to the bodies before they take it again; that takes them up to ten steps.
constexpr int soon = 10;
/// Of the largest energy. Rounding makes meshes that touch overlap by less.
constexpr double worth_telling = 1e-6;
/// Of what the bodies themselves have stored and dissipated.
constexpr double most_in_hourglasses = 0.05;
/// Of the largest energy: where bodies begin to deform, hourglasses may hold much of little.
constexpr double few_in_hourglasses = 1e-3;
/// Of the largest energy: what rounding and convergence leave.
constexpr double unexplained_energy = 1e-6;

/// Of the largest energy: what friction may give back to bodies, which it only takes from.
constexpr double given_by_friction = 1e-2;

/// What the bodies have from nowhere: all in all, or from contact, or finite strain and rotation, alone where
/// the scheme takes that again.
double gained(const step::EnergyLedger& ledger) {
  return std::max({ledger.gain(), -ledger.impact, -ledger.bulk_scheme});
}

struct Cause {
  double taken = 0;
  std::string text;
};

/// Whatever gave most first. What steps give in finite strain and rotation feeds high frequencies, which
/// schemes without damping keep.
std::string causes_of(const step::EnergyLedger& ledger, const std::string& giver) {
  const double impact = ledger.impact;
  const double scheme = ledger.numerical;
  const double strain = ledger.bulk_scheme;
  std::vector<Cause> causes;
  if (scheme != 0)
    causes.push_back({scheme, scheme < 0 ? fmt::format("the time scheme gave {:.3g}", -scheme)
                                         : fmt::format("the time scheme took {:.3g}", scheme)});
  if (impact < 0 || (scheme == 0 && strain >= 0))
    causes.push_back({impact, fmt::format("contact pressures{} gave {:.3g} more than they took",
                                          giver.empty() ? "" : " of " + giver, -impact)});
  if (strain < 0)
    causes.push_back(
        {strain,
         fmt::format("steps too long for finite strain or rotation gave {:.3g} (bulk_scheme)", -strain)});
  std::ranges::stable_sort(causes, {}, &Cause::taken);
  std::vector<std::string> texts;
  std::ranges::transform(causes, std::back_inserter(texts), &Cause::text);
  const bool by_strain = strain < 0 && causes.front().taken == strain;
  return fmt::format("{}{}", fmt::join(texts, ", "),
                     by_strain ? "; expected a time.scheme that damps, such as hht, energy_momentum for "
                                 "elastic bodies, or a shorter time.step"
                               : "");
}

/// Of a run's largest gain.
const char* cause_of(const step::EnergyRecord& record) {
  if (record.by_bulk_scheme > std::max(record.by_scheme, record.by_impact))
    return "by finite strain or rotation";
  return record.by_scheme > record.by_impact ? "by the time scheme" : "by contact";
}

} // namespace

void EnergyWatch::note(double t, const step::EnergyLedger& ledger, const std::string& giver) {
  record_.note(t, ledger);
  now_ = ledger;
  giver_ = giver;
  note_hourglasses(t);
  note_friction(t);
  if (gained(ledger) <= std::max(worth_a_warning * record_.largest, ledger.rounding)) {
    gained_for_ = 0;
    if (!warned_ && gained(ledger) > ledger.rounding)
      gain_part_ = std::max(gain_part_, gained(ledger) / record_.largest);
    return;
  }
  if (gained_for_++ == 0)
    gained_since_ = t;
  if (gained_for_ > soon)
    warn(fmt::format("from t = {:g} to {:g}", gained_since_, t));
}

void EnergyWatch::note_hourglasses(double t) {
  most_internal_ = std::max(most_internal_, now_.strain + now_.back_stress + now_.plastic + now_.viscous);
  if (now_.hourglass <= few_in_hourglasses * record_.largest)
    return;
  const double part = now_.hourglass / most_internal_;
  const bool told = hourglass_part_ > most_in_hourglasses;
  hourglass_part_ = std::max(hourglass_part_, part);
  if (told || !(part > most_in_hourglasses))
    return;
  watch_.warn(
      fmt::format("{}: hourglasses of reduced cells hold {:.3g} at t = {:g}, {:.3g} of what the bodies "
                  "have stored and dissipated, expected at most {:g}; a finer mesh, or "
                  "'formulation: mean_dilatation', 'enhanced' or 'full', cures it",
                  run_, now_.hourglass, t, part, most_in_hourglasses));
}

/// The ledger's balance does not show it: what friction gives is counted against what the bodies have.
void EnergyWatch::note_friction(double t) {
  friction_.taken = std::max(friction_.taken, now_.friction);
  if (const double given = friction_.taken - now_.friction; given > friction_.given) {
    friction_.given = given;
    friction_.t = t;
  }
}

void EnergyWatch::warn(const std::string& when) {
  if (std::exchange(warned_, true))
    return;
  const double gain = gained(now_);
  gain_part_ = gain / record_.largest;
  watch_.warn(fmt::format("{}: energy gained {}: {:.3g}, {:.2g} of the largest energy; {}", run_, when, gain,
                          gain / record_.largest, causes_of(now_, giver_)));
}

void EnergyWatch::tell() {
  if (record_.largest == 0)
    return;
  if (gained_for_ > 0)
    warn(fmt::format("from t = {:g} to the end", gained_since_));
  const auto gain = record_.gain > 0
                        ? fmt::format("; largest gain {:.2g} of it, at t = {:g}, {}",
                                      record_.gain / record_.largest, record_.gained_at, cause_of(record_))
                        : "";
  const auto overlap = now_.overlap_work > worth_telling * record_.largest
                           ? fmt::format("; what overlapped at the start gave {:.4g}", now_.overlap_work)
                           : "";
  watch_.say(fmt::format("{}: energy balance within {:.2g} of the largest energy, {:.4g}{}{}", run_,
                         record_.largest_balance / record_.largest, record_.largest, overlap, gain));
}

std::vector<results::Plausibility> EnergyWatch::checks() const {
  if (!(record_.largest > 0))
    return {};
  std::vector<results::Plausibility> checks{
      {"energy_gain", gain_part_, worth_a_warning, gained_since_, "", "", warned_},
      {"energy_balance", record_.largest_balance / record_.largest, unexplained_energy, 0, "",
       "the ledger leaves this part of the largest energy unexplained; expected a smaller "
       "'newton.residual'"}};
  if (rubs_)
    checks.push_back({"friction_gain", friction_.given / record_.largest, given_by_friction, friction_.t, "",
                      "friction gave back this part of the largest energy, though it only takes: its forces "
                      "turned within steps; expected a shorter 'time.step', or 'scheme: moreau_jean'"});
  if (now_.hourglass > 0)
    checks.push_back({"hourglass_energy", hourglass_part_, most_in_hourglasses, 0, "", "",
                      hourglass_part_ > most_in_hourglasses});
  return checks;
}

} // namespace rubato::run
