// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/expression.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::expression_test {
namespace {

constexpr std::array place{0.25, -2.0, 4.0};
constexpr double instant = 0.5;

double value_of(const std::string& text) {
  return Expression(text).at(place, instant);
}

/// What is wrong with it; empty when nothing is.
std::string flaw_of(const std::string& text) {
  try {
    const Expression expression(text);
    return {};
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 1U);
    return error.what();
  }
}

TEST(AnExpression, HasTheUsualOrderOfOperations) {
  EXPECT_EQ(value_of("1+2*3^2"), 19);
  EXPECT_EQ(value_of("-2^2"), -4);
  EXPECT_EQ(value_of("2^3^2"), 512);
  EXPECT_EQ(value_of("2^-2"), 0.25);
  EXPECT_EQ(value_of("(1+2)*3"), 9);
  EXPECT_EQ(value_of("8/4/2"), 1);
  EXPECT_EQ(value_of(" 1 - 2\n- 3 "), -4);
  EXPECT_EQ(value_of("+x*-y"), 0.5);
}

TEST(AnExpression, KnowsPlaceAndInstant) {
  EXPECT_EQ(value_of("x"), 0.25);
  EXPECT_EQ(value_of("y"), -2);
  EXPECT_EQ(value_of("z"), 4);
  EXPECT_EQ(value_of("t"), 0.5);
  EXPECT_EQ(value_of("1e-4*(x-0.5)^2"), 1e-4 * std::pow(0.25 - 0.5, 2));
  const Expression slope("1e-3*x + t*pi");
  EXPECT_TRUE(slope.has('x') && slope.has('t'));
  EXPECT_FALSE(slope.has('y') || slope.has('z'));
}

TEST(AnExpression, HasTheFunctionsOfTheLibrary) {
  const double x = place[0];
  EXPECT_EQ(value_of("pi"), std::numbers::pi);
  EXPECT_EQ(value_of("sin(x)"), std::sin(x));
  EXPECT_EQ(value_of("cos(x)"), std::cos(x));
  EXPECT_EQ(value_of("tan(x)"), std::tan(x));
  EXPECT_EQ(value_of("asin(x)"), std::asin(x));
  EXPECT_EQ(value_of("acos(x)"), std::acos(x));
  EXPECT_EQ(value_of("atan(x)"), std::atan(x));
  EXPECT_EQ(value_of("atan2(y, x)"), std::atan2(-2, x));
  EXPECT_EQ(value_of("sinh(x)"), std::sinh(x));
  EXPECT_EQ(value_of("cosh(x)"), std::cosh(x));
  EXPECT_EQ(value_of("tanh(x)"), std::tanh(x));
  EXPECT_EQ(value_of("exp(x)"), std::exp(x));
  EXPECT_EQ(value_of("log(x)"), std::log(x));
  EXPECT_EQ(value_of("log10(x)"), std::log10(x));
  EXPECT_EQ(value_of("sqrt(x)"), 0.5);
  EXPECT_EQ(value_of("abs(y)"), 2);
  EXPECT_EQ(value_of("min(3, y, z)"), -2);
  EXPECT_EQ(value_of("max(3, y, z)"), 4);
  EXPECT_EQ(value_of("floor(-x)"), -1);
  EXPECT_EQ(value_of("ceil(x)"), 1);
  EXPECT_EQ(value_of("sign(y) + sign(z) + sign(0)"), 0);
  EXPECT_EQ(value_of("if(y < 0 && z >= 4, 7, 8)"), 7);
  EXPECT_EQ(value_of("if(x == 1 || t != 0.5, 7, 8)"), 8);
}

TEST(AnExpression, SaysWhenItHasNoFiniteValue) {
  EXPECT_TRUE(std::isinf(value_of("1/(x-0.25)")));
  EXPECT_TRUE(std::isnan(value_of("sqrt(y)")));
  EXPECT_TRUE(std::isnan(value_of("min(1, sqrt(y))"))) << "least and greatest hide nothing";
  EXPECT_TRUE(std::isnan(value_of("max(sqrt(y), 1)")));
  EXPECT_EQ(value_of("if(y > 0, sqrt(y), 0)"), 0);
}

TEST(AnExpression, IsSharedByItsCopies) {
  std::vector<Expression> copies;
  {
    const Expression original("x+t");
    copies.assign(3, original);
  }
  EXPECT_EQ(copies[2].at(place, 1), 1.25);
  EXPECT_EQ(copies[0].at(place, 2), 2.25);
  EXPECT_EQ(copies[0], copies[1]);
  EXPECT_NE(copies[0], Expression("t+x"));
}

TEST(AnExpression, RefusesInOneSentenceWhatItDoesNotMean) {
  const auto refused = [](const std::string& text, const std::string& why) {
    EXPECT_EQ(flaw_of(text),
              "found '" + text + "', expected a number or an expression of x, y, z and t: " + why);
  };
  const std::string names = "; expected one of x, y, z, t, pi, sin, cos, tan, asin, acos, atan, sinh, cosh, "
                            "tanh, exp, log, log10, sqrt, abs, floor, ceil, sign, atan2, if, min, max";
  refused("system('x')", "unknown name 'system' at character 1" + names);
  refused("1+sinn(x)", "unknown name 'sinn' at character 3; did you mean 'sin'?");
  refused("inf", "unknown name 'inf' at character 1" + names);
  refused("x=3", "'=' at character 2 would assign, expected '==', which compares");
  refused("x <- 3 = 2", "'=' at character 8 would assign, expected '==', which compares");
  refused("\"a\"", "text begins at character 1, expected numbers only");
  refused("x + 'a'", "text begins at character 5, expected numbers only");
  refused("", "it is empty");
  refused("  ", "it is empty");
  refused("(x", "a closing bracket is missing");
  refused("x)", "')' at character 2 is out of place");
  refused("x*", "it ends where a value is expected");
  refused("x y", "'y' at character 3 is out of place");
  refused("2x", "a number is followed by 'x' at character 2, expected an operator");
  refused("1e-3s", "a number is followed by 's' at character 5, expected an operator");
  refused("1e999", "no number, or one that is out of range, begins at character 1");
  refused("sin x", "'sin' is a function, expected '(' after it at character 5");
  refused("x(2)", "'x' is no function, but '(' follows it at character 2");
  refused("sin()", "too few arguments of 'sin'");
  refused("sin(1,2)", "too many arguments of 'sin'");
  refused("1,2", "it has 2 values, expected one");
  refused("x;y", "';' at character 2 means nothing");
  refused("x ? 1 : 2", "'?' at character 3 means nothing");
  refused("x & y", "'&' at character 3 means nothing");
  EXPECT_NE(flaw_of(std::string(3000, '1')).find("it has 3000 characters, more than 2000"),
            std::string::npos);
  EXPECT_NE(flaw_of("x\x01").find("a character at character 2 means nothing"), std::string::npos);
}

/// Words of expressions in any order, and any characters between them.
std::string random_text(std::mt19937& random) {
  static constexpr std::array<std::string_view, 40> words{
      "x",  "y",  "z", "t",   "pi",  "sin(", "cos(", "if(", "min(", "max(", "atan2(", "abs(", "sqrt(", "(",
      ")",  "(",  ")", ",",   "+",   "-",    "*",    "/",   "^",    "<",    "<=",     "==",   "=",     "!=",
      "&&", "||", "1", "2.5", "1e3", ".",    "?",    "!",   "\"",   "'",    "0x",     "q"};
  std::string text;
  const auto length = 1 + random() % 12;
  for (std::size_t i = 0; i < length; ++i)
    if (random() % 16 == 0)
      text += static_cast<char>(random() % 256);
    else
      text += words[random() % words.size()];
  return text;
}

TEST(AnExpression, IsComputedOrRefusedInOneSentenceWhateverTheText) {
  std::mt19937 random(20240501); // NOLINT(cert-msc32-c, cert-msc51-cpp): the same texts every time
  int good = 0;
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto text = random_text(random);
    const auto flaw = flaw_of(text);
    if (flaw.empty()) {
      const Expression expression(text);
      const double value = expression.at(place, instant);
      EXPECT_TRUE(value == expression.at(place, instant) || std::isnan(value)) << text;
      ++good;
    } else {
      EXPECT_TRUE(flaw.starts_with("found ")) << flaw;
      ++refused;
    }
  }
  EXPECT_GT(good, 10);
  EXPECT_GT(refused, 500);
}

/// A sound expression with a few characters left out, doubled, exchanged or put in.
std::string spoiled_text(std::mt19937& random) {
  static constexpr std::array<std::string_view, 8> sound{"1e-4*(x-0.5)^2",
                                                         "if(x<0.5 && y>=1, 200e9*(1+x/2), 210e9)",
                                                         "-2^-x + min(x, y, z, 3)*max(1, t)",
                                                         "atan2(y, x)*180/pi - floor(10*t)/10",
                                                         "((x+y)*(z-t))/(1+abs(x*y))",
                                                         "sin(2*pi*50*t)*exp(-t/0.1)",
                                                         "sqrt(x^2+y^2+z^2) <= 1 || sign(x) == -1",
                                                         "log(1+x)*log10(2)/cosh(y)"};
  static constexpr std::string_view others = "()+-*/^,.<>=!&|0123456789exyztpi \t\"'?#{}[]";
  std::string text(sound[random() % sound.size()]);
  const auto changes = 1 + random() % 4;
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    const auto at = random() % text.size();
    switch (random() % 4) {
    case 0:
      text.erase(at, 1 + random() % 3);
      break;
    case 1:
      text.insert(at, text.substr(at, 1 + random() % 6));
      break;
    case 2:
      text[at] = others[random() % others.size()];
      break;
    default:
      text.insert(at, 1, others[random() % others.size()]);
    }
  }
  return text;
}

TEST(AnExpression, ThatIsSpoiledIsComputedOrRefusedInOneSentence) {
  std::mt19937 random(20241126); // NOLINT(cert-msc32-c, cert-msc51-cpp): the same texts every time
  int good = 0;
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto text = spoiled_text(random);
    const auto flaw = flaw_of(text);
    if (flaw.empty()) {
      const Expression expression(text);
      const double value = expression.at(place, instant);
      EXPECT_TRUE(value == expression.at(place, instant) || std::isnan(value)) << text;
      ++good;
    } else {
      EXPECT_TRUE(flaw.starts_with("found ")) << flaw;
      EXPECT_EQ(flaw.find('\n'), std::string::npos) << flaw;
      ++refused;
    }
  }
  EXPECT_GT(good, 50);
  EXPECT_GT(refused, 300);
}

TEST(AnExpression, MayBeNestedAsDeeplyAsItIsLong) {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '(') + "x" + std::string(depth, ')');
  };
  EXPECT_EQ(value_of(nested(900)), 0.25);
  EXPECT_NE(flaw_of(std::string(1900, '(')), "");
  EXPECT_NE(flaw_of(std::string(1900, ')')), "");
  EXPECT_NE(flaw_of(std::string(1900, '^')), "");
  EXPECT_NE(flaw_of(std::string(1900, '-') + "1"), "");
}

} // namespace
} // namespace rubato::expression_test
