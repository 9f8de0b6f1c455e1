// SPDX-License-Identifier: LGPL-3.0-or-later
// The words of an expression are checked here, its grammar by muParser, which computes its values, too.
#include "rubato/core/expression.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <muParserBase.h>
#include <mutex>
#include <numbers>
#include <optional>
#include <vector>

namespace rubato {
namespace {

constexpr std::size_t most_characters = 2000;
constexpr std::string_view variables = "xyzt";
constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
constexpr std::string_view digits = "0123456789";

// ---- functions

double sign(double value) {
  return std::isnan(value) ? value : static_cast<double>((value > 0) - (value < 0));
}

double choose(double condition, double value, double other) {
  return condition != 0 ? value : other;
}

/// The first in the order of `before`; what is not a number goes through.
template <class Before> double first_of(const double* values, int count, const Before& before) {
  double first = values[0];
  for (int i = 1; i < count; ++i)
    if (std::isnan(values[i]) || before(values[i], first))
      first = values[i];
  return first;
}

double least(const double* values, int count) {
  return first_of(values, count, std::less<>());
}

double greatest(const double* values, int count) {
  return first_of(values, count, std::greater<>());
}

template <class Pointer> struct NamedFunction {
  const char* name;
  Pointer call;
};
constexpr std::array<NamedFunction<double (*)(double)>, 17> of_one{{{"sin", std::sin},
                                                                    {"cos", std::cos},
                                                                    {"tan", std::tan},
                                                                    {"asin", std::asin},
                                                                    {"acos", std::acos},
                                                                    {"atan", std::atan},
                                                                    {"sinh", std::sinh},
                                                                    {"cosh", std::cosh},
                                                                    {"tanh", std::tanh},
                                                                    {"exp", std::exp},
                                                                    {"log", std::log},
                                                                    {"log10", std::log10},
                                                                    {"sqrt", std::sqrt},
                                                                    {"abs", std::fabs},
                                                                    {"floor", std::floor},
                                                                    {"ceil", std::ceil},
                                                                    {"sign", sign}}};
constexpr std::array<NamedFunction<double (*)(double, double)>, 1> of_two{{{"atan2", std::atan2}}};
constexpr std::array<NamedFunction<double (*)(double, double, double)>, 1> of_three{{{"if", choose}}};
constexpr std::array<NamedFunction<double (*)(const double*, int)>, 2> of_any{
    {{"min", least}, {"max", greatest}}};
constexpr const char* circle_constant = "pi";

template <class Visit> void for_each_function(const Visit& visit) {
  for (const auto& function : of_one)
    visit(function);
  for (const auto& function : of_two)
    visit(function);
  for (const auto& function : of_three)
    visit(function);
  for (const auto& function : of_any)
    visit(function);
}

bool is_function(std::string_view name) {
  bool found = false;
  for_each_function([&](const auto& function) { found = found || function.name == name; });
  return found;
}

bool is_variable(std::string_view name) {
  return name.size() == 1 && variables.find(name.front()) != std::string_view::npos;
}

/// Names as short as most of ours are near to some of them whatever is meant.
constexpr std::size_t telling_length = 4;

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const char variable : variables)
    names.emplace_back(1, variable);
  names.emplace_back(circle_constant);
  for_each_function([&](const auto& function) { names.emplace_back(function.name); });
  return names;
}

/// "; did you mean 'sin'?", or every name.
std::string meant_by(const std::string& name) {
  const auto names = known_names();
  return name.size() < telling_length ? fmt::format("; expected one of {}", fmt::join(names, ", "))
                                      : suggestion(name, names);
}

// ---- words

struct Number {
  double value;
  std::size_t length;
};

/// The number at the beginning of a text; nothing when there is none, or one that is too large or too small.
std::optional<Number> number_at(std::string_view text) {
  if (text.empty() || (digits.find(text.front()) == std::string_view::npos && text.front() != '.'))
    return std::nullopt;
  Number number{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  if (error != std::errc{})
    return std::nullopt;
  number.length = static_cast<std::size_t>(stop - text.data());
  return number;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(
      fmt::format("found {}, expected a number or an expression of x, y, z and t: {}", shown(text), why));
}

/// Reads what stands in an expression, word by word, and refuses what may not.
class Words {
public:
  explicit Words(const std::string& text) : text_(text) {}

  /// The variables that are named.
  std::string check() {
    if (text_.size() > most_characters)
      stop(fmt::format("it has {} characters, more than {}", text_.size(), most_characters));
    while (skip_blanks(), at_ < text_.size())
      take_word();
    if (words_ == 0)
      stop("it is empty");
    return used_;
  }

private:
  [[noreturn]] void stop(const std::string& why) const { refuse(text_, why); }
  std::string here() const { return fmt::format("at character {}", at_ + 1); }
  std::string_view rest() const { return std::string_view(text_).substr(at_); }
  bool is_any_of(std::string_view characters) const {
    return at_ < text_.size() && characters.find(text_[at_]) != std::string_view::npos;
  }
  void skip_blanks() {
    while (is_any_of(" \t\n\r"))
      ++at_;
  }

  void take_word() {
    ++words_;
    if (is_any_of(digits) || is_any_of("."))
      take_number();
    else if (is_any_of(letters))
      take_name();
    else
      take_sign();
  }

  void take_number() {
    const auto number = number_at(rest());
    if (!number)
      stop(fmt::format("no number, or one that is out of range, begins {}", here()));
    at_ += number->length;
    if (is_any_of(letters) || is_any_of(digits) || is_any_of("."))
      stop(fmt::format("a number is followed by '{}' {}, expected an operator", text_[at_], here()));
  }

  void take_name() {
    const auto end = rest().find_first_not_of(std::string(letters) + std::string(digits));
    const std::string name(rest().substr(0, end));
    const bool function = is_function(name);
    if (!function && !is_variable(name) && name != circle_constant)
      stop(fmt::format("unknown name {} {}{}", shown(name), here(), meant_by(name)));
    if (is_variable(name))
      used_ += name;
    at_ += name.size();
    skip_blanks();
    if (function && !is_any_of("("))
      stop(fmt::format("{} is a function, expected '(' after it {}", shown(name), here()));
    if (!function && is_any_of("("))
      stop(fmt::format("{} is no function, but '(' follows it {}", shown(name), here()));
  }

  void take_sign() {
    for (const std::string_view pair : {"<=", ">=", "==", "!=", "&&", "||"})
      if (rest().starts_with(pair)) {
        at_ += pair.size();
        return;
      }
    if (is_any_of("="))
      stop(fmt::format("'=' {} would assign, expected '==', which compares", here()));
    if (is_any_of("\"'"))
      stop(fmt::format("text begins {}, expected numbers only", here()));
    if (!is_any_of("+-*/^(),<>"))
      stop(fmt::format("{} {} means nothing", character(), here()));
    ++at_;
  }

  std::string character() const {
    const auto code = static_cast<unsigned char>(text_[at_]);
    const bool printable = code > 32 && code < 127;
    return printable ? fmt::format("'{}'", text_[at_]) : "a character";
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::size_t words_ = 0;
  std::string used_;
};

// ---- grammar

double negative(double value) {
  return -value;
}

double itself(double value) {
  return value;
}

int read_number(const char* text, int* position, double* value) {
  const auto number = number_at(text);
  if (!number)
    return 0;
  *position += static_cast<int>(number->length);
  *value = number->value;
  return 1;
}

/// muParser with our words and none of its own.
class Grammar final : public mu::ParserBase {
public:
  Grammar() {
    AddValIdent(read_number);
    InitCharSets();
    InitFun();
    InitConst();
    InitOprt();
    EnableOptimizer(false);
  }

private:
  void InitCharSets() override {
    DefineNameChars((std::string(digits) + std::string(letters)).c_str());
    DefineOprtChars("+-*/^<>=!&|");
    DefineInfixOprtChars("+-");
  }
  void InitFun() override {
    for_each_function([&](const auto& function) { DefineFun(function.name, function.call); });
  }
  void InitConst() override { DefineConst(circle_constant, std::numbers::pi); }
  void InitOprt() override {
    DefineInfixOprt("-", negative);
    DefineInfixOprt("+", itself);
  }
};

/// " at character 3"; of some words muParser tells where they end, of some nothing that helps.
std::string place_of(const std::string& token, int position, const std::string& text) {
  for (const auto begin : {position, position - static_cast<int>(token.size())})
    if (begin >= 0 && begin < static_cast<int>(text.size()) &&
        text.compare(static_cast<std::size_t>(begin), token.size(), token) == 0)
      return fmt::format(" at character {}", begin + 1);
  return {};
}

std::string grammar_fault(const mu::ParserError& error, const std::string& text) {
  const auto& token = error.GetToken();
  switch (error.GetCode()) {
  case mu::ecUNEXPECTED_EOF:
    return "it ends where a value is expected";
  case mu::ecMISSING_PARENS:
    return "a closing bracket is missing";
  case mu::ecTOO_MANY_PARAMS:
    return fmt::format("too many arguments of {}", shown(token));
  case mu::ecTOO_FEW_PARAMS:
    return fmt::format("too few arguments of {}", shown(token));
  default:
    return token.empty()
               ? "its brackets and commas do not fit"
               : fmt::format("{}{} is out of place", shown(token), place_of(token, error.GetPos(), text));
  }
}

} // namespace

class Expression::Parsed {
public:
  explicit Parsed(std::string text) : text_(std::move(text)), used_(Words(text_).check()) {
    try {
      for (std::size_t i = 0; i < variables.size(); ++i)
        grammar_.DefineVar(std::string(1, variables[i]), &arguments_[i]);
      grammar_.SetExpr(text_);
      grammar_.Eval();
      if (grammar_.GetNumResults() != 1)
        refuse(text_, fmt::format("it has {} values, expected one", grammar_.GetNumResults()));
    } catch (const mu::ParserError& error) {
      refuse(text_, grammar_fault(error, text_));
    }
  }
  Parsed(const Parsed&) = delete; // the grammar knows where the arguments are
  Parsed& operator=(const Parsed&) = delete;

  const std::string& text() const { return text_; }
  bool has(char variable) const { return used_.find(variable) != std::string::npos; }

  double at(std::span<const double, 3> place, double t) const {
    const std::scoped_lock lock(turn_);
    arguments_ = {place[0], place[1], place[2], t};
    return grammar_.Eval();
  }

private:
  std::string text_;
  std::string used_;
  mutable std::mutex turn_;
  mutable std::array<double, variables.size()> arguments_{};
  Grammar grammar_;
};

Expression::Expression(std::string text) : parsed_(std::make_shared<const Parsed>(std::move(text))) {}

const std::string& Expression::text() const {
  return parsed_->text();
}

bool Expression::has(char variable) const {
  return parsed_->has(variable);
}

double Expression::at(std::span<const double, 3> place, double t) const {
  return parsed_->at(place, t);
}

} // namespace rubato
