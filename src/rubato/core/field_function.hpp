// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a value of a study is where and when it is asked for.
#pragma once

#include "rubato/core/expression.hpp"
#include "rubato/core/function.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace rubato {

/// A table along an axis.
struct Profile {
  std::size_t axis = 0; ///< 0 x, 1 y, 2 z
  LinearTable table;    ///< of coordinates, undeformed
  bool operator==(const Profile&) const = default;
};

/// A number at each place that no formula gives: known at the nodes of a mesh, and between them.
class SampledField {
public:
  SampledField() = default;
  SampledField(const SampledField&) = delete;
  SampledField& operator=(const SampledField&) = delete;
  virtual ~SampledField() = default;
  /// At an undeformed place and an instant. Throws InputError, a sentence without a path, where it is not
  /// known.
  virtual double at(std::span<const double, 3> place, double t) const = 0;
  virtual bool varies_in_time() const = 0;
};

/// A number, an expression of place and time, a profile or a sampled field, times a function of time.
struct FieldFunction {
  double number = 1; ///< multiplies the expression, the profile or the samples when there are some
  std::optional<Expression> expression;
  std::optional<Function> function; ///< 1 when there is none
  std::string path = {};            ///< of the value in the study, for messages
  std::optional<Profile> profile = {};
  std::shared_ptr<const SampledField> sampled = {};

  bool varies_in_place() const;
  bool varies_in_time() const;

  /// At a place (x, y, z), undeformed, and an instant. Throws InputError at the path when an expression gives
  /// no finite number there, or samples none: one sentence with the place and the instant.
  double at(std::span<const double, 3> place, double t) const;
  /// The same without the function of time.
  double multiplied_at(std::span<const double, 3> place, double t) const;

  /// Whether they are the same function, wherever the study has them.
  bool operator==(const FieldFunction& other) const {
    return number == other.number && expression == other.expression && function == other.function &&
           profile == other.profile && sampled == other.sampled;
  }
};

/// "x = 0.5, y = 0, z = 0".
std::string shown_place(std::span<const double, 3> place);
/// "x = 0.5, y = 0, z = 0, t = 1e-3".
std::string shown_place(std::span<const double, 3> place, double t);

} // namespace rubato
