// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/field_function.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace rubato {

bool FieldFunction::varies_in_place() const {
  return profile || sampled ||
         (expression && (expression->has('x') || expression->has('y') || expression->has('z')));
}

bool FieldFunction::varies_in_time() const {
  return function.has_value() || (expression && expression->has('t')) ||
         (sampled && sampled->varies_in_time());
}

double FieldFunction::at(std::span<const double, 3> place, double t) const {
  return multiplied_at(place, t) * (function ? value_at(*function, t) : 1.0);
}

namespace {

double sample(const FieldFunction& field, std::span<const double, 3> place, double t) {
  try {
    return field.sampled->at(place, t);
  } catch (const InputError& error) {
    throw InputError({fault_at(field.path, field.path + ": " + error.faults().front().text)});
  }
}

} // namespace

double FieldFunction::multiplied_at(std::span<const double, 3> place, double t) const {
  if (sampled)
    return number * sample(*this, place, t);
  if (profile)
    return number * interpolated(profile->table, place[profile->axis]);
  if (!expression)
    return number;
  const double value = expression->at(place, t);
  if (!std::isfinite(value))
    throw InputError({fault_at(
        path, fmt::format("{}: {} is {} at {}, expected a finite number", path, shown(expression->text()),
                          std::isnan(value) ? "not a number" : "infinite", shown_place(place, t)))});
  return number * value;
}

std::string shown_place(std::span<const double, 3> place) {
  return fmt::format("x = {:.6g}, y = {:.6g}, z = {:.6g}", place[0], place[1], place[2]);
}

std::string shown_place(std::span<const double, 3> place, double t) {
  return fmt::format("{}, t = {:.6g}", shown_place(place), t);
}

} // namespace rubato
