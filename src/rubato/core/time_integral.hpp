// SPDX-License-Identifier: LGPL-3.0-or-later
/// Integrals of functions over time: displacements that follow from velocities and accelerations.
#pragma once

#include "rubato/core/field_function.hpp"
#include "rubato/core/function.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace rubato {

/// f on an interval and what its integrals are at the begin of the interval: a straight line, or a
/// polynomial.
struct IntegralPiece {
  /// Coefficients of Chebyshev polynomials of ξ, −1…1 on the interval. Of a smooth function between
  /// breakpoints 15 of them, from values at as many places, are exact to rounding or the interval is halved.
  static constexpr std::size_t coefficients = 15;
  using Series = std::array<double, coefficients + 2>;
  struct Polynomial {
    Series f{};
    Series once{};  ///< ∫ f dξ from −1
    Series twice{}; ///< ∫∫ f dξ dξ from −1
  };

  double begin = 0;
  double length = 1;                                 ///< > 0
  double value = 0;                                  ///< of f at `begin`
  double slope = 0;                                  ///< of a straight line
  std::shared_ptr<const Polynomial> polynomial = {}; ///< else
  double velocity = 0;                               ///< ∫ f dt up to `begin`
  double displacement = 0;

  /// f taken 0, 1 or 2 times integrated, or, at −1, its derivative.
  double at(double t, int integrals) const;
};

/// The integral of a function of time, taken once or twice, which is 0 at `begin` with its rate, if taken
/// twice.
///
/// It is tabulated when it is made: asking costs a search among the pieces. Tables, ramps and numbers are
/// integrated exactly from piece to piece, a sine by its formula, everything else, between the breakpoints of
/// its tables, by polynomials on pieces which are halved until what they leave is rounding. Before `begin`
/// and after `end` these others keep the value that they have there.
class TimeIntegral {
public:
  /// Of `function` times an expression of t; each is 1 when there is none. Throws InputError, a sentence
  /// without a place, when the function has no finite value, or changes too fast to be integrated.
  TimeIntegral(std::optional<Function> function, std::optional<Expression> expression, int times,
               double begin, double end);

  int times() const { return times_; }
  double at(double t) const { return derivative(t, 0); }
  /// Its derivative of that order, 0 to 2; from the right where it jumps.
  double derivative(double t, int order) const;

  bool operator==(const TimeIntegral& other) const;

private:
  /// mean + amplitude sin(ω t + φ) and what makes the integrals 0 at begin.
  struct OfSine {
    double mean = 0, amplitude = 0, omega = 1, phase = 0;
  };
  using Pieces = std::vector<IntegralPiece>;

  double integrand(double t) const;
  double of_sine(const OfSine& sine, double t, int integrals) const;

  std::optional<Function> function_;
  std::optional<Expression> expression_;
  int times_;
  double begin_;
  double end_;
  std::variant<Pieces, OfSine> is_;
};

/// The same field, its function and an expression of t integrated that many times, 0 at `begin`; its place
/// multiplies the integral. Throws InputError at its path for an expression of both place and time, and where
/// TimeIntegral does.
FieldFunction integrated(const FieldFunction& field, int times, double begin, double end);

/// The derivative of a function that is an integral, order 1 or 2; 0 of others: who gives a displacement says
/// nothing of its rates.
double rate_at(const std::optional<Function>& function, double t, int order);

} // namespace rubato
