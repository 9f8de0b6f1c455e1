// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/probe_values.hpp"

#include "rubato/contact/discretisation.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/references.hpp"
#include "rubato/results/cell_quantities.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/words.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>

namespace rubato::results {
namespace {

using study::ProbeField;

/// Of those that every state has; null for others.
const Eigen::VectorXd* kept_field(const step::State& state, ProbeField field) {
  switch (field) {
  case ProbeField::displacement:
    return &state.motion.u;
  case ProbeField::velocity:
    return &state.motion.v;
  case ProbeField::acceleration:
    return &state.motion.a;
  case ProbeField::reaction:
    return &state.reaction;
  default:
    return nullptr;
  }
}

/// What is made of a state, once an instant and only when asked for.
class MadeFields {
public:
  MadeFields(const model::Model& model, const step::State& state) : model_(model), state_(state) {}

  /// One a dof; null for fields that are made for nodes.
  const Eigen::VectorXd* of_dofs(ProbeField field) {
    if (field == ProbeField::internal_force)
      return &made(internal_, [&] { return internal_force(model_, state_); });
    if (field == ProbeField::contact_force)
      return &made(pushed_, [&] { return contact_force(model_, state_); });
    return kept_field(state_, field);
  }

  const OwnedField& of_nodes(ProbeField field) {
    const auto& fields = fields_with(field);
    return *std::ranges::find(fields, study::word_of(study::probe_field_words, field), &OwnedField::name);
  }

  CellQuantities& in_cells() {
    if (!in_cells_)
      in_cells_.emplace(model_, state_);
    return *in_cells_;
  }

private:
  using Fields = std::vector<OwnedField>;

  template <class T, class Make> static const T& made(std::optional<T>& kept, const Make& make) {
    if (!kept)
      kept = make();
    return *kept;
  }

  const Fields& fields_with(ProbeField field) {
    switch (field) {
    case ProbeField::strain:
      return made(strain_, [&] { return Fields{strain_field(model_, state_)}; });
    case ProbeField::plastic_strain:
      return made(plastic_, [&] { return Fields{plastic_strain_field(model_, state_)}; });
    case ProbeField::cumulated_plastic_strain:
      return made(cumulated_, [&] { return Fields{cumulated_plastic_strain_field(model_, state_)}; });
    case ProbeField::tresca:
    case ProbeField::mean_stress:
    case ProbeField::principal_stress:
      return made(other_stress_, [&] { return other_stress_fields(of_nodes(ProbeField::stress)); });
    default:
      break;
    }
    if (field == ProbeField::temperature)
      return made(temperature_, [&] { return Fields{temperature_field(model_, state_.t)}; });
    if (study::is_of_contact(field))
      return made(contact_, [&] { return contact_fields(model_, state_); });
    return made(stress_, [&] { return stress_fields(model_, state_); });
  }

  const model::Model& model_;
  const step::State& state_;
  std::optional<Fields> contact_, stress_, other_stress_, strain_, plastic_, cumulated_, temperature_;
  std::optional<Eigen::VectorXd> internal_, pushed_;
  std::optional<CellQuantities> in_cells_;
};

/// `values`: of one component at the nodes of a probe, at least one.
double taken(study::ProbeTake take, const std::vector<double>& values) {
  const auto sum = [&] { return std::accumulate(values.begin(), values.end(), 0.0); };
  switch (take) {
  case study::ProbeTake::sum:
    return sum();
  case study::ProbeTake::mean:
    return sum() / static_cast<double>(values.size());
  case study::ProbeTake::least:
    return *std::ranges::min_element(values);
  case study::ProbeTake::largest:
    return *std::ranges::max_element(values);
  case study::ProbeTake::node:
    break;
  }
  return values.front();
}

/// Of the nodes of a probe, component by component.
std::vector<double> node_values(const model::Model& model, std::size_t p, MadeFields& made) {
  const auto& probe = model.study.probes[p];
  const auto* kept = made.of_dofs(probe.field);
  const auto* field = kept != nullptr ? nullptr : &made.of_nodes(probe.field);
  const int components = kept != nullptr ? model.dofs.components : field->components;
  std::vector<double> result;
  std::vector<double> values;
  for (int i = 0; i < components; ++i) {
    values.clear();
    for (const auto node : model.probe_nodes[p])
      values.push_back(kept != nullptr ? (*kept)[model.dofs.dof(node, i)]
                                       : field->values[static_cast<std::size_t>(node * components + i)]);
    result.push_back(taken(probe.take, values));
  }
  return result;
}

/// A force and its moment about a place.
class Resultant {
public:
  explicit Resultant(const std::array<double, 3>& about) : about_(about.data()) {}

  void add(const Eigen::Vector3d& place, const Eigen::Vector3d& force) {
    force_ += force;
    moment_ += (place - about_).cross(force);
  }

  /// As study::force_and_moment has them.
  std::vector<double> values(int dimension) const {
    std::vector<double> values(force_.data(), force_.data() + dimension);
    values.insert(values.end(), moment_.data() + (dimension == 3 ? 0 : 2), moment_.data() + 3);
    return values;
  }

private:
  Eigen::Vector3d about_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();
};

/// Forces on the nodes of a probe where these are in the deformed bodies.
std::vector<double> moment_values(const model::Model& model, const step::State& state, std::size_t p,
                                  MadeFields& made) {
  const auto& probe = model.study.probes[p];
  const auto& forces = *made.of_dofs(probe.field);
  const int d = model.dofs.components;
  Resultant resultant(*probe.about);
  for (const auto node : model.probe_nodes[p]) {
    Eigen::Vector3d place = model.mesh.points[static_cast<std::size_t>(node)];
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    place.head(d) += state.motion.u.segment(model.dofs.dof(node, 0), d);
    force.head(d) = forces.segment(model.dofs.dof(node, 0), d);
    resultant.add(place, force);
  }
  return resultant.values(d);
}

/// Of one cell what a probe looks at, a column each, and its volume, an entry each.
struct InCell {
  Eigen::MatrixXd values;
  Eigen::VectorXd volumes;
};

InCell in_cell(const study::Probe& probe, int point, std::size_t cell, CellQuantities& quantities) {
  const auto volumes = quantities.volumes(cell);
  if (probe.place == study::ProbePlace::cells)
    return {quantities.mean(probe.field, cell), Eigen::VectorXd::Constant(1, volumes.sum())};
  const auto values = quantities.at_points(probe.field, cell);
  if (point < 0)
    return {values, volumes};
  return {values.col(point), volumes.segment(point, 1)};
}

/// What is taken of the cells of a probe, or of their Gauss points, component by component; means are those
/// by volume.
std::vector<double> cell_values(const model::Model& model, std::size_t p, MadeFields& made) {
  const auto& probe = model.study.probes[p];
  const auto& probed = model.probe_cells[p];
  std::vector<std::vector<double>> rows;
  std::vector<double> weights;
  for (const auto cell : probed.cells) {
    const auto [values, volumes] = in_cell(probe, probed.point, cell, made.in_cells());
    rows.resize(static_cast<std::size_t>(values.rows()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      std::ranges::copy(values.row(static_cast<Eigen::Index>(i)), std::back_inserter(rows[i]));
    weights.insert(weights.end(), volumes.begin(), volumes.end());
  }
  const double volume = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> result;
  result.reserve(rows.size());
  for (const auto& row : rows)
    result.push_back(probe.take == study::ProbeTake::mean
                         ? std::inner_product(row.begin(), row.end(), weights.begin(), 0.0) / volume
                         : taken(probe.take, row));
  return result;
}

/// The forces of contact_<zone>.csv at its places.
std::vector<double> contact_values(const model::Model& model, const step::State& state,
                                   const study::ContactForce& asked) {
  const auto zone =
      std::ranges::find(model.zones, asked.zone, [](const contact::Zone& one) { return one.settings.name; });
  const auto& outcomes = state.zones[static_cast<std::size_t>(zone - model.zones.begin())].outcomes;
  const auto& u = state.motion.u;
  const contact::Configuration now{&model.mesh, &model.dofs, &u, &u, state.t, state.t};
  Resultant resultant(asked.about);
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    resultant.add(contact::position(zone->points[i], now), outcomes[i].normal + outcomes[i].tangential);
  return resultant.values(model.dofs.components);
}

/// As study::cut_quantities has them.
std::vector<double> section_values(const model::Model& model, const step::State& state, std::size_t p) {
  const auto& cut = *model.study.probes[p].section;
  const auto forces = domain::forces_at(model.probe_cuts[p], state.motion.u, {model.domain.heat(), state.t},
                                        &state.bulk_points);
  const Eigen::Vector3d force = forces.head<3>();
  const Eigen::Vector3d normal = Eigen::Vector3d(cut.normal[0], cut.normal[1], cut.normal[2]).normalized();
  const double along = normal.dot(force);
  const int d = model.dofs.components;
  std::vector<double> values(force.data(), force.data() + d);
  for (int axis = d == 3 ? 0 : 2; axis < 3; ++axis)
    values.push_back(forces[3 + axis]);
  values.insert(values.end(), {along, (force - along * normal).norm()});
  return values;
}

/// Displacement, velocity, acceleration or rotation.
std::vector<double> reference_values(const model::Model& model, const model::Reference& reference,
                                     const step::State& state, ProbeField field) {
  const bool turn = field == ProbeField::rotation;
  const auto& values = turn ? state.motion.u : *kept_field(state, field);
  const Eigen::VectorXd motion = reference.motion * values(reference.dofs);
  const auto d = static_cast<Eigen::Index>(model.dofs.components);
  return turn ? std::vector<double>(motion.begin() + d, motion.end())
              : std::vector<double>(motion.begin(), motion.begin() + d);
}

std::vector<double> difference_of_rows(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  std::ranges::transform(a, b, result.begin(), std::minus());
  return result;
}

} // namespace

std::vector<std::string> probe_columns(const model::Model& model) {
  std::vector<std::string> columns;
  for (const auto& probe : model.study.probes) {
    const auto components = study::components_of(probe, model.study);
    if (components.empty())
      columns.push_back(probe.name);
    for (const auto& component : components)
      columns.push_back(fmt::format("{}.{}", probe.name, component));
  }
  if (model.study.time.arc_length)
    columns.emplace_back("load_factor");
  return columns;
}

void add_probe_values(const model::Model& model, const step::State& state, std::vector<double>& row) {
  MadeFields made(model, state);
  const auto& probes = model.study.probes;
  std::vector<std::vector<double>> values(probes.size());
  for (std::size_t p = 0; p < probes.size(); ++p)
    if (probes[p].section)
      values[p] = section_values(model, state, p);
    else if (const auto& contact = probes[p].contact)
      values[p] = contact_values(model, state, *contact);
    else if (const auto* reference = model::reference_named(model.references, probes[p].node))
      values[p] = reference_values(model, *reference, state, probes[p].field);
    else if (probes[p].about)
      values[p] = moment_values(model, state, p, made);
    else if (probes[p].place != study::ProbePlace::nodes)
      values[p] = cell_values(model, p, made);
    else if (probes[p].minus.empty())
      values[p] = node_values(model, p, made);
  const auto of = [&](const std::string& name) {
    return values[static_cast<std::size_t>(std::ranges::find(probes, name, &study::Probe::name) -
                                           probes.begin())];
  };
  for (std::size_t p = 0; p < probes.size(); ++p) {
    if (!probes[p].minus.empty())
      values[p] = difference_of_rows(of(probes[p].minus.at(0)), of(probes[p].minus.at(1)));
    row.insert(row.end(), values[p].begin(), values[p].end());
  }
  if (model.study.time.arc_length)
    row.push_back(state.load_factor);
}

} // namespace rubato::results
