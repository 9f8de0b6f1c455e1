// SPDX-License-Identifier: LGPL-3.0-or-later
// Functions of time, and tables along an axis.
#include "rubato/core/error.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {
namespace {

/// In all functions together: an echo of more would be no deck that can be read.
constexpr std::size_t most_instants = 80'000;
constexpr std::size_t most_factors = 100;

void check(Rules& rules, const LinearTable& table, const std::string& path) {
  rules.table(table, path, "times");
}

void check(Rules& rules, const Ramp& ramp, const std::string& path) {
  const auto below = path + ".ramp";
  for (const auto& [key, number] :
       {std::pair{"begin", ramp.begin}, {"end", ramp.end}, {"from", ramp.from}, {"to", ramp.to}})
    rules.number(fmt::format("{}.{}", below, key), number);
  if (!(ramp.end > ramp.begin))
    rules.broken({below, below + ".begin", below + ".end"},
                 fmt::format("found the end {} of a ramp that begins at {}, expected a later instant",
                             ramp.end, ramp.begin));
}

void check(Rules& rules, const Sine& sine, const std::string& path) {
  const auto below = path + ".sine";
  rules.number(below + ".frequency", sine.frequency, bounds::frequency);
  rules.number(below + ".amplitude", sine.amplitude);
  rules.number(below + ".phase", sine.phase);
  rules.number(below + ".mean", sine.mean);
}

void check(Rules& rules, const Expression& expression, const std::string& path) {
  const auto below = path + ".expression";
  for (const char variable : {'x', 'y', 'z'})
    if (expression.has(variable))
      return rules.broken({below}, fmt::format("found {} in {}, a function of time has t only", variable,
                                               shown(expression.text())));
  try {
    for (const double t : {rules.study.time.begin, rules.study.time.end})
      value_at(Function(expression), t);
  } catch (const InputError& error) {
    rules.broken({below, "time.begin", "time.end", "time.instants"}, error.faults().front().text);
  }
}

void check(Rules& rules, const Integral& /*integral*/, const std::string& path) {
  rules.broken({path}, "found an integral, which a study has by 'velocity' and 'acceleration' only");
}

void check(Rules& rules, const Product& product, const std::string& path);

void check_function(Rules& rules, const Function& function, const std::string& path) {
  std::visit([&](const auto& kind) { check(rules, kind, path); }, function.is);
}

void check(Rules& rules, const Product& product, const std::string& path) {
  const auto below = path + ".product";
  if (product.factors.empty() || product.factors.size() > most_factors)
    rules.broken({below},
                 fmt::format("found {} factors, expected 1 to {}", product.factors.size(), most_factors));
  for (std::size_t i = 0; i < product.factors.size(); ++i) {
    const auto& factor = product.factors[i];
    const auto at = fmt::format("{}.{}", below, i);
    if (std::holds_alternative<Product>(factor.is))
      rules.broken({at}, "found a product in a product, expected its factors");
    else if (std::ranges::none_of(rules.study.functions,
                                  [&](const auto& named) { return named.second == factor; }))
      check_function(rules, factor, at);
  }
}

} // namespace

void Rules::table(const LinearTable& table, const std::string& path, const std::string& key) {
  const auto abscissae = path + "." + key;
  ascending(abscissae, table.at);
  numbers(path + ".values", table.values);
  if (table.at.empty())
    broken({abscissae}, "found an empty list, expected at least one number");
  if (table.values.size() != table.at.size())
    broken({path + ".values", abscissae},
           fmt::format("found {} values for {} {}", table.values.size(), table.at.size(), key));
  if (table.outside == LinearTable::Outside::linear && table.at.size() == 1)
    broken({path + ".outside", abscissae},
           "found 'linear' for one instant, expected at least two to go on from");
}

void check_functions(Rules& rules) {
  std::size_t instants = 0;
  for (const auto& [name, function] : rules.study.functions) {
    check_function(rules, function, "functions." + name);
    instants += table_size(function);
  }
  if (instants > most_instants)
    rules.broken({"functions"}, fmt::format("found {} instants in all tables, expected at most {}", instants,
                                            most_instants));
}

} // namespace rubato::study
