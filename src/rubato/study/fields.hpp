// SPDX-License-Identifier: LGPL-3.0-or-later
/// Values that may be expressions of place and time.
#pragma once

#include "rubato/core/field_function.hpp"
#include "rubato/study/study.hpp"

#include <map>
#include <string>

namespace rubato::study {

/// Whether it is the number 0, everywhere and always.
bool is_zero(const Field& field);

/// Whether it may change with time: by a function, or as an expression of t. An expression that is broken
/// does not.
bool varies_in_time(const Field& field);

/// Whether it depends on the place. An expression that is broken does not.
bool varies_in_place(const Field& field);

/// What a field is where and when; `functions` has the one that it names. `path` is that of the field in the
/// study. Throws InputError when the expression is broken.
FieldFunction field_function(const FieldValue& value, const std::string& function,
                             const std::map<std::string, Function>& functions, std::string path);
FieldFunction field_function(const Field& field, const std::map<std::string, Function>& functions,
                             std::string path);

} // namespace rubato::study
