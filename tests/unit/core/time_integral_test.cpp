// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/time_integral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace rubato::time_integral_test {
namespace {

using std::numbers::pi;

TimeIntegral integral(const Function& function, int times, double begin, double end) {
  return {function, std::nullopt, times, begin, end};
}

/// The largest difference from a formula in the run, relative to the largest value.
double error(const TimeIntegral& integral, double begin, double end,
             const std::function<double(double)>& exact) {
  double off = 0;
  double largest = 0;
  for (int i = 0; i <= 1237; ++i) {
    const double t = begin + (end - begin) * i / 1237;
    off = std::max(off, std::abs(integral.at(t) - exact(t)));
    largest = std::max(largest, std::abs(exact(t)));
  }
  return off / largest;
}

TEST(TimeIntegral, OfANumberIsExactFromTheFirstInstantOn) {
  const TimeIntegral once(std::nullopt, std::nullopt, 1, 2, 1e4);
  const TimeIntegral twice(std::nullopt, std::nullopt, 2, 2, 1e4);
  for (const double past : {1e-9, 1e-3, 1., 9e3}) {
    EXPECT_NEAR(once.at(2 + past), past, 1e-15 * (2 + past));
    EXPECT_NEAR(twice.at(2 + past), past * past / 2, 2e-15 * past * (2 + past));
  }
  EXPECT_EQ(once.at(2), 0);
}

TEST(TimeIntegral, OfATableIsExactFromPieceToPiece) {
  const Function table({0, 1, 3}, {1, 3, -1});
  const auto once = integral(table, 1, 0, 4);
  EXPECT_DOUBLE_EQ(once.at(0.5), 0.5 + 0.25);
  EXPECT_DOUBLE_EQ(once.at(1), 2);
  EXPECT_DOUBLE_EQ(once.at(3), 4);
  EXPECT_DOUBLE_EQ(once.at(4), 3);
  const auto twice = integral(table, 2, 0, 4);
  EXPECT_DOUBLE_EQ(twice.at(1), 0.5 + 1. / 3);
  // ∫₁² of 2 + 3τ − τ²
  EXPECT_DOUBLE_EQ(twice.at(2), 0.5 + 1. / 3 + 2 + 1.5 - 1. / 3);
  EXPECT_DOUBLE_EQ(twice.derivative(2, 1), 4);
  EXPECT_DOUBLE_EQ(twice.derivative(2, 2), 1);
}

TEST(TimeIntegral, OfATableKnowsWhatIsOutsideOfIt) {
  using enum LinearTable::Outside;
  const auto at_ends = [](Function::Outside outside) {
    const Function table({1, 2}, {1, 2}, outside);
    const auto once = integral(table, 1, 0, 3);
    return std::array{once.at(1), once.at(2) - once.at(1), once.at(3) - once.at(2)};
  };
  EXPECT_EQ(at_ends(constant), (std::array{1., 1.5, 2.}));
  EXPECT_EQ(at_ends(linear), (std::array{0.5, 1.5, 2.5}));
  EXPECT_EQ(at_ends(zero), (std::array{0., 1.5, 0.}));
}

TEST(TimeIntegral, OfALongTableKeepsItsDigits) {
  std::vector<double> times;
  std::vector<double> values;
  for (int i = 0; i <= 50'000; ++i) {
    times.push_back(1e-3 * i);
    values.push_back(std::sin(0.01 * i * i));
  }
  long double velocity = 0;
  long double displacement = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const long double h = static_cast<long double>(times[i + 1]) - times[i];
    displacement += velocity * h + h * h / 6 * (2 * static_cast<long double>(values[i]) + values[i + 1]);
    velocity += h / 2 * (static_cast<long double>(values[i]) + values[i + 1]);
  }
  const auto twice = integral(Function(times, values), 2, 0, 50);
  EXPECT_NEAR(twice.at(50), static_cast<double>(displacement),
              1e-13 * std::abs(static_cast<double>(displacement)));
}

TEST(TimeIntegral, OfASineIsItsFormulaAlsoNearTheBegin) {
  const Sine sine{.amplitude = 2, .frequency = 3, .phase = 0, .mean = 0};
  const double omega = 6 * pi;
  const auto twice = integral(Function(sine), 2, 0, 10);
  EXPECT_LE(error(twice, 0, 10, [&](double t) { return 2 / omega * (t - std::sin(omega * t) / omega); }),
            1e-14);
  const double soon = 1e-6;
  EXPECT_NEAR(twice.at(soon), 2 * omega * std::pow(soon, 3) / 6, 1e-11 * std::pow(soon, 3) * omega);
  const Sine moved{.amplitude = 2, .frequency = 3, .phase = 90, .mean = 1};
  const auto once = integral(Function(moved), 1, 0, 10);
  EXPECT_LE(error(once, 0, 10, [&](double t) { return t + 2 * std::sin(omega * t) / omega; }), 1e-14);
  EXPECT_DOUBLE_EQ(once.derivative(0, 1), 3);
}

TEST(TimeIntegral, OfAnExpressionIsAccurateToRounding) {
  const auto once = integral(Function(Expression("exp(-3*t)*cos(200*t)")), 1, 0, 2);
  const auto exact = [](double t) {
    return (std::exp(-3 * t) * (200 * std::sin(200 * t) - 3 * std::cos(200 * t)) + 3) / (9 + 200 * 200);
  };
  EXPECT_LE(error(once, 0, 2, exact), 1e-12);
  const auto twice = integral(Function(Expression("exp(t)")), 2, 1, 3);
  EXPECT_LE(error(twice, 1, 3, [](double t) { return std::exp(t) - std::exp(1.) * t; }), 1e-13);
  EXPECT_NEAR(twice.derivative(1.7, 1), std::exp(1.7) - std::exp(1.), 1e-13);
  EXPECT_NEAR(twice.derivative(1.7, 2), std::exp(1.7), 1e-13);
}

TEST(TimeIntegral, FindsJumpsAndKinks) {
  const auto jump = integral(Function(Expression("(t>0.1234567)*2")), 1, 0, 1);
  EXPECT_NEAR(jump.at(1), 2 * (1 - 0.1234567), 1e-13);
  EXPECT_NEAR(jump.at(0.1234567), 0, 1e-13);
  const auto kink = integral(Function(Expression("abs(t-0.377)")), 2, 0, 1);
  const auto cube = [](double t) { return std::pow(std::abs(t - 0.377), 3) / 6; };
  EXPECT_NEAR(kink.at(1), cube(1) + 0.377 * 0.377 / 2 - cube(0), 1e-13);
}

TEST(TimeIntegral, OfAProductTakesTheBreaksOfItsTables) {
  const Function product(Product{{Function({0, 0.3, 1}, {0, 1, 0}), Function(Sine{.frequency = 2})}});
  const auto once = integral(product, 1, 0, 1);
  const double w = 4 * pi;
  const auto rising = [&](double t) { return (std::sin(w * t) / w - t * std::cos(w * t)) / w / 0.3; };
  const auto falling = [&](double t) {
    return (-(1 - t) * std::cos(w * t) / w - std::sin(w * t) / w / w) / 0.7;
  };
  EXPECT_NEAR(once.at(0.3), rising(0.3), 1e-15);
  EXPECT_NEAR(once.at(1), rising(0.3) + falling(1) - falling(0.3), 1e-15);
}

/// Explicit runs ask half a step before the begin and a step beyond the end.
TEST(TimeIntegral, KeepsTheEndValuesOfAnExpressionOutsideOfTheRun) {
  const auto twice = integral(Function(Expression("sqrt(t)")), 2, 0, 1);
  EXPECT_NEAR(twice.at(1) - twice.at(0), 4. / 15, 1e-12);
  EXPECT_NEAR(twice.at(1.5), 4. / 15 + 0.5 * 2 / 3 + 0.125, 1e-12);
  EXPECT_NEAR(integral(Function(Expression("2+t")), 1, 0, 1).at(-0.1), -0.2, 1e-15);
}

TEST(TimeIntegral, RefusesWhatIsNotFinite) {
  try {
    integral(Function(Expression("1/(t-0.5)^2")), 1, 0, 1);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.find("expected a finite number") != std::string::npos ||
                text.find("it is infinite near t = 0.5") != std::string::npos)
        << text;
  }
}

TEST(TimeIntegral, IsEqualToOneOfTheSameFunctionOverTheSameRun) {
  const Function table({0, 1}, {0, 1});
  EXPECT_TRUE(integral(table, 1, 0, 1) == integral(table, 1, 0, 1));
  EXPECT_FALSE(integral(table, 1, 0, 1) == integral(table, 2, 0, 1));
  EXPECT_FALSE(integral(table, 1, 0, 1) == integral(table, 1, 0, 2));
}

TEST(IntegratedField, TakesAnExpressionOfTimeInAndLeavesThatOfThePlace) {
  FieldFunction of_time{.number = 1, .expression = Expression("2*t"), .function = std::nullopt, .path = "p"};
  const std::array place{3., 0., 0.};
  EXPECT_NEAR(integrated(of_time, 1, 0, 2).at(place, 1.5), 2.25, 1e-14);
  FieldFunction of_place{.number = 1, .expression = Expression("2*x"), .function = Function({0, 1}, {0, 1})};
  EXPECT_NEAR(integrated(of_place, 1, 0, 2).at(place, 1), 3, 1e-14);
  FieldFunction of_both{.number = 1, .expression = Expression("x*t"), .function = std::nullopt, .path = "p"};
  EXPECT_THROW(integrated(of_both, 1, 0, 2), InputError);
}

} // namespace
} // namespace rubato::time_integral_test
