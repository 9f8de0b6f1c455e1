// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/full/linear_step.hpp"

#include "rubato/core/ranks.hpp"
#include "rubato/core/tolerances.hpp"
#include "rubato/linalg/direct_solver.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

using contact::Triplets;
using Eigen::Index;
using Eigen::VectorXd;
using Triplet = Eigen::Triplet<double, int>;

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
    if (has_multiplier[static_cast<std::size_t>(row)] == 0 && largest[row] <= tolerances.empty_row * scale) {
      std::erase_if(blocks.equation_by_dof, [&](const Triplet& entry) { return entry.row() == row; });
      blocks.equation_by_multiplier.emplace_back(static_cast<int>(row), static_cast<int>(row), 1.0);
      blocks.equations[row] = 0;
    }
}

ContactBlocks blocks_of(const LinearProblem& problem) {
  const auto& system = problem.contact;
  const auto& reduction = problem.model.reduction;
  ContactBlocks blocks;
  for (const auto& entry : system.force_by_dof)
    reduction.for_each_unknown(entry.row(), [&](int row, double by_row) {
      reduction.for_each_unknown(entry.col(), [&](int column, double by_column) {
        blocks.force_by_dof.emplace_back(row, column,
                                         problem.force_weight * by_row * by_column * entry.value());
      });
    });
  for (const auto& entry : system.force_by_multiplier)
    reduction.for_each_unknown(entry.row(), [&](int row, double by_row) {
      blocks.force_by_multiplier.emplace_back(row, entry.col(),
                                              problem.force_weight * by_row * entry.value());
    });
  for (const auto& entry : system.equation_by_dof)
    reduction.for_each_unknown(entry.col(), [&](int column, double by_column) {
      blocks.equation_by_dof.emplace_back(entry.row(), column, by_column * entry.value());
    });
  blocks.equation_by_multiplier = system.equation_by_multiplier;
  blocks.equations = system.equations;
  fix_unconstrained_multipliers(blocks);
  return blocks;
}

} // namespace

namespace {

std::optional<LinearSolution> solved(const LinearProblem& problem) {
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
  LinearSolution found{solution.head(free_count), solution.tail(blocks.equations.size())};
  if (problem.load == nullptr)
    return found;
  right << *problem.load, VectorXd::Zero(blocks.equations.size());
  const VectorXd by_load = factor->solve(right);
  found.displacement_by_load = by_load.head(free_count);
  found.multipliers_by_load = by_load.tail(blocks.equations.size());
  return found;
}

void share(const Ranks& ranks, Eigen::Index size, VectorXd& values) {
  values.conservativeResize(size);
  ranks.share_first({values.data(), static_cast<std::size_t>(size)});
}

} // namespace

/// By the first rank: what each would compute for itself need not have the same last digits.
std::optional<LinearSolution> solve_full(const LinearProblem& problem) {
  const auto ranks = problem.model.sharing();
  std::optional<LinearSolution> found;
  if (ranks.is_first())
    found = solved(problem);
  if (ranks.is_alone())
    return found;
  if (!ranks.of_first(found.has_value()))
    return std::nullopt;
  if (!found)
    found.emplace();
  const auto unknowns = problem.matrix.rows();
  const auto multipliers = static_cast<Eigen::Index>(problem.model.multiplier_count);
  share(ranks, unknowns, found->displacement);
  share(ranks, multipliers, found->multipliers);
  if (problem.load != nullptr) {
    share(ranks, unknowns, found->displacement_by_load);
    share(ranks, multipliers, found->multipliers_by_load);
  }
  return found;
}

std::vector<int> surface_unknowns(const model::Model& model) {
  std::vector<int> unknowns;
  for (const auto& zone : model.zones)
    for (const auto* surface : {&zone.master, &zone.slave})
      for (const auto node : surface->nodes)
        for (int i = 0; i < model.dofs.components; ++i)
          model.reduction.for_each_unknown(model.dofs.dof(node, i),
                                           [&](int unknown, double) { unknowns.push_back(unknown); });
  std::ranges::sort(unknowns);
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  return unknowns;
}

std::vector<int> related_surface_dofs(const model::Model& model) {
  std::vector<int> on_surface;
  for (const auto& zone : model.zones)
    for (const auto* surface : {&zone.master, &zone.slave})
      on_surface.insert(on_surface.end(), surface->nodes.begin(), surface->nodes.end());
  std::ranges::sort(on_surface);
  std::vector<int> related;
  for (const auto& dependent : model.reduction.dependents())
    if (!dependent.of.empty() && std::ranges::binary_search(on_surface, model.node_of(dependent.dof)))
      related.push_back(dependent.dof);
  return related;
}

} // namespace rubato::step
