// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/tables.hpp"

#include "rubato/mesh/names.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/references.hpp"
#include "rubato/results/frd_blocks.hpp"
#include "rubato/results/table_lines.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace rubato::results {
namespace {

using Values = std::array<double, 3>;

/// A quantity of nodes: its heading, that of its sum, and how many columns it has.
struct NodeQuantity {
  std::string_view word;
  std::string_view heading;
  std::string_view total;
  std::size_t columns = 3;
};
constexpr std::array node_quantities{NodeQuantity{"U", "displacements (vx,vy,vz) ", ""},
                                     NodeQuantity{"V", "velocities (vx,vy,vz) ", ""},
                                     NodeQuantity{"A", "accelerations (vx,vy,vz) ", ""},
                                     NodeQuantity{"RF", "forces (fx,fy,fz) ", "total force (fx,fy,fz) "},
                                     NodeQuantity{"NT", "temperatures ", "", 1},
                                     NodeQuantity{"UR", "displacements (vx,vy,vz) ", ""},
                                     NodeQuantity{"RM", "forces (fx,fy,fz) ", ""}};

class NodeValues {
public:
  NodeValues(const TableSource& source, std::string_view word) : source_(source), word_(word) {
    const auto& model = source.model;
    if (word == "U" || word == "UR")
      values_ = source.now.motion.u;
    else if (word == "V")
      values_ = source.now.motion.v;
    else if (word == "A")
      values_ = source.now.motion.a;
    else if (word == "RF" || word == "RM")
      values_ = balanced_force(model, source.now);
    else if (model.domain.heat() != nullptr)
      temperatures_ = temperature_field(model, source.now.t).values;
  }

  Values at(mesh::NodeIndex node) const {
    const auto& dofs = source_.model.dofs;
    if (word_ == "NT")
      return {temperatures_.empty() ? 0.0 : temperatures_[static_cast<std::size_t>(node)], 0, 0};
    if (!dofs.has(node))
      return of_reference(node);
    Values values{};
    if (word_ == "UR" || word_ == "RM")
      return values;
    for (int i = 0; i < dofs.components; ++i)
      values.at(static_cast<std::size_t>(i)) = values_[dofs.dof(node, i)];
    return values;
  }

private:
  /// The motion of a node without cells in the place of a reference, or the forces on the nodes that the
  /// reference moves.
  Values of_reference(mesh::NodeIndex node) const {
    const auto& model = source_.model;
    const auto& place = model.mesh.points[static_cast<std::size_t>(node)];
    const auto found = std::ranges::find_if(
        model.references, [&](const model::Reference& reference) { return reference.place == place; });
    if (found == model.references.end())
      return {};
    if (word_ == "RF" || word_ == "RM")
      return force_on(*found);
    const Eigen::VectorXd motion = found->motion * values_(found->dofs);
    const int components = model.dofs.components;
    Values values{};
    if (word_ != "UR")
      std::copy(motion.begin(), motion.begin() + components, values.begin());
    else if (components == 3)
      std::copy(motion.begin() + components, motion.end(), values.begin());
    else
      values[2] = motion[components];
    return values;
  }

  /// The force on the nodes that a reference moves, or its moment about it.
  Values force_on(const model::Reference& reference) const {
    const auto& model = source_.model;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (const auto node : reference.nodes) {
      Eigen::Vector3d here = Eigen::Vector3d::Zero();
      for (int i = 0; i < model.dofs.components; ++i)
        here[i] = values_[model.dofs.dof(node, i)];
      force += here;
      moment += (model.mesh.points[static_cast<std::size_t>(node)] - reference.place).cross(here);
    }
    const auto& wanted = word_ == "RM" ? moment : force;
    return {wanted.x(), wanted.y(), wanted.z()};
  }

  const TableSource& source_;
  std::string_view word_;
  Eigen::VectorXd values_;
  std::vector<double> temperatures_;
};

std::vector<mesh::NodeIndex> table_nodes(const TableSource& source) {
  const auto& model = source.model;
  std::vector<mesh::NodeIndex> nodes;
  if (source.table.on.empty())
    nodes = model.dofs.nodes;
  else if (const auto* reference = model::reference_named(model.references, source.table.on)) {
    const auto at = std::ranges::find(model.mesh.points, reference->place);
    if (at != model.mesh.points.end())
      nodes = {static_cast<mesh::NodeIndex>(at - model.mesh.points.begin())};
  } else {
    nodes = mesh::find_nodes(model.mesh, source.table.on).nodes;
  }
  std::ranges::sort(nodes, {},
                    [&](auto node) { return source.numbers.nodes[static_cast<std::size_t>(node)]; });
  return nodes;
}

} // namespace

std::string_view label_of(const study::PrintedTable& table) {
  return !table.label.empty() ? std::string_view(table.label)
         : table.on.empty()   ? std::string_view("ALL")
                              : std::string_view(table.on);
}

bool has_lines(const study::PrintedTable& table) {
  return table.totals != study::TableTotals::only;
}

bool has_totals(const study::PrintedTable& table) {
  return table.totals != study::TableTotals::none;
}

bool lists(const study::PrintedTable& table, std::string_view quantity) {
  return std::ranges::find(table.quantities, quantity) != table.quantities.end();
}

void TableText::numbers(std::span<const double> values) {
  for (const double value : values)
    fmt::format_to(std::back_inserter(text_), "{:14.6E}", std::abs(value) < 1e-99 ? 0.0 : value);
  text_ += '\n';
}

void add_node_tables(const TableSource& source, TableText& text) {
  const auto nodes = table_nodes(source);
  for (const auto& word : source.table.quantities) {
    const auto* const found = std::ranges::find(node_quantities, word, &NodeQuantity::word);
    if (found == node_quantities.end())
      continue;
    const auto& quantity = *found;
    const NodeValues values(source, quantity.word);
    const bool summed = !quantity.total.empty() && has_totals(source.table);
    const bool listed = !summed || has_lines(source.table);
    Values sum{};
    if (listed)
      text.heading(quantity.heading, label_of(source.table));
    for (const auto node : nodes) {
      const auto row = values.at(node);
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum.at(i) += row.at(i);
      if (listed)
        text.line(source.numbers.nodes[static_cast<std::size_t>(node)],
                  std::span(row).first(quantity.columns));
    }
    if (!summed)
      continue;
    text.heading(quantity.total, label_of(source.table));
    text.indented(total_indent, sum);
  }
}

Tables::Tables(const model::Model& model, const std::filesystem::path& path)
    : model_(&model), file_(path), numbers_(ccx_numbers(model.mesh)), contact_(model) {}

Tables::Tables(const model::Model& model, const std::filesystem::path& path, std::uintmax_t bytes)
    : model_(&model), file_(path, bytes), numbers_(ccx_numbers(model.mesh)), contact_(model) {}

void Tables::write(const step::State& now, int number, bool last) {
  TableText text(now.t);
  for (const auto& table : model_->study.fields.tables) {
    if (table.every == 0 || (!last && number % table.every != 0))
      continue;
    const TableSource source{*model_, now, numbers_, table};
    switch (table.of) {
    case study::TableOf::nodes:
      add_node_tables(source, text);
      break;
    case study::TableOf::cells:
      add_cell_tables(source, text);
      break;
    case study::TableOf::faces:
      add_face_tables(source, text);
      break;
    case study::TableOf::zones:
      add_contact_tables(source, contact_, text);
      break;
    }
  }
  if (!text.text().empty())
    file_.add(std::string_view(text.text()).substr(0, text.text().size() - 1));
}

} // namespace rubato::results
