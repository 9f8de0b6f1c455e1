// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/gap_offset.hpp"

#include <algorithm>

namespace rubato::contact {

double GapOffset::at(double t) const {
  double sum = 0;
  for (const auto& term : terms)
    sum += term.value * (term.function ? value_at(*term.function, t) : 1.0);
  return sum;
}

bool GapOffset::moves() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.function.has_value(); });
}

GapOffset make_gap_offset(const study::ContactZone& settings,
                          const std::map<std::string, Function>& functions) {
  GapOffset offset;
  const auto add = [&](const study::Amplitude& amplitude, double sign) {
    if (amplitude.value == 0)
      return;
    auto& term = offset.terms.emplace_back(GapOffset::Term{sign * amplitude.value, std::nullopt});
    if (!amplitude.function.empty())
      term.function = functions.at(amplitude.function);
  };
  add(settings.gap, 1);
  add(settings.interference, -1);
  return offset;
}

} // namespace rubato::contact
