// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/modes/modes.hpp"

#include "rubato/core/error.hpp"
#include "rubato/linalg/eigen_modes.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace rubato::modes {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Model;
using model::SparseMatrix;

/// Relations between displacements as relations between unknowns.
SparseMatrix reduced_relations(const Model& model, const SparseMatrix& relations) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < relations.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(relations, column); entry; ++entry)
      model.reduction.for_each_unknown(static_cast<int>(entry.row()), [&](int unknown, double coefficient) {
        entries.emplace_back(unknown, column, coefficient * entry.value());
      });
  SparseMatrix reduced(model.reduction.unknown_count(), relations.cols());
  reduced.setFromTriplets(entries.begin(), entries.end());
  return reduced;
}

linalg::EigenModes find_modes(const Model& model, const SparseMatrix& relations, int number) {
  if (model.reduction.unknown_count() == 0)
    throw InputError("supports hold every displacement, expected something that can vibrate");
  const auto stiffness = model.reduction.reduced(model.domain.initial_tangent());
  const bool floats =
      model.study.supports.empty() && model.springs.empty() &&
      std::ranges::none_of(model.connectors, [](const auto& connector) { return connector.resists(); });
  auto found = linalg::smallest_modes(stiffness, model.reduction.reduced(model.mass),
                                      reduced_relations(model, relations), number,
                                      floats ? linalg::Support::none : linalg::Support::unknown);
  if (!found)
    throw InputError(
        "stiffness and mass together are not positive definite: something moves without mass and "
        "without resistance, expected densities above 0");
  return std::move(*found);
}

/// Of the nodes, each by its components.
double longest_displacement(const Model& model, const VectorXd& shape) {
  const Index components = model.dofs.components;
  return std::sqrt(shape.reshaped(components, shape.size() / components).colwise().squaredNorm().maxCoeff());
}

/// A ring that moves along x grows.
std::vector<int> directions_of(const Model& model) {
  if (model.study.physics == study::Physics::axisymmetric)
    return {1};
  std::vector<int> directions(static_cast<std::size_t>(model.dofs.components));
  std::iota(directions.begin(), directions.end(), 0);
  return directions;
}

/// Of every node along one direction, by 1.
VectorXd translation(const Model& model, int direction) {
  VectorXd motion = VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes)
    motion[model.dofs.dof(node, direction)] = 1;
  return motion;
}

void add_effective_masses(const Model& model, Modes& modes) {
  modes.directions = directions_of(model);
  modes.effective_masses.resize(modes.frequencies.size(), static_cast<Index>(modes.directions.size()));
  for (std::size_t i = 0; i < modes.directions.size(); ++i) {
    const auto motion = translation(model, modes.directions[i]);
    const VectorXd moved = model.mass * motion;
    modes.mass = motion.dot(moved);
    const VectorXd participation = modes.shapes.transpose() * moved;
    modes.effective_masses.col(static_cast<Index>(i)) =
        participation.cwiseAbs2().cwiseQuotient(modes.generalised_masses) / modes.mass;
  }
}

} // namespace

Modes modes_of(const Model& model, const ModeRequest& request) {
  if (request.number < 1 || model.mass.nonZeros() == 0)
    throw std::invalid_argument("modes_of wants a number above 0 and a model with masses.");
  auto closed = closed_contact(model, request.contact);
  const auto found = find_modes(model, closed.relations, request.number);
  Modes modes;
  modes.notes = std::move(closed.notes);
  modes.warnings = std::move(closed.warnings);
  if (!model.domain.is_linear())
    modes.notes.emplace_back(
        "bodies or connectors are nonlinear: these are small vibrations about their undeformed shape, with "
        "the stiffness that they begin with");
  modes.frequencies = found.values.cwiseSqrt() / (2 * std::numbers::pi);
  modes.residuals = found.residuals;
  modes.converged = found.converged;
  modes.shapes.resize(model.dofs.dof_count, found.values.size());
  modes.generalised_masses.resize(found.values.size());
  for (Index k = 0; k < found.values.size(); ++k) {
    const VectorXd shape = model.reduction.scatter(found.vectors.col(k));
    const double longest = longest_displacement(model, shape);
    modes.shapes.col(k) = shape / longest;
    modes.generalised_masses[k] = 1 / (longest * longest);
  }
  add_effective_masses(model, modes);
  return modes;
}

} // namespace rubato::modes
