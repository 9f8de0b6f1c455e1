// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/large_rotations.hpp"

#include "rubato/core/time_integral.hpp"
#include "rubato/study/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::study {
namespace {

/// Instants that are looked at of a run that finds its steps itself, and the most of any other.
constexpr double instants_unknown = 1000;
constexpr double most_instants = 100'000;

/// The begin and the end among them.
std::vector<double> instants_of(const TimeStepping& time) {
  auto instants = time.instants;
  instants.insert(instants.end(), time.stops.begin(), time.stops.end());
  const double span = time.end - time.begin;
  const double spacing = time.step > 0 ? std::max(time.step, span / most_instants) : span / instants_unknown;
  if (time.instants.empty())
    for (double i = 0; i * spacing < span; ++i)
      instants.push_back(time.begin + i * spacing);
  std::erase_if(instants, [&](double t) { return !(t > time.begin && t < time.end); });
  instants.insert(instants.end(), {time.begin, time.end});
  return instants;
}

} // namespace

bool takes_large_rotations(const Study& /*study*/) {
  return false;
}

AngleAt largest_angle(const Rotation& rotation, const Study& study) {
  constexpr std::array<double, 3> anywhere{};
  const auto& time = study.time;
  auto angle = field_function(rotation.angle, study.functions, {});
  if (rotation.angle.given != Given::displacement)
    angle = integrated(angle, static_cast<int>(rotation.angle.given), time.begin, time.end);
  AngleAt largest{0, time.begin};
  for (const double t : instants_of(time))
    if (const double found = angle.at(anywhere, t); !(std::abs(found) <= std::abs(largest.angle)))
      largest = {found, t};
  return largest;
}

} // namespace rubato::study
