// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/function.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/time_integral.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace rubato {
namespace {

double at(const LinearTable& table, double t) {
  return interpolated(table, t);
}

double at(const Ramp& ramp, double t) {
  if (t <= ramp.begin)
    return ramp.from;
  if (t >= ramp.end)
    return ramp.to;
  const double part = (t - ramp.begin) / (ramp.end - ramp.begin);
  return (1 - part) * ramp.from + part * ramp.to;
}

double at(const Sine& sine, double t) {
  constexpr double radians = std::numbers::pi / 180;
  return sine.mean +
         sine.amplitude * std::sin(2 * std::numbers::pi * sine.frequency * t + radians * sine.phase);
}

double at(const Product& product, double t) {
  if (product.factors.empty())
    throw InputError("a product of functions has no factor, expected at least one");
  double value = 1;
  for (const auto& factor : product.factors)
    value *= value_at(factor, t);
  return value;
}

double at(const Expression& expression, double t) {
  constexpr std::array<double, 3> nowhere{};
  const double value = expression.at(nowhere, t);
  if (!std::isfinite(value))
    throw InputError(fmt::format("the function of time {} is {} at t = {:.6g}, expected a finite number",
                                 shown(expression.text()), std::isnan(value) ? "not a number" : "infinite",
                                 t));
  return value;
}

double at(const Integral& integral, double t) {
  return integral.of->at(t);
}

} // namespace

bool Integral::operator==(const Integral& other) const {
  return of == other.of || *of == *other.of;
}

bool Product::operator==(const Product& other) const {
  return factors == other.factors;
}

bool Function::operator==(const Function& other) const {
  return is == other.is;
}

double value_at(const Function& function, double t) {
  return std::visit([t](const auto& kind) { return at(kind, t); }, function.is);
}

std::size_t table_size(const Function& function) {
  if (const auto* table = function.table())
    return table->at.size();
  std::size_t size = 0;
  if (const auto* product = std::get_if<Product>(&function.is))
    for (const auto& factor : product->factors)
      size += table_size(factor);
  return size;
}

std::size_t factor_count(const Function& function) {
  const auto* product = std::get_if<Product>(&function.is);
  if (product == nullptr)
    return 1;
  std::size_t count = 0;
  for (const auto& factor : product->factors)
    count += factor_count(factor);
  return count;
}

} // namespace rubato
