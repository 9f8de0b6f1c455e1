// SPDX-License-Identifier: LGPL-3.0-or-later
// Temperatures and how materials expand by them.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::deck {
namespace {

/// One number for all axes of the material, or three.
bool read_coefficients(const Value& value, std::array<double, 3>& along) {
  if (!value.tree().is(Tree::Kind::list)) {
    double all = 0;
    const bool good = read(value, all);
    along.fill(all);
    return good;
  }
  std::vector<double> numbers;
  if (!read(value, numbers))
    return false;
  if (numbers.size() != along.size()) {
    value.fault(fmt::format("found {} numbers, expected one, or three along the axes of the material",
                            numbers.size()));
    return false;
  }
  std::ranges::copy(numbers, along.begin());
  return true;
}

study::Temperature read_temperature(const Value& value, const Context& context) {
  study::Temperature temperature;
  MapReader map(value);
  read_name(map.require("on"), temperature.on);
  read_field_value(map.require("value"), context, temperature.value.value);
  read_name(map.find("function"), temperature.value.function);
  map.finish();
  return temperature;
}

} // namespace

void read_expansion(MapReader& material, std::optional<study::ThermalExpansion>& expansion) {
  const auto coefficients = material.find("expansion");
  const auto reference = material.find("reference_temperature");
  if (!coefficients) {
    if (reference)
      reference->fault("goes with 'expansion' only, expected the coefficient beside it");
    return;
  }
  study::ThermalExpansion found;
  read(reference, found.reference);
  if (read_coefficients(*coefficients, found.along))
    expansion = found;
}

void read_temperatures(const Found& value, const Context& context,
                       std::vector<study::Temperature>& temperatures) {
  for (const auto& item : items(value))
    temperatures.push_back(read_temperature(item, context));
}

} // namespace rubato::deck
