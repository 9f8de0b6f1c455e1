// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/probe_values.hpp"

#include "rubato/results/nodal_fields.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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

/// Fields that are made for the nodes, once an instant and only when asked for.
class MadeFields {
public:
  MadeFields(const model::Model& model, const step::State& state) : model_(model), state_(state) {}

  const OwnedField& of(ProbeField field) {
    auto& fields = field == ProbeField::strain ? strain_ : study::is_of_contact(field) ? contact_ : stress_;
    if (!fields)
      fields = made(field);
    return *std::ranges::find(*fields, study::word_of(study::probe_field_words, field), &OwnedField::name);
  }

private:
  std::vector<OwnedField> made(ProbeField field) const {
    if (field == ProbeField::strain)
      return {strain_field(model_, state_)};
    return study::is_of_contact(field) ? contact_fields(model_, state_) : stress_fields(model_, state_);
  }

  const model::Model& model_;
  const step::State& state_;
  std::optional<std::vector<OwnedField>> contact_, stress_, strain_;
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
std::vector<double> node_values(const model::Model& model, const step::State& state, std::size_t p,
                                MadeFields& made) {
  const auto& probe = model.study.probes[p];
  const auto* kept = kept_field(state, probe.field);
  const auto* field = kept != nullptr ? nullptr : &made.of(probe.field);
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

/// As study::cut_quantities has them.
std::vector<double> section_values(const model::Model& model, const step::State& state, std::size_t p) {
  const auto& cut = *model.study.probes[p].section;
  const auto forces = domain::forces_at(model.probe_cuts[p], state.motion.u);
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
  return columns;
}

void add_probe_values(const model::Model& model, const step::State& state, std::vector<double>& row) {
  MadeFields made(model, state);
  const auto& probes = model.study.probes;
  std::vector<std::vector<double>> values(probes.size());
  for (std::size_t p = 0; p < probes.size(); ++p)
    if (probes[p].section)
      values[p] = section_values(model, state, p);
    else if (const auto* reference = model::reference_named(model.references, probes[p].node))
      values[p] = reference_values(model, *reference, state, probes[p].field);
    else if (probes[p].minus.empty())
      values[p] = node_values(model, state, p, made);
  const auto of = [&](const std::string& name) {
    return values[static_cast<std::size_t>(std::ranges::find(probes, name, &study::Probe::name) -
                                           probes.begin())];
  };
  for (std::size_t p = 0; p < probes.size(); ++p) {
    if (!probes[p].minus.empty())
      values[p] = difference_of_rows(of(probes[p].minus.at(0)), of(probes[p].minus.at(1)));
    row.insert(row.end(), values[p].begin(), values[p].end());
  }
}

} // namespace rubato::results
