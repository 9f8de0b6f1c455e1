// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/effective_system.hpp"

#include "rubato/error.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/step/linear_step.hpp"
#include "rubato/time/step_control.hpp"

#include <fmt/format.h>

#include <utility>

namespace rubato::step {

using model::Model;
using model::SparseMatrix;

namespace {

std::optional<linalg::SplitFactor> factored(const Model& model, const SparseMatrix& matrix,
                                            const std::function<void(std::size_t)>& tell_memory) {
  try {
    return linalg::SplitFactor::of(matrix, surface_unknowns(model), linalg::available_memory(), tell_memory);
  } catch (const linalg::TooLargeForMemory& error) {
    throw InputError(
        fmt::format("the model is too large for this machine: with its {} unknowns {}; expected a "
                    "coarser mesh or cells of lower order, or more memory",
                    model.free_dofs.size(), error.what()));
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
  Eigen::VectorXd diagonal = coefficients.stiffness * model.stiffness.diagonal();
  if (coefficients.mass != 0)
    diagonal += coefficients.mass * model.mass.diagonal();
  if (coefficients.damping != 0 && model.damping.nonZeros() > 0)
    diagonal += coefficients.damping * model.damping.diagonal();
  return diagonal;
}

bool has_springs(const contact::Zone& zone) {
  return !contact::is_exact(zone.settings.method) ||
         zone.settings.friction_method == deck::FrictionMethod::nodal_penalty;
}

/// What only leads to the answer follows the step at hand. Springs are part of the model: stiffer ones in a
/// step that is cut would throw bodies apart that the former ones had let in.
contact::ZoneCoefficients coefficients_of(const contact::Zone& zone, const Model& model,
                                          const time::Scheme& scheme, const Eigen::VectorXd& diagonal) {
  auto coefficients = contact::automatic_coefficients(zone, model.dofs, diagonal);
  if (!has_springs(zone))
    return coefficients;
  auto usual = contact::automatic_coefficients(zone, model.dofs, usual_diagonal(model, scheme));
  if (!contact::is_exact(zone.settings.method))
    return usual;
  coefficients.tangential = std::move(usual.tangential);
  return coefficients;
}

} // namespace

EffectiveSystem make_effective_system(const Model& model, const time::Scheme& scheme, double step,
                                      const std::function<void(std::size_t)>& tell_memory) {
  EffectiveSystem system;
  system.step = step;
  system.coefficients = time::coefficients_of(scheme, step);
  SparseMatrix full = system.coefficients.stiffness * model.stiffness;
  if (system.coefficients.mass != 0)
    full += system.coefficients.mass * model.mass;
  if (system.coefficients.damping != 0 && model.damping.nonZeros() > 0)
    full += system.coefficients.damping * model.damping;
  system.diagonal = full.diagonal();
  system.matrix = model::free_part(model, full);
  for (const auto& zone : model.zones) {
    system.zones.push_back(coefficients_of(zone, model, scheme, system.diagonal));
    system.neighbours.emplace_back(zone);
  }
  if (model.study.solver != deck::Solver::full)
    if (auto factor = factored(model, system.matrix, tell_memory))
      system.compliance = std::make_unique<Compliance>(std::move(*factor), model.free_dofs,
                                                       static_cast<Eigen::Index>(model.dofs.dof_count));
  return system;
}

} // namespace rubato::step
