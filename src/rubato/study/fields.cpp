// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/fields.hpp"

#include "rubato/core/error.hpp"

#include <utility>

namespace rubato::study {

bool is_zero(const Field& field) {
  const auto* number = field.value.number();
  return number != nullptr && *number == 0;
}

bool varies_in_time(const Field& field) {
  if (!field.function.empty())
    return true;
  const auto* formula = field.value.formula();
  try {
    return formula != nullptr && Expression(formula->text).has('t');
  } catch (const InputError&) {
    return false;
  }
}

FieldFunction field_function(const FieldValue& value, const std::string& function,
                             const std::map<std::string, Function>& functions, std::string path) {
  FieldFunction field;
  if (const auto* formula = value.formula())
    field.expression = Expression(formula->text);
  else if (const auto* profile = value.profile())
    field.profile = *profile;
  else
    field.number = *value.number();
  if (!function.empty())
    field.function = functions.at(function);
  field.path = std::move(path);
  return field;
}

FieldFunction field_function(const Field& field, const std::map<std::string, Function>& functions,
                             std::string path) {
  return field_function(field.value, field.function, functions, std::move(path));
}

} // namespace rubato::study
