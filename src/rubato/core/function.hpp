// SPDX-License-Identifier: LGPL-3.0-or-later
/// Functions of time.
#pragma once

#include "rubato/core/expression.hpp"
#include "rubato/core/linear_table.hpp"

#include <cstddef>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace rubato {

struct Function;

/// A straight line between two instants, constant before and after.
struct Ramp {
  double begin = 0; ///< instant
  double end = 1;   ///< instant, after `begin`
  double from = 0;
  double to = 1;
  bool operator==(const Ramp&) const = default;
};

/// mean + amplitude sin(2π frequency t + phase).
struct Sine {
  double amplitude = 1;
  double frequency = 1; ///< [1/time]
  double phase = 0;     ///< [degrees]
  double mean = 0;
  bool operator==(const Sine&) const = default;
};

struct Product {
  std::vector<Function> factors; ///< at least one
  bool operator==(const Product& other) const;
};

class TimeIntegral;

/// The integral of another function over time (core/time_integral.hpp). Models make it, no study has it.
struct Integral {
  std::shared_ptr<const TimeIntegral> of; ///< there is one
  bool operator==(const Integral& other) const;
};

/// A function of time: a table, or one of the forms above, or an expression of t.
struct Function {
  using Outside = LinearTable::Outside;
  using Kind = std::variant<LinearTable, Ramp, Sine, Product, Expression, Integral>;

  Function() = default;
  /// A table of instants and values.
  Function(std::vector<double> times, std::vector<double> values, Outside outside = Outside::constant)
      : is(LinearTable{std::move(times), std::move(values), outside}) {}
  Function(Kind kind) : is(std::move(kind)) {}

  Kind is;

  /// Null when it is no table.
  const LinearTable* table() const { return std::get_if<LinearTable>(&is); }
  bool operator==(const Function& other) const;
};

/// The function at the instant `t`. Throws InputError, a sentence without a place, for a broken table, a
/// product without factors, and an expression that gives no finite number.
double value_at(const Function& function, double t);

/// Instants and values in all the tables of the function.
std::size_t table_size(const Function& function);
/// Functions that are no products which the function is made of, each as often as it occurs.
std::size_t factor_count(const Function& function);

} // namespace rubato
