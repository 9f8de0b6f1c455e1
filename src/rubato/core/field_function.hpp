// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a value of a study is where and when it is asked for.
#pragma once

#include "rubato/core/expression.hpp"
#include "rubato/core/function.hpp"

#include <optional>
#include <span>
#include <string>

namespace rubato {

/// A number or an expression of place and time, times a function of time.
struct FieldFunction {
  double number = 1; ///< multiplies the expression when there is one
  std::optional<Expression> expression;
  std::optional<Function> function; ///< 1 when there is none
  std::string path = {};            ///< of the value in the study, for messages

  bool varies_in_place() const;
  bool varies_in_time() const;

  /// At a place (x, y, z), undeformed, and an instant. Throws InputError at the path when an expression gives
  /// no finite number there: one sentence with the place and the instant.
  double at(std::span<const double, 3> place, double t) const;

  /// Whether they are the same function, wherever the study has them.
  bool operator==(const FieldFunction& other) const {
    return number == other.number && expression == other.expression && function == other.function;
  }
};

/// "x = 0.5, y = 0, z = 0, t = 1e-3".
std::string shown_place(std::span<const double, 3> place, double t);

} // namespace rubato
