// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/gap_offset.hpp"

#include "rubato/core/error.hpp"
#include "rubato/study/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

double length_at(const GapOffset::Term& term, const Vector3d& place, double t) {
  const std::span<const double, 3> x(place.data(), 3);
  const double length = term.length.at(x, t);
  if (length < 0 && term.sense == GapOffset::Sense::overlaps)
    throw InputError(
        {fault_at(term.length.path, fmt::format("{}: found {} at {}, an interference is a positive overlap, "
                                                "expected a gap, which sets surfaces apart",
                                                term.length.path, length, shown_place(x, t)))});
  return length;
}

} // namespace

double GapOffset::sum_at(const Vector3d& place, double t) const {
  double sum = 0;
  for (const auto& term : terms)
    sum += term.sense == Sense::opens ? length_at(term, place, t) : -length_at(term, place, t);
  return sum;
}

double GapOffset::overlap_at(const Vector3d& place, double t) const {
  double sum = 0;
  for (const auto& term : terms)
    if (term.sense == Sense::overlaps)
      sum += length_at(term, place, t);
  return sum;
}

bool GapOffset::moves() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.length.varies_in_time(); });
}

GapOffset make_gap_offset(const study::ContactZone& settings,
                          const std::map<std::string, Function>& functions, const std::string& path) {
  GapOffset offset;
  const auto add = [&](const study::Field& field, GapOffset::Sense sense, const char* key) {
    if (!study::is_zero(field))
      offset.terms.push_back({sense, study::field_function(field, functions, path + "." + key)});
  };
  add(settings.gap, GapOffset::Sense::opens, "gap");
  add(settings.interference, GapOffset::Sense::overlaps, "interference");
  return offset;
}

} // namespace rubato::contact
