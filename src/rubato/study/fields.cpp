// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/fields.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <utility>

namespace rubato::study {

bool is_zero(const Field& field) {
  const auto* number = field.value.number();
  return number != nullptr && *number == 0;
}

bool varies_in_time(const Field& field) {
  if (!field.function.empty())
    return true;
  if (const auto* of_file = field.value.of_file())
    return !of_file->at && (!of_file->values || of_file->values->varies_in_time());
  if (const auto* of_program = field.value.of_program())
    return of_program->values && of_program->values->varies_in_time();
  const auto* formula = field.value.formula();
  try {
    return formula != nullptr && Expression(formula->text).has('t');
  } catch (const InputError&) {
    return false;
  }
}

bool varies_in_place(const Field& field) {
  const auto* formula = field.value.formula();
  if (formula == nullptr)
    return field.value.number() == nullptr;
  try {
    const Expression expression(formula->text);
    return expression.has('x') || expression.has('y') || expression.has('z');
  } catch (const InputError&) {
    return false;
  }
}

namespace {

std::shared_ptr<const SampledField> values_of(const FileField& field, const std::string& path) {
  if (!field.values)
    throw InputError({fault_at(path, path + ": the field of the file has not been read")});
  return field.values;
}

std::shared_ptr<const SampledField> values_of(const GivenField& field, const std::string& path) {
  if (!field.values)
    throw InputError({fault_at(path, path + ": the field " + shown(field.name) + " has no values")});
  return field.values;
}

} // namespace

FieldFunction field_function(const FieldValue& value, const std::string& function,
                             const std::map<std::string, Function>& functions, std::string path) {
  FieldFunction field;
  if (const auto* formula = value.formula())
    field.expression = Expression(formula->text);
  else if (const auto* profile = value.profile())
    field.profile = *profile;
  else if (const auto* of_file = value.of_file())
    field.sampled = values_of(*of_file, path);
  else if (const auto* of_program = value.of_program())
    field.sampled = values_of(*of_program, path);
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
