// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/inp/points.hpp"

#include "rubato/core/naming.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::inp {
namespace {

/// Coefficients below this part of the largest are rounding.
constexpr double coefficient_rounding = 1e-14;
/// Distances from an axis below this part of the distance to its point are rounding.
constexpr double on_axis = 1e-10;

/// A unit vector across another one.
Eigen::Vector3d across(const Eigen::Vector3d& axis) {
  return axis.unitOrthogonal();
}

std::array<bool, 3> used_of(const study::RelationTerm& term) {
  return {term.coefficients[0] != 0, term.coefficients[1] != 0, term.coefficients[2] != 0};
}

} // namespace

Eigen::Vector3d point_of(const Reading& reading, std::int32_t node) {
  return reading.content.points[static_cast<std::size_t>(node)];
}

Eigen::Matrix3d axes_at(const LocalAxes& axes, const Eigen::Vector3d& place) {
  if (axes.kind == LocalAxes::Kind::rectangular)
    return axes.turn;
  const Eigen::Vector3d arm = place - axes.origin;
  const Eigen::Vector3d line = axes.turn.col(2);
  const bool sphere = axes.kind == LocalAxes::Kind::spherical;
  const Eigen::Vector3d away = arm - arm.dot(line) * line;
  const bool centred = away.norm() <= on_axis * std::max(arm.norm(), 1e-300);
  const Eigen::Vector3d outwards = centred ? across(line) : away.normalized();
  Eigen::Matrix3d turned;
  turned.col(0) = sphere && arm.norm() > 0 ? Eigen::Vector3d(arm.normalized()) : outwards;
  turned.col(1) = line.cross(outwards);
  turned.col(2) = turned.col(0).cross(turned.col(1));
  return turned;
}

bool has_own_axes(const Reading& reading, std::int32_t node) {
  return reading.axes_of_node.contains(node);
}

Eigen::Matrix3d axes_of(const Reading& reading, std::int32_t node) {
  const auto found = reading.axes_of_node.find(node);
  if (found == reading.axes_of_node.end())
    return Eigen::Matrix3d::Identity();
  auto axes = axes_at(reading.transforms[found->second], point_of(reading, node));
  constexpr double rounding = 1e-13;
  return axes.unaryExpr([](double value) {
    const double whole = std::round(value);
    return std::abs(value - whole) < rounding ? whole : value;
  });
}

void Sum::add(std::int32_t node, const Eigen::Vector3d& coefficients) {
  const auto known = std::ranges::find(terms_, node, &std::pair<std::int32_t, Eigen::Vector3d>::first);
  if (known == terms_.end())
    terms_.emplace_back(node, coefficients);
  else
    known->second += coefficients;
}

void add_equation(Reading& reading, const Sum& sum, std::string_view label, const Word& at) {
  double largest = 0;
  for (const auto& [node, coefficients] : sum.terms())
    largest = std::max(largest, coefficients.cwiseAbs().maxCoeff());
  study::Relation relation;
  relation.kind = study::RelationKind::equation;
  for (const auto& [node, coefficients] : sum.terms()) {
    study::RelationTerm term;
    term.on = node_name(reading, node);
    for (int axis = 0; axis < reading.dimension(); ++axis)
      if (std::abs(coefficients[axis]) > coefficient_rounding * largest)
        term.coefficients.at(static_cast<std::size_t>(axis)) = coefficients[axis];
    if (term.coefficients != std::array<double, 3>{})
      relation.terms.push_back(std::move(term));
    reading.used_nodes.insert(node);
  }
  if (relation.terms.empty())
    return;
  relation.name = chosen_name(reading, relation_kind, label);
  reading.places["relations." + relation.name] = at.at();
  reading.study.relations.push_back(std::move(relation));
}

std::optional<std::int32_t> one_node(Reading& reading, int scope, const Word& word) {
  const auto found = mesh::inp::find_nodes(reading.content, scope, word, reading.faults);
  if (!found)
    return std::nullopt;
  if (found->items.size() == 1)
    return found->items.front();
  reading.faults.add(word, fmt::format("found {}, a set of {} nodes, expected one node",
                                       shown(std::string(word.text)), found->items.size()));
  return std::nullopt;
}

void add_carried(const Reading& reading, std::int32_t reference, const Eigen::Vector3d& place,
                 const Eigen::Vector3d& direction, double factor, Sum& sum) {
  sum.add(reference, factor * direction);
  const auto rotation = reading.content.rotation_nodes.find(reference);
  if (rotation == reading.content.rotation_nodes.end())
    return;
  const Eigen::Vector3d about = (place - point_of(reading, reference)).cross(direction);
  sum.add(rotation->second, factor * (reading.dimension() == 3 ? about : Eigen::Vector3d(about.z(), 0, 0)));
}

bool is_of_body(const Reading& reading, std::int32_t node) {
  return reading.body_nodes[static_cast<std::size_t>(node)] != 0;
}

std::vector<Target> with_equal_axes(const Reading& reading, const Target& target) {
  if (target.reference != nullptr ||
      std::ranges::none_of(target.nodes, [&](std::int32_t node) { return has_own_axes(reading, node); }))
    return {target};
  const auto first = reading.axes_of_node.find(target.nodes.front());
  const bool same = first != reading.axes_of_node.end() &&
                    reading.transforms[first->second].kind == LocalAxes::Kind::rectangular &&
                    std::ranges::all_of(target.nodes, [&](std::int32_t node) {
                      const auto own = reading.axes_of_node.find(node);
                      return own != reading.axes_of_node.end() && own->second == first->second;
                    });
  if (same)
    return {target};
  std::vector<Target> parts;
  for (const auto node : target.nodes)
    parts.push_back({node_name(reading, node), {node}, nullptr, target.rotation});
  return parts;
}

bool is_unused(Reading& reading, const Target& target, const Word& at) {
  if (target.reference != nullptr || std::ranges::any_of(target.nodes, [&](std::int32_t node) {
        return is_of_body(reading, node) || reading.used_nodes.contains(node);
      }))
    return false;
  note(reading, at,
       fmt::format("no element, equation, spring or mass has the nodes of {}: the line is left out",
                   shown(target.name)));
  return true;
}

void turn_to_rotation(const Reading& reading, Target& target, int& dof) {
  const bool flat = reading.dimension() == 2;
  if (dof < 3 || target.rotation < 0 || (flat && dof != 5))
    return;
  target = {node_name(reading, target.rotation), {target.rotation}, nullptr, -1};
  dof = flat ? 0 : dof - 3;
}

void hold_unused(Reading& reading) {
  std::map<std::string, std::array<bool, 3>> used;
  for (const auto node : reading.used_nodes)
    if (!is_of_body(reading, node))
      used[node_name(reading, node)];
  for (const auto& [name, preload] : reading.pretensions)
    used.erase(name); // they are cuts
  if (used.empty())
    return;
  const auto use = [&](const std::string& name, const std::array<bool, 3>& axes) {
    if (const auto entry = used.find(name); entry != used.end())
      for (std::size_t axis = 0; axis < axes.size(); ++axis)
        entry->second.at(axis) = entry->second.at(axis) || axes.at(axis);
  };
  for (const auto& relation : reading.study.relations)
    for (const auto& term : relation.terms)
      use(term.on, used_of(term));
  for (const auto& connector : reading.study.connectors)
    for (const auto* end : {&connector.on, &connector.to})
      use(*end, connector.along ? used_of({"", *connector.along}) : std::array{true, true, true});
  for (const auto& mass : reading.study.masses)
    use(mass.on, {true, true, true});
  for (const auto& [name, axes] : used) {
    study::Support support;
    support.on = name;
    for (int axis = 0; axis < reading.dimension(); ++axis)
      if (!axes.at(static_cast<std::size_t>(axis)))
        support.components.at(static_cast<std::size_t>(axis)) = study::Field(0.0);
    if (std::ranges::any_of(support.components, [](const auto& given) { return given.has_value(); }))
      reading.study.supports.push_back(std::move(support));
  }
}

} // namespace rubato::inp
