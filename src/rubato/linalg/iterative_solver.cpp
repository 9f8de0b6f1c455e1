// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/iterative_solver.hpp"

#include "rubato/linalg/conjugate_gradients.hpp"
#include "rubato/linalg/fingerprint.hpp"
#include "rubato/linalg/pivoted_qr.hpp"
#include "rubato/linalg/ranked_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the solve that tells whether a matrix is positive definite.
constexpr double first_tolerance = 1e-6;
/// A set-up costs about as much as so many solves.
constexpr double solves_of_set_up = 3;

/// Of all frequencies, always the same.
VectorXd any_right_side(Index size) {
  std::minstd_rand random(1);
  return VectorXd::NullaryExpr(size, [&] {
    return static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
  });
}

} // namespace

struct IterativeSolver::Body {
  std::vector<int> unknowns;            ///< ascending
  std::vector<int> rows;                ///< of every row its unknown, or −1
  std::vector<int> surface;             ///< rows of its positions
  std::optional<std::uint64_t> values;  ///< checksum of those that were set up
  std::optional<CholeskyFactor> factor; ///< of a small body
  std::unique_ptr<ConjugateGradients> iteration;
  std::size_t renewals = 0;

  Index size() const { return static_cast<Index>(rows.size()); }
};

namespace {

/// Places of the unknowns of one body, node by node.
std::vector<int> rows_by_node(const std::vector<int>& unknowns, const NodalUnknowns& nodal,
                              std::vector<int>& place) {
  std::vector<int> rows;
  int node = -1;
  for (const int unknown : unknowns) {
    const int dof = nodal.dofs[static_cast<std::size_t>(unknown)];
    if (dof / nodal.components != node) {
      node = dof / nodal.components;
      rows.insert(rows.end(), static_cast<std::size_t>(nodal.components), -1);
    }
    const auto row = rows.size() - static_cast<std::size_t>(nodal.components - dof % nodal.components);
    rows[row] = unknown;
    place[static_cast<std::size_t>(unknown)] = static_cast<int>(row);
  }
  return rows;
}

std::uint64_t fingerprint_of_columns(const SparseMatrix& matrix, const std::vector<int>& unknowns) {
  std::uint64_t sum = unknowns.size();
  for (const int unknown : unknowns) {
    const auto first = static_cast<std::size_t>(matrix.outerIndexPtr()[unknown]);
    const auto entries = static_cast<std::size_t>(matrix.outerIndexPtr()[unknown + 1]) - first;
    sum = with_word(sum, fingerprint_of(std::span(matrix.valuePtr() + first, entries)));
  }
  return sum;
}

/// Whether a matrix with these columns may be positive definite.
bool has_positive_diagonal(const SparseMatrix& matrix, const std::vector<int>& unknowns) {
  return std::ranges::all_of(unknowns, [&](int unknown) {
    bool positive = false;
    for (SparseMatrix::InnerIterator entry(matrix, unknown); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        return false;
      positive = positive || (entry.row() == unknown && entry.value() > 0);
    }
    return positive;
  });
}

double mean_diagonal(const SparseMatrix& matrix, const std::vector<int>& unknowns) {
  double sum = 0;
  for (const int unknown : unknowns)
    sum += matrix.coeff(unknown, unknown);
  return sum / static_cast<double>(unknowns.size());
}

/// Of one body; columns of the matrix are its rows, as it is symmetric.
MatrixByRows rows_of_body(const SparseMatrix& matrix, const std::vector<int>& unknowns,
                          const std::vector<int>& rows, const NodalUnknowns& nodal,
                          const std::vector<int>& place) {
  MatrixByRows by_rows;
  by_rows.size = static_cast<int>(rows.size());
  by_rows.block = nodal.components;
  MatrixXd motions = MatrixXd::Zero(by_rows.size, nodal.rigid.cols());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const int unknown = rows[row];
    by_rows.entries_of_row.push_back(
        unknown < 0 ? 1 : matrix.outerIndexPtr()[unknown + 1] - matrix.outerIndexPtr()[unknown]);
    if (unknown >= 0)
      motions.row(static_cast<Index>(row)) = nodal.rigid.row(unknown);
  }
  by_rows.near_null = PivotedQr(std::move(motions)).basis(); // tell the rows of a body apart
  by_rows.row = [&matrix, &rows, &place, held = mean_diagonal(matrix, unknowns)](
                    int row, std::vector<int>& columns, std::vector<double>& values) {
    columns.clear();
    values.clear();
    if (const int unknown = rows[static_cast<std::size_t>(row)]; unknown >= 0)
      for (SparseMatrix::InnerIterator entry(matrix, unknown); entry; ++entry) {
        columns.push_back(place[static_cast<std::size_t>(entry.row())]);
        values.push_back(entry.value());
      }
    else {
      columns.push_back(row);
      values.push_back(held);
    }
  };
  return by_rows;
}

SparseMatrix part_of(const MatrixByRows& by_rows) {
  std::vector<Eigen::Triplet<double, int>> entries;
  std::vector<int> columns;
  std::vector<double> values;
  for (int row = 0; row < by_rows.size; ++row) {
    by_rows.row(row, columns, values);
    for (std::size_t i = 0; i < columns.size(); ++i)
      entries.emplace_back(row, columns[i], values[i]);
  }
  SparseMatrix part(by_rows.size, by_rows.size);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

NotSolved not_solved(const ConjugateGradients::Outcome& outcome, double tolerance) {
  if (outcome.ending == ConjugateGradients::Ending::indefinite)
    return {"conjugate gradients met a direction in which the matrix is not positive definite", outcome.left,
            tolerance};
  return {
      fmt::format("conjugate gradients left {:.1e} of the right side after {} iterations (allowed: {:.0e})",
                  outcome.left, outcome.iterations, tolerance),
      outcome.left, tolerance};
}

} // namespace

std::size_t iterative_bytes(const SparseMatrix& matrix) {
  constexpr std::size_t vectors = 40; // of iterations, grids and rigid motions
  constexpr std::size_t copies = 3;   // rows and, while grids are built, two of coarser ones and of graphs
  constexpr std::size_t of_entry = sizeof(double) + sizeof(int);
  return copies * of_entry * static_cast<std::size_t>(matrix.nonZeros()) +
         vectors * sizeof(double) * static_cast<std::size_t>(matrix.cols());
}

IterativeSolver::~IterativeSolver() = default;

IterativeSolver::IterativeSolver(const SparseMatrix& matrix, std::span<const int> surface,
                                 NodalUnknowns unknowns, const IterativeSettings& settings)
    : unknowns_(std::move(unknowns)), settings_(settings),
      place_(static_cast<std::size_t>(matrix.cols()), -1), pattern_(pattern_of(matrix)),
      bytes_(iterative_bytes(matrix)) {
  int body_count = 0;
  const auto body_of = bodies_of(matrix, body_count);
  bodies_.resize(static_cast<std::size_t>(body_count));
  for (std::size_t unknown = 0; unknown < body_of.size(); ++unknown)
    bodies_[static_cast<std::size_t>(body_of[unknown])].unknowns.push_back(static_cast<int>(unknown));
  for (auto& body : bodies_)
    body.rows = rows_by_node(body.unknowns, unknowns_, place_);
  number_surface(surface, body_of);
}

void IterativeSolver::number_surface(std::span<const int> surface, const std::vector<int>& body_of) {
  auto found = surface_of_bodies(surface, body_of, static_cast<int>(bodies_.size()));
  surface_ = std::move(found.unknowns);
  body_starts_ = std::move(found.starts);
  for (const int unknown : surface_)
    bodies_[static_cast<std::size_t>(body_of[static_cast<std::size_t>(unknown)])].surface.push_back(
        place_[static_cast<std::size_t>(unknown)]);
}

std::unique_ptr<IterativeSolver> IterativeSolver::of(const SparseMatrix& matrix, std::span<const int> surface,
                                                     NodalUnknowns unknowns,
                                                     const std::function<void(std::size_t)>& tell,
                                                     const IterativeSettings& settings) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("IterativeSolver::of wants a square matrix.");
  if (static_cast<Index>(unknowns.dofs.size()) != matrix.cols() || unknowns.rigid.rows() != matrix.cols())
    throw std::invalid_argument("IterativeSolver::of wants a dof and rigid motions of every unknown.");
  make_conjugate_gradients(!settings.ranks.is_alone()); // refuses before anything takes memory
  const auto whole = whole_of(matrix, settings.ranks);
  tell(iterative_bytes(whole));
  std::unique_ptr<IterativeSolver> solver(
      new IterativeSolver(whole, surface, std::move(unknowns), settings)); // its constructor is private
  return solver->set_up_all(whole) ? std::move(solver) : nullptr;
}

bool IterativeSolver::refactor(const SparseMatrix& matrix) {
  auto whole = whole_of(matrix, settings_.ranks);
  if (whole.rows() != static_cast<Index>(place_.size()) || pattern_of(whole) != pattern_)
    throw std::invalid_argument("IterativeSolver::refactor wants a matrix of the first one's pattern.");
  whole.makeCompressed();
  return set_up_all(whole);
}

bool IterativeSolver::set_up_all(const SparseMatrix& whole) {
  has_values_ = false;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (!set_up(whole, b))
      return false;
  has_values_ = true;
  return true;
}

/// False when the matrix of a body is not positive definite.
bool IterativeSolver::set_up(const SparseMatrix& matrix, std::size_t b) {
  auto& body = bodies_[b];
  const auto wanted = fingerprint_of_columns(matrix, body.unknowns);
  if (body.values == wanted)
    return true;
  ++body.renewals;
  body.values.reset();
  if (!has_positive_diagonal(matrix, body.unknowns))
    return false;
  const auto rows = rows_of_body(matrix, body.unknowns, body.rows, unknowns_, place_);
  if (body.size() <= settings_.largest_factored) {
    body.factor = CholeskyFactor::of(part_of(rows));
    if (!body.factor)
      return false;
  } else {
    if (!body.iteration)
      body.iteration = make_conjugate_gradients(!settings_.ranks.is_alone());
    body.iteration->set(rows);
    VectorXd unused(body.size());
    const auto outcome = body.iteration->solve(any_right_side(body.size()), unused, first_tolerance,
                                               settings_.most_iterations);
    if (outcome.ending == ConjugateGradients::Ending::indefinite)
      return false;
    if (outcome.ending != ConjugateGradients::Ending::solved)
      throw not_solved(outcome, first_tolerance);
  }
  body.values = wanted;
  return true;
}

std::size_t IterativeSolver::renewals(std::size_t body) const {
  return bodies_[body].renewals;
}

void IterativeSolver::must_have_values() const {
  if (!has_values_)
    throw std::logic_error("IterativeSolver has no values: the last matrix could not be set up.");
}

/// Of one body, by its rows.
VectorXd IterativeSolver::solved(std::size_t b, const VectorXd& right_side, double tolerance) const {
  must_have_values();
  const auto& body = bodies_[b];
  if (right_side.isZero(0))
    return VectorXd::Zero(right_side.size());
  if (body.factor)
    return body.factor->solve(right_side);
  VectorXd solution(right_side.size());
  const auto outcome = body.iteration->solve(right_side, solution, tolerance, settings_.most_iterations);
  ++count_.solves;
  count_.iterations += static_cast<std::size_t>(outcome.iterations);
  if (outcome.ending != ConjugateGradients::Ending::solved)
    throw not_solved(outcome, tolerance);
  return solution;
}

VectorXd IterativeSolver::solve(const VectorXd& right_side) const {
  must_have_values();
  if (right_side.size() != static_cast<Index>(place_.size()))
    throw std::invalid_argument("IterativeSolver wants a right side of the matrix's size.");
  VectorXd solution(right_side.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto& body = bodies_[b];
    VectorXd of_body = VectorXd::Zero(body.size());
    for (const int unknown : body.unknowns)
      of_body[place_[static_cast<std::size_t>(unknown)]] = right_side[unknown];
    const auto found = solved(b, of_body, settings_.tolerance);
    for (const int unknown : body.unknowns)
      solution[unknown] = found[place_[static_cast<std::size_t>(unknown)]];
  }
  return solution;
}

void IterativeSolver::load_surface(const VectorXd& force, VectorXd& half_way) const {
  must_have_values();
  if (force.isZero(0))
    return;
  VectorXd right_side = VectorXd::Zero(half_way.size());
  for (std::size_t i = 0; i < surface_.size(); ++i)
    right_side[surface_[i]] = force[static_cast<Index>(i)];
  half_way += solve(right_side);
}

VectorXd IterativeSolver::on_surface(std::size_t body, const VectorXd& solution) const {
  return solution(bodies_[body].surface);
}

MatrixXd IterativeSolver::compliance(std::size_t body) const {
  return compliance(body, 0, static_cast<Index>(bodies_[body].surface.size()));
}

MatrixXd IterativeSolver::compliance(std::size_t body, Index first, Index count) const {
  const auto& surface = bodies_[body].surface;
  MatrixXd columns(static_cast<Index>(surface.size()), count);
  for (Index i = 0; i < count; ++i)
    columns.col(i) = moved_by(body, VectorXd::Unit(columns.rows(), first + i));
  return columns;
}

VectorXd IterativeSolver::moved_by(std::size_t body, const VectorXd& force) const {
  const auto& surface = bodies_[body].surface;
  VectorXd right_side = VectorXd::Zero(bodies_[body].size());
  for (std::size_t i = 0; i < surface.size(); ++i)
    right_side[surface[i]] = force[static_cast<Index>(i)];
  return on_surface(body, solved(body, right_side, settings_.tolerance));
}

/// In the terms of a factor: a solve multiplies by each of its numbers twice, and dense work on it runs eight
/// times as fast.
double IterativeSolver::factor_flops() const {
  constexpr double dense_speed = 8;
  const auto numbers = static_cast<double>(bytes_) / sizeof(double);
  return solves_of_set_up * dense_speed * 4 * numbers;
}

} // namespace rubato::linalg
