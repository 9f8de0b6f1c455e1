// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/loop_parts.hpp"

#include <fmt/format.h>

namespace rubato::run {
namespace {

/// Gains below this part of the largest energy are not worth a warning: schemes that damp give back a little
/// of what they have taken.
constexpr double worth_a_warning = 1e-3;

std::string causes_of(const step::EnergyRecord& record) {
  if (record.by_impact == 0 && record.by_scheme == 0)
    return "contact is followed too coarsely in time";
  auto impact = fmt::format("contact pressures gave {:.3g} more than they took", record.by_impact);
  auto scheme = fmt::format("the time scheme gave {:.3g}, as it does where loads jump or steps are long",
                            record.by_scheme);
  if (record.by_impact <= 0)
    return scheme;
  if (record.by_scheme <= 0)
    return impact;
  return record.by_impact > record.by_scheme ? impact + ", " + scheme : scheme + ", " + impact;
}

} // namespace

bool EnergyWatch::gains() const {
  return record_.gain > worth_a_warning * record_.largest;
}

void EnergyWatch::note(double t, const step::EnergyLedger& ledger) {
  record_.note(t, ledger);
  if (warned_ || !gains())
    return;
  warned_ = true;
  watch_.warn(fmt::format("{}: energy gained at t = {:g}: {:.3g}, {:.2g} of the largest energy; {}", run_, t,
                          record_.gain, record_.gain / record_.largest, causes_of(record_)));
}

void EnergyWatch::tell() const {
  if (record_.largest == 0)
    return;
  const auto gain = gains() ? fmt::format("; largest gain {:.2g} of it, at t = {:g}",
                                          record_.gain / record_.largest, record_.gained_at)
                            : "";
  watch_.say(fmt::format("{}: energy balance within {:.2g} of the largest energy, {:.4g}{}", run_,
                         record_.largest_balance / record_.largest, record_.largest, gain));
}

} // namespace rubato::run
