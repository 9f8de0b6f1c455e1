// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/shared_multipliers.hpp"

#include "rubato/core/tolerances.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/linalg/sparse_products.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of multipliers while they are numbered.
constexpr int no_point = -1;
constexpr int is_unknown = -2;

template <class Entry> bool same(const Entry& a, const Entry& b) {
  return a.row() == b.row() && a.col() == b.col() && a.value() == b.value();
}

} // namespace

void SharedMultipliers::clear() {
  for (auto* entries : {&pressed_, &open_}) {
    entries->matrix.clear();
    entries->right.clear();
  }
  std::ranges::fill(numbers_, no_point);
  unknowns_.clear();
  others_.clear();
  seen_.clear();
}

void SharedMultipliers::forget() {
  clear();
  eliminated_ = {};
}

void SharedMultipliers::add_pressed(std::span<const MultiplierShare> shares,
                                    const contact::PointEquations& equations) {
  add(shares, equations, pressed_);
}

void SharedMultipliers::add_open(std::span<const MultiplierShare> shares,
                                 const contact::PointEquations& equations) {
  add(shares, equations, open_);
}

void SharedMultipliers::add(std::span<const MultiplierShare> shares, const contact::PointEquations& equations,
                            Entries& entries) {
  const auto count = static_cast<int>(equations.values.size());
  for (const auto& share : shares)
    for (int a = 0; a < count; ++a) {
      entries.right.emplace_back(share.first + a, share.shape * equations.values[a]);
      for (const auto& other : shares)
        for (int b = 0; b < count; ++b)
          if (const double value = share.shape * other.shape * equations.by_multiplier(a, b); value != 0)
            entries.matrix.emplace_back(share.first + a, other.first + b, value);
    }
}

void SharedMultipliers::mark(const Entries& entries, int as) {
  for (const auto& [multiplier, value] : entries.right) {
    if (static_cast<std::size_t>(multiplier) >= numbers_.size())
      numbers_.resize(static_cast<std::size_t>(multiplier) + 1, no_point);
    if (auto& number = numbers_[static_cast<std::size_t>(multiplier)]; number != is_unknown)
      number = as;
  }
}

bool SharedMultipliers::number() {
  mark(pressed_, is_unknown);
  mark(open_, first_other);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    auto& number = numbers_[i];
    if (number == no_point)
      continue;
    auto& list = number == is_unknown ? unknowns_ : others_;
    const auto place = static_cast<int>(list.size());
    number = number == is_unknown ? place : first_other - place;
    list.push_back(static_cast<int>(i));
  }
  if (others_.empty())
    return true;
  if (!eliminate())
    return false;
  VectorXd right = VectorXd::Zero(static_cast<Index>(others_.size()));
  for (const auto& [multiplier, value] : open_.right)
    if (is_eliminated(multiplier))
      right[other_of(multiplier)] -= value;
  free_ = eliminated_.factor->solve(right);
  return free_.allFinite();
}

/// What open points that stay so say is the same in each iteration.
bool SharedMultipliers::eliminate() {
  auto& e = eliminated_;
  if (e.unknowns == unknowns_ && std::ranges::equal(e.entries, open_.matrix, &same<Entry>))
    return e.factor.has_value();
  e = {open_.matrix, unknowns_, {}, {}, {}, {}};
  std::vector<Entry> own, to_unknowns, by_unknowns;
  for (const auto& entry : open_.matrix) {
    const bool row = is_eliminated(entry.row());
    const bool column = is_eliminated(entry.col());
    if (row && column)
      own.emplace_back(other_of(entry.row()), other_of(entry.col()), entry.value());
    else if (row)
      by_unknowns.emplace_back(other_of(entry.row()), unknown_of(entry.col()), entry.value());
    else if (column)
      to_unknowns.emplace_back(unknown_of(entry.row()), other_of(entry.col()), entry.value());
  }
  const auto count = static_cast<int>(others_.size());
  linalg::SparseMatrix matrix(count, count);
  matrix.setFromTriplets(own.begin(), own.end());
  e.to_unknowns.resize(size(), count);
  e.to_unknowns.setFromTriplets(to_unknowns.begin(), to_unknowns.end());
  e.factor = linalg::LuFactor::of(matrix, linalg::GeneralEngine::umfpack);
  if (!e.factor)
    return false;
  linalg::SparseMatrix coupling(count, size());
  coupling.setFromTriplets(by_unknowns.begin(), by_unknowns.end());
  for (int unknown = 0; unknown < coupling.cols(); ++unknown)
    if (coupling.col(unknown).nonZeros() > 0)
      e.neighbours.push_back(unknown);
  e.by_neighbour.resize(count, static_cast<Index>(e.neighbours.size()));
  for (std::size_t k = 0; k < e.neighbours.size(); ++k)
    e.by_neighbour.col(static_cast<Index>(k)) =
        e.factor->solve(VectorXd(linalg::dense_columns(coupling, e.neighbours[k], 1).col(0)));
  return true;
}

void SharedMultipliers::assemble(Index places) {
  by_unknown_.setZero(size(), size());
  right_.setZero(size());
  for (const auto* entries : {&pressed_, &open_}) {
    for (const auto& entry : entries->matrix)
      if (!is_eliminated(entry.row()) && !is_eliminated(entry.col()))
        by_unknown_(unknown_of(entry.row()), unknown_of(entry.col())) += entry.value();
    for (const auto& [multiplier, value] : entries->right)
      if (!is_eliminated(multiplier))
        right_[unknown_of(multiplier)] -= value;
  }
  if (!others_.empty()) {
    const auto& e = eliminated_;
    const MatrixXd taken = linalg::product(e.to_unknowns, e.by_neighbour);
    for (std::size_t k = 0; k < e.neighbours.size(); ++k)
      for (Index row = 0; row < size(); ++row)
        by_unknown_(row, e.neighbours[k]) -= taken(row, static_cast<Index>(k));
    right_ -= linalg::product(e.to_unknowns, free_);
  }
  by_place_.resize(size(), places);
  by_place_.setFromTriplets(seen_.begin(), seen_.end());
  fix_unconstrained();
}

void SharedMultipliers::fix_unconstrained() {
  double largest = 0;
  for (Index k = 0; k < by_place_.nonZeros(); ++k)
    largest = std::max(largest, std::abs(by_place_.valuePtr()[k]));
  for (Index row = 0; row < size(); ++row) {
    double of_row = 0;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor, int>::InnerIterator it(by_place_, row); it; ++it)
      of_row = std::max(of_row, std::abs(it.value()));
    for (Index k = 0; k < size() && of_row <= tolerances.empty_row * largest; ++k)
      if (by_unknown_(row, k) != 0)
        of_row = std::numeric_limits<double>::infinity();
    if (of_row > tolerances.empty_row * largest)
      continue;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor, int>::InnerIterator it(by_place_, row); it; ++it)
      it.valueRef() = 0;
    by_unknown_(row, row) = 1;
    right_[row] = 0;
  }
}

void SharedMultipliers::add_seen(double factor, const double* moved, double* sum) const {
  for (Index row = 0; row < size(); ++row) {
    double seen = 0;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor, int>::InnerIterator it(by_place_, row); it; ++it)
      seen += it.value() * moved[it.col()];
    sum[row] += factor * seen;
  }
}

VectorXd SharedMultipliers::change_of_others(const VectorXd& change) const {
  if (others_.empty())
    return {};
  VectorXd of_neighbours(static_cast<Index>(eliminated_.neighbours.size()));
  for (Index k = 0; k < of_neighbours.size(); ++k)
    of_neighbours[k] = change[eliminated_.neighbours[static_cast<std::size_t>(k)]];
  return free_ - linalg::product(eliminated_.by_neighbour, of_neighbours);
}

} // namespace rubato::step
