// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/probe_values.hpp"

#include "rubato/results/nodal_fields.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    auto& fields = study::is_of_contact(field) ? contact_ : stress_;
    if (!fields)
      fields = study::is_of_contact(field) ? contact_fields(model_, state_) : stress_fields(model_, state_);
    return *std::ranges::find(*fields, study::word_of(study::probe_field_words, field), &OwnedField::name);
  }

private:
  const model::Model& model_;
  const step::State& state_;
  std::optional<std::vector<OwnedField>> contact_, stress_;
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

} // namespace

std::vector<std::string> probe_columns(const model::Model& model) {
  std::vector<std::string> columns;
  for (const auto& probe : model.study.probes) {
    const auto components = study::components_of(probe.field, model.dofs.components);
    if (components.empty())
      columns.push_back(probe.name);
    for (const auto& component : components)
      columns.push_back(fmt::format("{}.{}", probe.name, component));
  }
  return columns;
}

void add_probe_values(const model::Model& model, const step::State& state, std::vector<double>& row) {
  MadeFields made(model, state);
  std::vector<double> values;
  for (std::size_t p = 0; p < model.probe_nodes.size(); ++p) {
    const auto& probe = model.study.probes[p];
    const auto* kept = kept_field(state, probe.field);
    const auto* field = kept != nullptr ? nullptr : &made.of(probe.field);
    const int components = kept != nullptr ? model.dofs.components : field->components;
    for (int i = 0; i < components; ++i) {
      values.clear();
      for (const auto node : model.probe_nodes[p])
        values.push_back(kept != nullptr ? (*kept)[model.dofs.dof(node, i)]
                                         : field->values[static_cast<std::size_t>(node * components + i)]);
      row.push_back(taken(probe.take, values));
    }
  }
}

} // namespace rubato::results
