// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/effective_system.hpp"

#include "rubato/contact/springs.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/tolerances.hpp"
#include "rubato/linalg/iterative_solver.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/linalg/ranked_factor.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/linalg/sparse_sum.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/step/common/rigid_unknowns.hpp"
#include "rubato/step/common/spatial_order.hpp"
#include "rubato/step/full/linear_step.hpp"
#include "rubato/time/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rubato::step {

using model::Model;
using model::SparseMatrix;

namespace {

/// Of the memory, where whoever is told of it judges.
constexpr auto no_limit = std::numeric_limits<std::size_t>::max();

/// Unknowns of the surface of a body up to which it is eliminated last. Larger ones take less time and memory
/// within the body, where its shape allows that (docs/performance.md).
constexpr Eigen::Index largest_last = 2000;
/// Unknowns of a surface eliminated within its body up to which S is formed whole where the matrix stays: it
/// takes about as long as the factor, and 3 GB at most. Without it each motion of the surface takes a partial
/// solve, which comes to as much in some dozens of steps.
constexpr Eigen::Index largest_whole_within = 20'000;

/// Surfaces whose compliance may be computed by columns follow space: columns of neighbours are computed
/// together.
std::vector<int> ordered_surface(const Model& model) {
  auto unknowns = surface_unknowns(model);
  if (static_cast<Eigen::Index>(unknowns.size()) <= Compliance::usual_largest_whole)
    return unknowns;
  const auto nodes = Compliance::block_size / model.dofs.components;
  return in_spatial_order(model, unknowns, static_cast<std::size_t>(nodes));
}

std::unique_ptr<linalg::SurfaceSolver> factored(const Model& model, const SparseMatrix& matrix,
                                                const std::function<void(std::size_t)>& take) {
  if (!model.ranks.is_alone())
    return linalg::RankedFactor::of(matrix, surface_unknowns(model), model.ranks, model.threads, take);
  const linalg::SurfaceLimits limits{.last = largest_last,
                                     .whole_within = model.domain.is_linear() ? largest_whole_within : 0};
  auto factor =
      linalg::SplitFactor::of(matrix, ordered_surface(model), no_limit, take, limits, model.threads);
  return factor ? std::make_unique<linalg::SplitFactor>(std::move(*factor)) : nullptr;
}

/// With weak springs alone against its rigid motions a solution is that motion to nearly all of its digits:
/// contact, which goes by what is left, then comes to no end.
void must_be_held(const Model& model) {
  if (!model.free_body_nodes.empty())
    throw InputError({fault_at(
        "solver",
        fmt::format("found iterative, but only contact holds the body of node {}; expected auto, or "
                    "supports or springs that hold it",
                    model::node_label(model.mesh, model.free_body_nodes.front())))});
}

std::unique_ptr<linalg::SurfaceSolver> iterative(const Model& model, const SparseMatrix& matrix,
                                                 const std::function<void(std::size_t)>& take) {
  must_be_held(model);
  try {
    const auto ranks = static_cast<std::size_t>(model.ranks.count());
    return linalg::IterativeSolver::of(matrix, surface_unknowns(model), nodal_unknowns(model),
                                       [&](std::size_t all) { take(all / ranks); }, {.ranks = model.ranks});
  } catch (const linalg::NotSolved& error) {
    throw InputError({fault_at(
        "solver", fmt::format("found iterative, but {}; expected auto or condensed", error.what()))});
  }
}

/// Null where the matrix is not positive definite.
std::unique_ptr<linalg::SurfaceSolver> solver_of(const Model& model, const SparseMatrix& matrix,
                                                 const std::function<void(std::size_t)>& tell_memory) {
  const auto take = [&](std::size_t own) {
    const double of_all = model.ranks.sum(static_cast<double>(own));
    tell_memory(static_cast<std::size_t>(of_all)); // and waits for it beside other runs
    const auto needed =
        static_cast<std::size_t>(of_all * model.ranks.count_here() / model.ranks.count()); // on this machine
    const auto left = linalg::available_memory();
    if (!model.ranks.all(needed <= left))
      throw linalg::TooLargeForMemory(needed, left);
  };
  const bool iterates = model.study.solver == study::Solver::iterative;
  const bool offers = !iterates && model.free_body_nodes.empty();
  try {
    return iterates ? iterative(model, matrix, take) : factored(model, matrix, take);
  } catch (const linalg::TooLargeForMemory& error) {
    const auto needs =
        iterates ? fmt::format("conjugate gradients need {} of memory, of which {} are left",
                               linalg::memory_text(error.needed), linalg::memory_text(error.available))
                 : std::string(error.what());
    throw InputError(
        fmt::format("the model is too large for this machine: with its {} unknowns {}; expected {}a "
                    "coarser mesh or cells of lower order, or more memory",
                    model.reduction.unknown_count(), needs, offers ? "solver: iterative, " : ""));
  }
}

/// The diagonal of the matrix of the step that the deck asks for, of which those that are made are parts.
Eigen::VectorXd usual_diagonal(const Model& model, const time::Scheme& scheme) {
  const auto& settings = model.study.time;
  double step = settings.step;
  if (step <= 0) {
    auto listed = settings;
    listed.stops.clear();
    const auto instants = time::instants_of(listed);
    step = instants.at(1) - instants.at(0);
  }
  const auto coefficients = time::coefficients_of(scheme, step);
  Eigen::VectorXd diagonal = coefficients.stiffness * model.domain.initial_tangent().diagonal();
  if (coefficients.mass != 0)
    diagonal += coefficients.mass * model.mass.diagonal();
  if (coefficients.damping != 0 && model.damping.nonZeros() > 0)
    diagonal += coefficients.damping * model.damping.diagonal();
  return linalg::summed(std::move(diagonal), model.sharing());
}

/// Of the bodies that only contact holds.
template <class Take> void for_each_free_dof(const Model& model, const Take& take) {
  for (const auto node : model.free_body_nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      take(model.dofs.dof(node, i));
}

/// Of all weak springs of free bodies together, in parts of the largest stiffness at one of their nodes.
/// Stiffer ones take more iterations to let go of what they carry, weaker ones lose digits of the elastic
/// displacements.
constexpr double weakest = 1e-7;
constexpr double stiffest = 1e-5;
/// Edges by which the loads move bodies against their weak springs: about as far as frames of contact tell
/// where it presses.
constexpr double moved_edges = 3;
/// Augmentation of a point, in parts of all weak springs.
constexpr double augmented_by = 10;
/// Instants that the loads are looked at.
constexpr int load_samples = 100;

/// The largest load on free bodies in the run.
double largest_load(const Model& model) {
  const auto& time = model.study.time;
  double largest = 0;
  for (int i = 0; i <= load_samples; ++i) {
    const double t = time.begin + (time.end - time.begin) * i / load_samples;
    const Eigen::VectorXd force = model::external_force(model, t);
    double sum = 0;
    for_each_free_dof(model, [&](int dof) { sum += std::abs(force[dof]); });
    largest = std::max(largest, sum);
  }
  return largest;
}

void put_weak_springs(const Model& model, EffectiveSystem& system) {
  for_each_free_dof(model, [&](int dof) {
    if (const int free = model.reduction.unknown_of(dof); free >= 0 && model.counts(dof))
      system.matrix.coeffRef(free, free) += system.weak_spring;
  });
}

void put_held(const Model& model, EffectiveSystem& system) {
  for (const auto& spring : system.held)
    if (model.counts(spring.row))
      model.reduction.for_each_unknown(spring.row, [&](int row, double by_row) {
        model.reduction.for_each_unknown(spring.column, [&](int column, double by_column) {
          system.matrix.coeffRef(row, column) += by_row * by_column * spring.stiffness;
        });
      });
}

/// Returns how stiff they are together.
double add_weak_springs(const Model& model, EffectiveSystem& system) {
  system.has_free_bodies = true;
  double edge = std::numeric_limits<double>::infinity();
  for (const auto& zone : model.zones)
    edge = std::min(edge, zone.edge());
  double largest = 0;
  for_each_free_dof(model, [&](int dof) { largest = std::max(largest, system.diagonal[dof]); });
  const double load = largest_load(model);
  const double wanted = load > 0 ? load / (moved_edges * edge) : stiffest * largest;
  const double all = std::clamp(wanted, weakest * largest, stiffest * largest);
  system.weak_spring = all / static_cast<double>(model.free_body_nodes.size());
  put_weak_springs(model, system);
  return all;
}

/// What only leads to the answer follows the step at hand. Springs are part of the model: stiffer ones in a
/// step that is cut would throw bodies apart that the former ones had let in. A free body that lies on few
/// points moves by more than the elastic displacements before it comes to rest: augmentations of the
/// stiffness of the body would open points that press for gaps that are traces of that.
contact::ZoneCoefficients coefficients_of(const contact::Zone& zone, const Model& model,
                                          const Eigen::VectorXd& diagonal, const Eigen::VectorXd& usual,
                                          double weak) {
  auto coefficients = contact::automatic_coefficients(zone, model.dofs, diagonal);
  contact::keep_springs(zone, contact::automatic_coefficients(zone, model.dofs, usual), coefficients);
  if (weak > 0)
    contact::limit_augmentations(zone, augmented_by * weak, coefficients);
  return coefficients;
}

SparseMatrix effective_matrix(const Model& model, const time::StepCoefficients& coefficients,
                              const SparseMatrix& tangent) {
  SparseMatrix full = tangent;
  full.coeffs() *= coefficients.stiffness;
  if (coefficients.mass != 0)
    linalg::add_scaled(coefficients.mass, model.mass, full);
  if (coefficients.damping != 0 && model.damping.nonZeros() > 0)
    linalg::add_scaled(coefficients.damping, model.damping, full);
  return full;
}

void put_matrix(const Model& model, const SparseMatrix& tangent, EffectiveSystem& system) {
  const auto full = effective_matrix(model, system.coefficients, tangent);
  system.diagonal = linalg::diagonal_of(full, model.sharing());
  system.matrix = model.reduction.reduced(full);
}

} // namespace

bool same_values(const Model& model, const Tangent& a, const Tangent& b) {
  if (a == nullptr || b == nullptr) // on all ranks alike
    return a == b;
  return model.sharing().all(a == b || *a == *b);
}

Tangent values_of(const SparseMatrix& tangent) {
  return std::make_shared<const Eigen::VectorXd>(tangent.coeffs());
}

SparseMatrix matrix_of(const Model& model, const Tangent& tangent) {
  SparseMatrix matrix = model.domain.initial_tangent();
  matrix.coeffs() = *tangent;
  return matrix;
}

void renew_matrix(EffectiveSystem& system, const Model& model, const Tangent& tangent) {
  if (same_values(model, system.tangent, tangent))
    return;
  system.tangent = tangent;
  system.matrix =
      model.reduction.reduced(effective_matrix(model, system.coefficients, matrix_of(model, tangent)));
  if (system.weak_spring > 0)
    put_weak_springs(model, system);
  put_held(model, system);
}

void hold(EffectiveSystem& system, std::vector<NodeSpring> springs) {
  if (springs.empty() && system.held.empty())
    return;
  system.held = std::move(springs);
  system.tangent.reset();
  system.factored.reset();
}

bool renew(EffectiveSystem& system, const Model& model, const Tangent& tangent) {
  renew_matrix(system, model, tangent);
  if (!system.compliance || same_values(model, system.factored, tangent))
    return true;
  system.factored.reset();
  if (!system.compliance->refactor(system.matrix))
    return false;
  system.slopes = SlopeChanges(model, *system.compliance, system.coefficients);
  system.factored = tangent;
  return true;
}

double wanted_residual(const EffectiveSystem& system, double tolerance) {
  return system.has_free_bodies ? tolerances.free_body_residual * tolerance : tolerance;
}

EffectiveSystem make_effective_system(const Model& model, const time::Scheme& scheme, double step,
                                      const std::function<void(std::size_t)>& tell_memory) {
  EffectiveSystem system;
  system.step = step;
  system.coefficients = time::coefficients_of(scheme, step);
  const auto& tangent = model.domain.initial_tangent();
  if (!model.domain.is_linear())
    system.tangent = system.factored = values_of(tangent);
  put_matrix(model, tangent, system);
  system.entries = model.sharing().sum(static_cast<double>(system.matrix.nonZeros()));
  const double weak = model.free_body_nodes.empty() ? 0 : add_weak_springs(model, system);
  const auto usual = model.zones.empty() ? Eigen::VectorXd() : usual_diagonal(model, scheme);
  for (const auto& zone : model.zones) {
    system.zones.push_back(coefficients_of(zone, model, system.diagonal, usual, weak));
    system.discretisations.push_back(contact::make_discretisation(zone, model.threads));
  }
  if (model.study.solver != study::Solver::full)
    if (auto solver = solver_of(model, system.matrix, tell_memory))
      system.compliance =
          std::make_unique<Compliance>(std::move(solver), model.reduction, related_surface_dofs(model));
  if (system.compliance)
    system.slopes = SlopeChanges(model, *system.compliance, system.coefficients);
  return system;
}

} // namespace rubato::step
