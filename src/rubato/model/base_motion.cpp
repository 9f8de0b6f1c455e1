// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"
#include "rubato/core/time_integral.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace rubato::model {
namespace {

using Base = constraint::Reduction::Base;

/// What is left of a sum below this part of its terms is rounding.
constexpr double sum_rounding = 1e-12;

std::string path_of(std::size_t axis) {
  return fmt::format("base_motion.{}", study::axis_words.at(axis));
}

bool is_absolute(const study::Study& study) {
  return study.base_motion && study.base_motion->frame == study::BaseFrame::absolute;
}

/// What the deck gives of an axis, as a displacement.
FieldFunction displacement_of(const study::Study& study, const study::Field& given, std::size_t axis) {
  auto field = study::field_function(given, study.functions, path_of(axis));
  if (given.given == study::Given::displacement)
    return field;
  return integrated(field, static_cast<int>(given.given), study.time.begin, study.time.end);
}

/// r: 1 on the dofs along an axis.
Eigen::VectorXd along_axis(const Model& model, int axis) {
  Eigen::VectorXd along = Eigen::VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes)
    along[model.dofs.dof(node, axis)] = 1;
  return along;
}

/// factor · a_i b_i
Eigen::VectorXd product_of_entries(double factor, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd product(a.size());
  for (Eigen::Index i = 0; i < a.size(); ++i)
    product[i] = factor * a[i] * b[i];
  return product;
}

/// −M r
Eigen::VectorXd inertia_along(const Model& model, int axis) {
  const auto along = along_axis(model, axis);
  if (model.lumped_mass.size() > 0)
    return product_of_entries(-1, model.lumped_mass, along) - reference_masses(model) * along;
  auto inertia = linalg::product_of(model.mass, along, model.sharing());
  for (auto& value : inertia)
    value = -value;
  return inertia;
}

/// c (c·r) times a coefficient; 0 of connectors between places, which a translation does not stretch.
void add_pull(const Connector& connector, double coefficient, const Eigen::VectorXd& along,
              Eigen::VectorXd& forces) {
  double sum = 0;
  double magnitude = 0;
  for (const auto& term : connector.row) {
    sum += term.coefficient * along[term.dof];
    magnitude += std::abs(term.coefficient * along[term.dof]);
  }
  if (std::abs(sum) > sum_rounding * magnitude)
    for (const auto& term : connector.row)
      forces[term.dof] += coefficient * sum * term.coefficient;
}

/// Stiffness of what goes to the ground times the direction of an axis: everything else moves along.
Eigen::VectorXd ground_stiffness(const Model& model, const Eigen::VectorXd& along) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(model.dofs.dof_count);
  for (const auto& spring : model.springs)
    forces[spring.dof] += spring.stiffness * along[spring.dof];
  for (const auto& connector : model.connectors)
    add_pull(connector, connector.stiffness, along, forces);
  return forces;
}

/// The same of dashpots and of damping by the mass.
Eigen::VectorXd ground_damping(const Model& model, const Eigen::VectorXd& along) {
  if (!model.has_damping)
    return {};
  return linalg::product_of(model.damping, along, model.sharing());
}

/// An expression of t as a function of time.
void add_force(Model& model, const study::Field& acceleration, int axis) {
  const auto field =
      study::field_function(acceleration, model.study.functions, path_of(static_cast<std::size_t>(axis)));
  auto pattern = inertia_along(model, axis);
  if (!field.expression) {
    for (auto& value : pattern)
      value *= field.number;
    return model.forces.push_back({std::move(pattern), field.function, {}});
  }
  Function function{Expression(*field.expression)};
  if (field.function)
    function = Function(Product{{std::move(function), *field.function}});
  model.forces.push_back({std::move(pattern), std::move(function), {}});
}

} // namespace

Base make_base(const study::Study& study, std::vector<Fault>& faults) {
  Base base;
  if (!is_absolute(study))
    return base;
  for (std::size_t axis = 0; axis < base.size(); ++axis)
    if (const auto& given = study.base_motion->components.at(axis)) {
      try {
        base.at(axis) = displacement_of(study, *given, axis);
      } catch (const InputError& error) {
        std::ranges::copy(error.faults(), std::back_inserter(faults));
      }
    }
  return base;
}

void carry_obstacles(Model& model) {
  std::vector<Fault> told; // with the supports
  const auto base = make_base(model.study, told);
  for (auto& zone : model.zones)
    if (zone.obstacle)
      zone.obstacle->base = base;
}

double GroundPull::at(double t) const {
  constexpr std::array<double, 3> anywhere{};
  return displacement.at(anywhere, t);
}

double GroundPull::rate(double t) const {
  constexpr std::array<double, 3> anywhere{};
  return displacement.multiplied_at(anywhere, t) * rate_at(displacement.function, t, 1);
}

void move_ground(Model& model) {
  std::vector<Fault> told; // with the supports
  const auto base = make_base(model.study, told);
  for (int axis = 0; axis < model.dofs.components; ++axis)
    if (const auto& moved = base.at(static_cast<std::size_t>(axis))) {
      const auto along = along_axis(model, axis);
      GroundPull pull{*moved, along, ground_stiffness(model, along), ground_damping(model, along)};
      const bool has_stiffness =
          std::any_of(pull.stiffness.begin(), pull.stiffness.end(), [](double value) { return value != 0; });
      if (has_stiffness || pull.damping.size() > 0)
        model.ground.push_back(std::move(pull));
    }
}

void add_base_inertia(Model& model) {
  if (!model.study.base_motion || is_absolute(model.study))
    return;
  for (int axis = 0; axis < model.dofs.components; ++axis)
    if (const auto& given = model.study.base_motion->components.at(static_cast<std::size_t>(axis)))
      add_force(model, *given, axis);
}

} // namespace rubato::model
