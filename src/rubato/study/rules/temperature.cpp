// SPDX-License-Identifier: LGPL-3.0-or-later
// Temperatures and how materials expand by them.
#include "rubato/study/formulation.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {

void check_expansion(Rules& rules, const Material& material, const std::string& path) {
  if (!material.expansion)
    return;
  const auto& along = material.expansion->along;
  for (const double coefficient : along)
    rules.number(path + ".expansion", coefficient);
  rules.number(path + ".reference_temperature", material.expansion->reference);
  if (material.law != LawKind::orthotropic && (along[0] != along[1] || along[0] != along[2]))
    rules.broken({path + ".expansion", path + ".law"},
                 fmt::format("found different coefficients, but {} materials expand alike in all directions; "
                             "expected one number, or the law orthotropic",
                             entry_of(material.law).name));
}

void check_temperatures(Rules& rules) {
  const auto& temperatures = rules.study.temperatures;
  for (std::size_t i = 0; i < temperatures.size(); ++i) {
    const auto path = fmt::format("temperature.{}", i);
    rules.name(path + ".on", temperatures[i].on);
    rules.field_value(path + ".value", temperatures[i].value.value);
    rules.function(path + ".function", temperatures[i].value.function);
  }
  const auto expands = [](const Material& material) { return material.expansion.has_value(); };
  if (!temperatures.empty() && std::ranges::none_of(rules.study.materials, expands))
    rules.broken({"temperature", "materials"},
                 "has no effect, as no material expands; expected 'expansion' in a material");
}

} // namespace rubato::study
