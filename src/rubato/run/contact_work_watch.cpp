// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/contact_work_watch.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace rubato::run {
namespace {

/// The largest work across gaps, in parts of the largest energy. A slave normal that drags does 0.1 to 0.8.
constexpr double work_across_gaps_limit = 2e-2;

/// Whether the gaps of a zone change by the motion of bodies alone and store nothing.
bool is_moved_by_bodies(const contact::Zone& zone) {
  return study::entry_of(zone.settings.method).exact && !zone.settings.tie && !zone.offset.moves() &&
         !(zone.obstacle && zone.obstacle->moves());
}

/// The energy that pressures of a zone take in a step if they act along its gaps.
double taken_along_gaps(const contact::ZoneState& before, const contact::ZoneState& now) {
  double taken = 0;
  for (std::size_t i = 0; i < now.outcomes.size(); ++i) {
    const auto& from = before.outcomes[i];
    const auto& to = now.outcomes[i];
    const double force = contact::pressing_force(from) + contact::pressing_force(to);
    if (force != 0 && std::isfinite(from.gap) && std::isfinite(to.gap))
      taken -= 0.5 * force * (to.gap - from.gap);
  }
  return taken;
}

} // namespace

ContactWorkWatch::ContactWorkWatch(const model::Model& model)
    : model_(model), applies_(model.study.time.scheme == study::SchemeKind::static_steps &&
                              !model.zones.empty() && std::ranges::all_of(model.zones, is_moved_by_bodies)),
      along_gaps_(model.zones.size(), 0) {}

void ContactWorkWatch::note(const step::State& before, const step::State& now,
                            const step::EnergyLedger& ledger) {
  for (std::size_t z = 0; z < now.zones.size(); ++z)
    along_gaps_[z] += taken_along_gaps(before.zones[z], now.zones[z]);
  if (!applies_)
    return;
  largest_ = std::max(largest_, ledger.largest());
  const double taken = std::accumulate(along_gaps_.begin(), along_gaps_.end(),
                                       ledger.impact - ledger.overlap_work, std::minus<>());
  if (std::exchange(first_, false) && before.t > model_.study.time.begin)
    taken_before_ = taken;
  const double across = std::abs(taken - taken_before_);
  if (across <= across_)
    return;
  across_ = across;
  t_ = now.t;
}

std::string ContactWorkWatch::giver() const {
  const auto least = std::ranges::min_element(along_gaps_);
  if (least == along_gaps_.end() || !(*least < 0))
    return "";
  const auto zone = static_cast<std::size_t>(least - along_gaps_.begin());
  return fmt::format("contact.{}", model_.zones[zone].settings.name);
}

std::vector<results::Plausibility> ContactWorkWatch::checks() const {
  if (!applies_ || !(largest_ > 0))
    return {};
  return {{"contact_work", across_ / largest_, work_across_gaps_limit, t_, "",
           "pressures did this part of the largest energy as work across their gaps, as a drag or a pull "
           "without friction; expected shorter steps, finer faces or the other side as slave"}};
}

} // namespace rubato::run
