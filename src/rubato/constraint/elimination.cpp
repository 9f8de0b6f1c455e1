// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/constraint/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace rubato::constraint {
namespace {

/// What is left of a coefficient below this part of what was summed is rounding.
constexpr double rounding = 1e-11;
/// The first dof of an equation is solved for where it has at least this part of the largest coefficient.
constexpr double large_enough = 0.1;
/// Right sides that differ by less than this part of what was summed are the same.
constexpr double same = 1e-9;

/// A sum and what was summed for it.
struct Sum {
  double value = 0;
  double magnitude = 0;
  void add(double part) {
    value += part;
    magnitude += std::abs(part);
  }
  bool is_zero() const { return std::abs(value) <= rounding * magnitude; }
};

using Sums = std::map<int, Sum>;

/// Σ free · u + Σ prescribed · u − Σ given · right side = 0
struct Row {
  Sums free;
  Sums prescribed;
  Sums given;
};

void add(double factor, const std::vector<Term>& terms, Sums& sums) {
  for (const auto& term : terms)
    sums[term.dof].add(factor * term.coefficient);
}

std::vector<Term> terms_of(const Sums& sums, double factor) {
  std::vector<Term> terms;
  for (const auto& [dof, sum] : sums)
    if (!sum.is_zero())
      terms.push_back({dof, factor * sum.value});
  return terms;
}

class Eliminator {
public:
  Eliminator(std::span<const PrescribedDof> prescribed, std::span<const Equation> equations,
             std::span<const double> instants)
      : prescribed_(prescribed), equations_(equations), instants_(instants) {}

  void take(int number) {
    const auto row = row_of(number);
    if (const auto pivot = pivot_of(row, first_dof(number)); pivot >= 0)
      solve_for(pivot, row);
    else
      judge(number, row);
  }

  Elimination result() && {
    for (auto& [dof, dependent] : dependents_) {
      std::erase_if(dependent.given,
                    [&](const Term& term) { return is_zero(value_of(term)) && !has_multiplier(term); });
      result_.dependents.push_back(std::move(dependent));
    }
    std::ranges::sort(result_.dependents, {}, &DependentDof::dof);
    return std::move(result_);
  }

private:
  const PrescribedDof* support_of(int dof) const {
    const auto at = std::ranges::lower_bound(prescribed_, dof, {}, &PrescribedDof::dof);
    return at != prescribed_.end() && at->dof == dof ? &*at : nullptr;
  }

  /// The right side that a term counts.
  const ImposedValue& value_of(const Term& term) const {
    return equations_[static_cast<std::size_t>(term.dof)].value;
  }
  bool has_multiplier(const Term& term) const {
    return equations_[static_cast<std::size_t>(term.dof)].has_multiplier;
  }
  static bool is_zero(const ImposedValue& value) {
    return value.value == 0 && !value.field && !value.rotation;
  }

  /// The equation with dependent dofs replaced.
  Row row_of(int number) const {
    Row row;
    row.given[number].add(1);
    for (const auto& term : equations_[static_cast<std::size_t>(number)].terms) {
      if (const auto known = dependents_.find(term.dof); known != dependents_.end()) {
        add(term.coefficient, known->second.of, row.free);
        add(term.coefficient, known->second.prescribed, row.prescribed);
        add(-term.coefficient, known->second.given, row.given);
      } else {
        (support_of(term.dof) != nullptr ? row.prescribed : row.free)[term.dof].add(term.coefficient);
      }
    }
    return row;
  }

  int first_dof(int number) const {
    const auto& terms = equations_[static_cast<std::size_t>(number)].terms;
    return terms.empty() ? -1 : terms.front().dof;
  }

  /// −1 where none is left.
  static int pivot_of(const Row& row, int wanted) {
    int pivot = -1;
    double largest = 0;
    for (const auto& [dof, sum] : row.free)
      if (!sum.is_zero() && std::abs(sum.value) > largest) {
        pivot = dof;
        largest = std::abs(sum.value);
      }
    const auto first = row.free.find(wanted);
    const bool serves = first != row.free.end() && !first->second.is_zero() &&
                        std::abs(first->second.value) >= large_enough * largest;
    return serves ? wanted : pivot;
  }

  void solve_for(int pivot, const Row& row) {
    const double factor = 1 / row.free.at(pivot).value;
    DependentDof dependent{pivot, {}, terms_of(row.prescribed, -factor), terms_of(row.given, factor)};
    for (const auto& term : terms_of(row.free, -factor))
      if (term.dof != pivot)
        dependent.of.push_back(term);
    replace(dependent);
    for (const auto& term : dependent.of)
      users_[term.dof].insert(pivot);
    dependents_.emplace(pivot, std::move(dependent));
  }

  /// In the dofs that depend on it so far.
  void replace(const DependentDof& by) {
    const auto users = users_.find(by.dof);
    if (users == users_.end())
      return;
    for (const int dof : users->second) {
      auto& user = dependents_.at(dof);
      const auto at = std::ranges::find(user.of, by.dof, &Term::dof);
      if (at == user.of.end())
        continue;
      const double coefficient = at->coefficient;
      user.of.erase(at);
      add_to(user.of, coefficient, by.of);
      add_to(user.prescribed, coefficient, by.prescribed);
      add_to(user.given, coefficient, by.given);
      for (const auto& term : by.of)
        users_[term.dof].insert(dof);
    }
    users_.erase(by.dof);
  }

  static void add_to(std::vector<Term>& terms, double factor, const std::vector<Term>& more) {
    Sums sums;
    add(1, terms, sums);
    add(factor, more, sums);
    terms = terms_of(sums, 1);
  }

  void judge(int number, const Row& row) {
    Contradiction found;
    found.equation = number;
    bool contradicts = false;
    for (const double t : instants_) {
      Sum sum;
      for (const auto& term : terms_of(row.prescribed, 1))
        sum.add(term.coefficient * displacement_of(*support_of(term.dof), t));
      for (const auto& term : terms_of(row.given, -1))
        sum.add(term.coefficient * value_at(value_of(term), t));
      if (std::abs(sum.value) <= same * sum.magnitude || std::abs(sum.value) <= std::abs(found.excess))
        continue;
      contradicts = true;
      found.excess = sum.value;
      found.at = t;
    }
    if (!contradicts)
      return result_.redundant.push_back(number);
    for (const auto& term : terms_of(row.given, 1))
      if (term.dof != number)
        found.others.push_back(term.dof);
    for (const auto& term : terms_of(row.prescribed, 1))
      found.dofs.push_back(term.dof);
    result_.contradictions.push_back(std::move(found));
  }

  std::span<const PrescribedDof> prescribed_;
  std::span<const Equation> equations_;
  std::span<const double> instants_;
  std::unordered_map<int, DependentDof> dependents_;
  std::unordered_map<int, std::set<int>> users_; ///< of a free dof: what depends on it
  Elimination result_;
};

} // namespace

Elimination eliminate(std::span<const PrescribedDof> prescribed, std::span<const Equation> equations,
                      std::span<const double> instants) {
  Eliminator eliminator(prescribed, equations, instants);
  for (std::size_t i = 0; i < equations.size(); ++i)
    eliminator.take(static_cast<int>(i));
  return std::move(eliminator).result();
}

} // namespace rubato::constraint
