// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/effective_system.hpp"

#include "rubato/error.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/step/linear_step.hpp"

#include <fmt/format.h>

namespace rubato::step {

using model::Model;
using model::SparseMatrix;

namespace {

std::optional<linalg::SplitFactor> factored(const Model& model, const SparseMatrix& matrix) {
  try {
    return linalg::SplitFactor::of(matrix, surface_unknowns(model), linalg::available_memory());
  } catch (const linalg::TooLargeForMemory& error) {
    throw InputError(fmt::format("the model is too large for this machine: with its {} unknowns {}",
                                 model.free_dofs.size(), error.what()));
  }
}

} // namespace

EffectiveSystem make_effective_system(const Model& model, const time::Scheme& scheme, double step) {
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
    system.zones.push_back(contact::automatic_coefficients(zone, model.dofs, system.diagonal));
    system.neighbours.emplace_back(zone);
  }
  if (model.study.solver != deck::Solver::full)
    if (auto factor = factored(model, system.matrix))
      system.compliance = std::make_unique<Compliance>(std::move(*factor), model.free_dofs,
                                                       static_cast<Eigen::Index>(model.dofs.dof_count));
  return system;
}

} // namespace rubato::step
