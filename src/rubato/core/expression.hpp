// SPDX-License-Identifier: LGPL-3.0-or-later
/// Numbers as functions of place and time, written as text: "1e-4*(x-0.5)^2".
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace rubato {

/// An expression of x, y, z and t. It has numbers, the constant pi, + - * / ^, comparisons (1 or 0), && and
/// ||, brackets, and the functions sin, cos, tan, asin, acos, atan, atan2(y, x), sinh, cosh, tanh, exp, log
/// (natural), log10, sqrt, abs, floor, ceil, sign (−1, 0 or 1), min and max of any number of arguments, and
/// if(condition, value, other). Powers come before signs, −2^2 = −4, and are taken from the right.
///
/// It computes numbers and does nothing else: there is no assignment, no text and no name but those above.
/// The same arguments give the same bits. Copies share what was parsed.
class Expression {
public:
  /// Throws InputError with one sentence, without a place, when `text` is no such expression.
  explicit Expression(std::string text);

  const std::string& text() const;
  /// Whether it depends on 'x', 'y', 'z' or 't'.
  bool has(char variable) const;
  /// Its value at a place (x, y, z) and an instant; may be infinite or not a number. Threads take turns.
  double at(std::span<const double, 3> place, double t) const;

  friend bool operator==(const Expression& a, const Expression& b) { return a.text() == b.text(); }

private:
  class Parsed;
  std::shared_ptr<const Parsed> parsed_;
};

} // namespace rubato
