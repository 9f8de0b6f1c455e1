// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/linear_step.hpp"

#include "rubato/linalg/dense_lu.hpp"
#include "rubato/linalg/direct_solver.hpp"
#include "rubato/linalg/equilibration.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

using contact::Triplets;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Triplet = Eigen::Triplet<double, int>;

/// Dense systems beyond this size cost more than a sparse factorisation of everything.
constexpr std::size_t largest_dense = 5000;
/// Rows of multipliers whose entries are below this part of the largest one say nothing about any unknown.
constexpr double empty_row = 1e-13;

/// The contact triplets on free dofs, forces weighted, rows that no free unknown can fulfil replaced by "no
/// change".
struct ContactBlocks {
  Triplets force_by_dof;
  Triplets force_by_multiplier;
  Triplets equation_by_dof;
  Triplets equation_by_multiplier;
  VectorXd equations;
};

/// A point between parts that are held has a gap or slip nobody can change: its multiplier stays as it is.
void fix_unconstrained_multipliers(ContactBlocks& blocks) {
  VectorXd largest = VectorXd::Zero(blocks.equations.size());
  for (const auto* triplets : {&blocks.equation_by_dof, &blocks.equation_by_multiplier})
    for (const auto& entry : *triplets)
      largest[entry.row()] = std::max(largest[entry.row()], std::abs(entry.value()));
  std::vector<char> has_multiplier(static_cast<std::size_t>(largest.size()), 0);
  for (const auto& entry : blocks.equation_by_multiplier)
    has_multiplier[static_cast<std::size_t>(entry.row())] = 1;
  const double scale = largest.size() > 0 ? largest.maxCoeff() : 0.0;
  for (Index row = 0; row < largest.size(); ++row)
    if (has_multiplier[static_cast<std::size_t>(row)] == 0 && largest[row] <= empty_row * scale) {
      std::erase_if(blocks.equation_by_dof, [&](const Triplet& entry) { return entry.row() == row; });
      blocks.equation_by_multiplier.emplace_back(static_cast<int>(row), static_cast<int>(row), 1.0);
      blocks.equations[row] = 0;
    }
}

ContactBlocks blocks_of(const LinearProblem& problem) {
  const auto& system = problem.contact;
  const auto free = [&](int dof) { return problem.model.free_index[static_cast<std::size_t>(dof)]; };
  ContactBlocks blocks;
  for (const auto& entry : system.force_by_dof)
    if (free(entry.row()) >= 0 && free(entry.col()) >= 0)
      blocks.force_by_dof.emplace_back(free(entry.row()), free(entry.col()),
                                       problem.force_weight * entry.value());
  for (const auto& entry : system.force_by_multiplier)
    if (free(entry.row()) >= 0)
      blocks.force_by_multiplier.emplace_back(free(entry.row()), entry.col(),
                                              problem.force_weight * entry.value());
  for (const auto& entry : system.equation_by_dof)
    if (free(entry.col()) >= 0)
      blocks.equation_by_dof.emplace_back(entry.row(), free(entry.col()), entry.value());
  blocks.equation_by_multiplier = system.equation_by_multiplier;
  blocks.equations = system.equations;
  fix_unconstrained_multipliers(blocks);
  return blocks;
}

/// Numbers the entries of a set: index in it, or −1.
class Numbering {
public:
  explicit Numbering(Index size) : number_(static_cast<std::size_t>(size), -1) {}
  /// Whether it is new.
  bool add(int item) {
    auto& number = number_[static_cast<std::size_t>(item)];
    if (number >= 0)
      return false;
    number = static_cast<int>(items_.size());
    items_.push_back(item);
    return true;
  }
  int operator[](int item) const { return number_[static_cast<std::size_t>(item)]; }
  const std::vector<int>& items() const { return items_; }
  Index size() const { return static_cast<Index>(items_.size()); }

private:
  std::vector<int> number_;
  std::vector<int> items_;
};

/// The unknowns that contact couples; multipliers that only meet themselves are left out.
struct Coupled {
  Numbering unknowns;
  Numbering multipliers;
};

Coupled coupled_unknowns(const ContactBlocks& blocks, Index free_count) {
  Coupled coupled{Numbering(free_count), Numbering(blocks.equations.size())};
  for (const auto& entry : blocks.force_by_dof) {
    coupled.unknowns.add(entry.row());
    coupled.unknowns.add(entry.col());
  }
  for (const auto& entry : blocks.force_by_multiplier) {
    coupled.unknowns.add(entry.row());
    coupled.multipliers.add(entry.col());
  }
  for (const auto& entry : blocks.equation_by_dof) {
    coupled.multipliers.add(entry.row());
    coupled.unknowns.add(entry.col());
  }
  for (bool grown = true; grown;) {
    grown = false;
    for (const auto& entry : blocks.equation_by_multiplier)
      if ((coupled.multipliers[entry.row()] >= 0) != (coupled.multipliers[entry.col()] >= 0))
        grown = coupled.multipliers.add(entry.row()) || coupled.multipliers.add(entry.col()) || grown;
  }
  return coupled;
}

/// Multipliers of open points: their own equations among themselves.
bool solve_uncoupled(const ContactBlocks& blocks, const Coupled& coupled, VectorXd& change) {
  Numbering rest(blocks.equations.size());
  for (Index row = 0; row < blocks.equations.size(); ++row)
    if (coupled.multipliers[static_cast<int>(row)] < 0)
      rest.add(static_cast<int>(row));
  if (rest.size() == 0)
    return true;
  Triplets triplets;
  bool diagonal = true;
  for (const auto& entry : blocks.equation_by_multiplier)
    if (rest[entry.row()] >= 0) {
      diagonal = diagonal && entry.row() == entry.col();
      triplets.emplace_back(rest[entry.row()], rest[entry.col()], entry.value());
    }
  model::SparseMatrix matrix(rest.size(), rest.size());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  const VectorXd right = -blocks.equations(rest.items());
  if (diagonal) {
    change(rest.items()) = right.cwiseQuotient(VectorXd(matrix.diagonal()));
    return change.allFinite();
  }
  const auto factor = linalg::LuFactor::of(matrix);
  if (factor)
    change(rest.items()) = factor->solve(right);
  return factor.has_value();
}

model::SparseMatrix sparse(const Triplets& triplets, const Numbering& rows, const Numbering& columns) {
  Triplets chosen;
  for (const auto& entry : triplets)
    if (rows[entry.row()] >= 0 && columns[entry.col()] >= 0)
      chosen.emplace_back(rows[entry.row()], columns[entry.col()], entry.value());
  model::SparseMatrix matrix(rows.size(), columns.size());
  matrix.setFromTriplets(chosen.begin(), chosen.end());
  return matrix;
}

MatrixXd dense(const Triplets& triplets, const Numbering& rows, const Numbering& columns) {
  MatrixXd matrix = MatrixXd::Zero(rows.size(), columns.size());
  for (const auto& entry : triplets)
    if (rows[entry.row()] >= 0 && columns[entry.col()] >= 0)
      matrix(rows[entry.row()], columns[entry.col()]) += entry.value();
  return matrix;
}

/// Solves with rows and columns scaled to entries of order one: pressures and displacements differ by 15
/// orders. Nothing comes back when the matrix is singular.
std::optional<VectorXd> solve_dense(MatrixXd matrix, VectorXd right) {
  VectorXd row_scale, column_scale;
  linalg::equilibrate(matrix, row_scale, column_scale);
  right = row_scale.cwiseProduct(right);
  const auto lu = linalg::DenseLu::of(matrix);
  if (!lu)
    return std::nullopt;
  VectorXd solution = lu->solve(right);
  // One refinement: the condensed answer is to be the whole system's to rounding.
  solution += lu->solve(right - matrix * solution);
  if (!solution.allFinite())
    return std::nullopt;
  return VectorXd(column_scale.cwiseProduct(solution));
}

} // namespace

std::optional<LinearSolution> solve_full(const LinearProblem& problem) {
  const auto blocks = blocks_of(problem);
  const auto free_count = static_cast<int>(problem.matrix.rows());
  const auto size = free_count + static_cast<int>(blocks.equations.size());
  Triplets triplets = blocks.force_by_dof;
  for (const auto& entry : blocks.force_by_multiplier)
    triplets.emplace_back(entry.row(), free_count + entry.col(), entry.value());
  for (const auto& entry : blocks.equation_by_dof)
    triplets.emplace_back(free_count + entry.row(), entry.col(), entry.value());
  for (const auto& entry : blocks.equation_by_multiplier)
    triplets.emplace_back(free_count + entry.row(), free_count + entry.col(), entry.value());
  model::SparseMatrix contact_part(size, size);
  contact_part.setFromTriplets(triplets.begin(), triplets.end());
  model::SparseMatrix whole = problem.matrix;
  whole.conservativeResize(size, size);
  whole += contact_part;

  const auto factor = linalg::LuFactor::of(whole);
  if (!factor)
    return std::nullopt;
  VectorXd right(size);
  right << -problem.residual, -blocks.equations;
  const VectorXd solution = factor->solve(right);
  return LinearSolution{solution.head(free_count), solution.tail(blocks.equations.size())};
}

std::optional<LinearSolution> solve_condensed(const LinearProblem& problem, Compliance& compliance) {
  const auto blocks = blocks_of(problem);
  const auto coupled = coupled_unknowns(blocks, problem.matrix.rows());
  const Index surface = coupled.unknowns.size();
  const Index multipliers = coupled.multipliers.size();
  if (static_cast<std::size_t>(surface + multipliers) > largest_dense)
    return std::nullopt;
  LinearSolution solution{compliance.solve(-problem.residual), VectorXd::Zero(blocks.equations.size())};
  if (!solve_uncoupled(blocks, coupled, solution.multipliers))
    return std::nullopt;
  if (surface + multipliers == 0)
    return solution;

  const MatrixXd s = compliance.between_unknowns(coupled.unknowns.items());
  const auto k = sparse(blocks.force_by_dof, coupled.unknowns, coupled.unknowns);
  const auto g = sparse(blocks.force_by_multiplier, coupled.unknowns, coupled.multipliers);
  MatrixXd matrix(surface + multipliers, surface + multipliers);
  matrix.topLeftCorner(surface, surface) = MatrixXd::Identity(surface, surface) + s * k;
  matrix.topRightCorner(surface, multipliers) = s * g;
  matrix.bottomLeftCorner(multipliers, surface) =
      dense(blocks.equation_by_dof, coupled.multipliers, coupled.unknowns);
  matrix.bottomRightCorner(multipliers, multipliers) =
      dense(blocks.equation_by_multiplier, coupled.multipliers, coupled.multipliers);
  VectorXd right(surface + multipliers);
  right << solution.displacement(coupled.unknowns.items()), -blocks.equations(coupled.multipliers.items());
  const auto local = solve_dense(std::move(matrix), std::move(right));
  if (!local)
    return std::nullopt;

  solution.multipliers(coupled.multipliers.items()) = local->tail(multipliers);
  VectorXd force = -problem.residual;
  force(coupled.unknowns.items()) -= k * local->head(surface) + g * local->tail(multipliers);
  solution.displacement = compliance.solve(force);
  return solution;
}

std::vector<int> surface_unknowns(const model::Model& model) {
  std::vector<int> unknowns;
  for (const auto& zone : model.zones)
    for (const auto* surface : {&zone.master, &zone.slave})
      for (const auto node : surface->nodes)
        for (int i = 0; i < model.dofs.components; ++i)
          if (const int free = model.free_index[static_cast<std::size_t>(model.dofs.dof(node, i))]; free >= 0)
            unknowns.push_back(free);
  std::ranges::sort(unknowns);
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  return unknowns;
}

} // namespace rubato::step
