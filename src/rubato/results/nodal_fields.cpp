// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/nodal_fields.hpp"

#include "rubato/contact/dropped_nodes.hpp"
#include "rubato/contact/nodal_pressure.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/cell_quantities.hpp"
#include "rubato/results/resultants.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/words.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace rubato::results {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

const std::vector<std::string> axes{"x", "y", "z"};
const std::vector<std::string> tensor_components{"xx", "yy", "zz", "xy", "yz", "xz"};

OwnedField vector_field(const Model& model, std::string name, const VectorXd& values) {
  const int components = model.dofs.components;
  OwnedField field{std::move(name), components, {}, {axes.begin(), axes.begin() + components}};
  field.values.assign(static_cast<std::size_t>(model.mesh.node_count() * components), 0.0);
  for (const auto node : model.dofs.nodes)
    for (int i = 0; i < components; ++i)
      field.values[static_cast<std::size_t>(node * components + i)] = values[model.dofs.dof(node, i)];
  return field;
}

OwnedField scalar_field(const Model& model, std::string name) {
  return {
      std::move(name), 1, std::vector<double>(static_cast<std::size_t>(model.mesh.node_count()), 0.0), {}};
}

/// A point's place among the nodes: its own node, or the one whose shape function is largest there.
mesh::NodeIndex node_of(const contact::SlavePoint& point) {
  const auto largest = std::ranges::max_element(point.shape, {}, [](double n) { return std::abs(n); });
  return point.nodes[static_cast<std::size_t>(largest - point.shape.begin())];
}

/// Of several points on one node, those of sides of an edge or of zones, the one tells that touches, else one
/// that faces something.
int says_most(const contact::ZoneState& state, std::size_t point) {
  if (contact::reported_status(state, point) != Status::open)
    return 2;
  return std::isfinite(state.outcomes[point].gap) ? 1 : 0;
}

void put_pressure(const contact::Zone& zone, const contact::ZoneState& state, std::vector<double>& values) {
  const auto pressure = contact::nodal_pressure(zone, state);
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (auto& value = values[static_cast<std::size_t>(zone.slave.nodes[i])];
        std::abs(pressure[i]) > std::abs(value))
      value = pressure[i];
}

} // namespace

std::vector<OwnedField> contact_fields(const Model& model, const step::State& now) {
  auto pressure = scalar_field(model, "contact_pressure");
  auto gap = scalar_field(model, "contact_gap");
  auto status = scalar_field(model, "contact_status");
  auto cumulated = scalar_field(model, "contact_cumulated_slip");
  auto work = scalar_field(model, "contact_friction_work");
  const int tangents = model.dofs.components - 1;
  OwnedField slip{"contact_slip",
                  tangents,
                  {},
                  tangents == 1 ? std::vector<std::string>{"t"} : std::vector<std::string>{"t1", "t2"}};
  slip.values.assign(static_cast<std::size_t>(model.mesh.node_count() * tangents), 0.0);
  std::vector<int> told(static_cast<std::size_t>(model.mesh.node_count()), 0);
  for (std::size_t z = 0; z < model.zones.size(); ++z) {
    const auto& zone = model.zones[z];
    const auto& state = now.zones[z];
    put_pressure(zone, state, pressure.values);
    for (std::size_t i = 0; i < zone.points.size(); ++i) {
      const auto node = static_cast<std::size_t>(node_of(zone.points[i]));
      const auto& outcome = state.outcomes[i];
      const auto& history = state.friction_history[i];
      cumulated.values[node] = std::max(cumulated.values[node], history.slip);
      work.values[node] += history.work;
      if (says_most(state, i) < told[node])
        continue;
      told[node] = says_most(state, i);
      gap.values[node] = std::isfinite(outcome.gap) ? outcome.gap : 0.0;
      status.values[node] = static_cast<double>(contact::reported_status(state, i));
      for (int a = 0; state.status[i] != Status::open && a < tangents; ++a)
        slip.values[node * static_cast<std::size_t>(tangents) + static_cast<std::size_t>(a)] =
            outcome.slip[a];
    }
  }
  return {pressure, gap, slip, status, cumulated, work};
}

std::vector<OwnedField> stress_fields(const Model& model, const step::State& now) {
  const auto recovered = domain::nodal_stress(model.mesh, model.bulk, model.dofs, now.motion.u,
                                              {model.domain.heat(), now.t}, &now.bulk_points, model.threads);
  const auto& stress = recovered.stress;
  return {{"stress", 6, {stress.data(), stress.data() + stress.size()}, tensor_components},
          {"von_mises", 1, {recovered.von_mises.begin(), recovered.von_mises.end()}, {}}};
}

std::vector<OwnedField> other_stress_fields(const OwnedField& stress) {
  const Eigen::Map<const Eigen::MatrixXd> stresses(
      stress.values.data(), stress.components, static_cast<Index>(stress.values.size()) / stress.components);
  std::vector<OwnedField> fields;
  for (const auto what :
       {study::ProbeField::tresca, study::ProbeField::mean_stress, study::ProbeField::principal_stress}) {
    const Eigen::MatrixXd values = of_stresses(what, stresses);
    fields.push_back({std::string(study::word_of(study::probe_field_words, what)),
                      static_cast<int>(values.rows()),
                      {values.data(), values.data() + values.size()},
                      study::components_of(what, 3)});
  }
  return fields;
}

namespace {

OwnedField tensor_field(const Model& model, const step::State& now, domain::Tensor what, std::string name) {
  const auto tensors = domain::nodal_tensors(what, model.mesh, model.bulk, model.dofs, now.motion.u,
                                             {model.domain.heat(), now.t}, &now.bulk_points, model.threads);
  return {std::move(name), 6, {tensors.data(), tensors.data() + tensors.size()}, tensor_components};
}

} // namespace

OwnedField strain_field(const Model& model, const step::State& now) {
  return tensor_field(model, now, domain::Tensor::strain, "strain");
}

OwnedField plastic_strain_field(const Model& model, const step::State& now) {
  return tensor_field(model, now, domain::Tensor::plastic_strain, "plastic_strain");
}

OwnedField cumulated_plastic_strain_field(const Model& model, const step::State& now) {
  const auto values =
      domain::nodal_plastic_strain(model.mesh, model.bulk, model.dofs, now.motion.u,
                                   {model.domain.heat(), now.t}, &now.bulk_points, model.threads);
  return {"cumulated_plastic_strain", 1, {values.begin(), values.end()}, {}};
}

VectorXd internal_force(const Model& model, const step::State& now) {
  if (model.parts)
    return now.bulk.internal;
  VectorXd force;
  domain::QuadratureStates unchanged;
  model.domain.evaluate({now.motion.u, now.motion.u, now.t, now.t}, now.bulk_points, unchanged,
                        {.forces = &force});
  return force;
}

VectorXd contact_force(const Model& model, const step::State& now) {
  return now.contact_force.size() > 0 ? VectorXd(-now.contact_force) : VectorXd::Zero(model.dofs.dof_count);
}

OwnedField temperature_field(const Model& model, double t) {
  auto field = scalar_field(model, "temperature");
  const auto temperatures = model.domain.heat()->temperatures(t);
  for (std::size_t i = 0; i < model.dofs.nodes.size(); ++i)
    field.values[static_cast<std::size_t>(model.dofs.nodes[i])] = temperatures[static_cast<Index>(i)];
  return field;
}

namespace {

/// What of the fields to write.
class Wanted {
public:
  Wanted(const Model& model, const study::FieldOutput& output)
      : stored_(study::stored_fields(model.dofs.components)), output_(output) {}

  bool operator()(std::string_view name) const {
    return study::is_written(output_, *std::ranges::find(stored_, name, &study::StoredField::name));
  }
  bool any(std::initializer_list<std::string_view> names) const { return std::ranges::any_of(names, *this); }
  /// Not as one of the usual ones.
  bool by_name(std::string_view name) const {
    const auto has = [&](const auto& names) { return std::ranges::find(names, name) != names.end(); };
    return has(output_.only) || has(output_.also);
  }

private:
  std::vector<study::StoredField> stored_;
  const study::FieldOutput& output_;
};

/// Stresses and what is made of them, as far as anything of it is wanted.
void add_stresses(const Model& model, const step::State& now, const Wanted& is_wanted,
                  std::vector<OwnedField>& usual, std::vector<OwnedField>& others) {
  const bool any_other = is_wanted.any({"tresca", "mean_stress", "principal_stress"});
  if (!any_other && !is_wanted.any({"stress", "von_mises"}))
    return;
  auto stresses = stress_fields(model, now);
  if (any_other)
    others = other_stress_fields(stresses.front());
  std::ranges::move(stresses, std::back_inserter(usual));
}

} // namespace

std::vector<OwnedField> nodal_fields(const Model& model, const step::State& now,
                                     const study::FieldOutput& output) {
  const Wanted is_wanted(model, output);
  std::vector<OwnedField> fields;
  fields.push_back(vector_field(model, "displacement", now.motion.u));
  fields.push_back(vector_field(model, "velocity", now.motion.v));
  fields.push_back(vector_field(model, "acceleration", now.motion.a));
  std::vector<OwnedField> others;
  add_stresses(model, now, is_wanted, fields, others);
  if (is_wanted("cumulated_plastic_strain") &&
      (study::yields(model.study) || is_wanted.by_name("cumulated_plastic_strain")))
    fields.push_back(cumulated_plastic_strain_field(model, now));
  if (model.domain.heat() != nullptr)
    fields.push_back(temperature_field(model, now.t));
  if (!model.zones.empty())
    std::ranges::move(contact_fields(model, now), std::back_inserter(fields));
  if (is_wanted("strain"))
    fields.push_back(strain_field(model, now));
  if (is_wanted("plastic_strain"))
    fields.push_back(plastic_strain_field(model, now));
  std::ranges::move(others, std::back_inserter(fields));
  std::erase_if(fields, [&](const OwnedField& field) { return !is_wanted(field.name); });
  if (is_wanted("reaction"))
    fields.push_back(vector_field(model, "reaction", now.reaction));
  if (is_wanted("internal_force"))
    fields.push_back(vector_field(model, "internal_force", internal_force(model, now)));
  if (is_wanted("contact_force"))
    fields.push_back(vector_field(model, "contact_force", contact_force(model, now)));
  return fields;
}

Resultants contact_resultants(const contact::ZoneState& state) {
  Resultants sum;
  sum.smallest_gap = std::numeric_limits<double>::infinity();
  Eigen::Vector3d tangential = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < state.outcomes.size(); ++i) {
    const auto& outcome = state.outcomes[i];
    sum.smallest_gap = std::min(sum.smallest_gap, outcome.gap);
    if (state.status[i] == Status::open)
      continue;
    ++sum.in_contact;
    sum.sticking += state.status[i] == Status::stick ? 1 : 0;
    sum.normal += outcome.normal.norm();
    sum.force += outcome.normal + outcome.tangential;
    tangential += outcome.tangential;
    sum.largest_pressure = std::max(sum.largest_pressure, outcome.pressure);
  }
  sum.friction = tangential.norm();
  return sum;
}

} // namespace rubato::results
