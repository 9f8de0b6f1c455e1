// SPDX-License-Identifier: LGPL-3.0-or-later
// Relations between displacements, and where references may be named.
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {
namespace {

bool is_zero(const std::array<double, 3>& vector) {
  return std::ranges::all_of(vector, [](double number) { return number == 0; });
}

void check_equation(Rules& rules, const Relation& relation, const std::string& path) {
  for (std::size_t i = 0; i < relation.terms.size(); ++i) {
    const auto& term = relation.terms[i];
    const auto at = fmt::format("{}.terms.{}", path, i);
    rules.name(at + ".on", term.on);
    for (std::size_t axis = 0; axis < term.coefficients.size(); ++axis) {
      rules.number(fmt::format("{}.{}", at, axis_words.at(axis)), term.coefficients.at(axis));
      if (term.coefficients.at(axis) != 0)
        rules.axis(fmt::format("{}.{}", at, axis_words.at(axis)), axis);
    }
    if (is_zero(term.coefficients))
      rules.broken({at, at + ".x", at + ".y", at + ".z"},
                   "has no coefficient, expected at least one of x, y, z");
  }
  if (relation.terms.empty())
    rules.broken({path + ".terms"}, "found an empty list, expected at least one term");
  rules.field(path + ".value", relation.value);
}

void check_pairs(Rules& rules, const Relation& relation, const std::string& path) {
  rules.name(path + ".with", relation.with);
  if (relation.on == relation.with)
    rules.broken({path + ".with", path + ".on"},
                 fmt::format("found {} on both sides, expected two groups", shown(relation.on)));
  for (std::size_t axis = 0; axis < relation.difference.size(); ++axis) {
    const auto& difference = relation.difference.at(axis);
    const auto at = fmt::format("{}.difference.{}", path, axis_words.at(axis));
    rules.field(at, difference);
    if (difference == Field())
      continue;
    rules.axis(at, axis);
    if (!relation.components.at(axis))
      rules.broken({at, path + ".in"},
                   fmt::format("found a difference along {}, which 'in' leaves free", axis_words.at(axis)));
  }
}

void check_reference(Rules& rules, const Relation& relation, const std::string& path) {
  if (rules.study.physics == Physics::axisymmetric)
    rules.broken({path, "physics"},
                 "a body of revolution moves as a rigid one along its axis only, expected {equal: {on: …, "
                 "in: y}}");
  if (relation.at)
    for (std::size_t axis = 0; axis < relation.at->size(); ++axis)
      rules.number(fmt::format("{}.at.{}", path, axis), relation.at->at(axis));
}

void check_embedded(Rules& rules, const Relation& relation, const std::string& path) {
  if (relation.on.empty() != relation.at.has_value())
    rules.broken({path, path + ".on", path + ".at"}, "expected one of 'on' and 'at'");
  if (!relation.on.empty() && relation.on == relation.cells)
    rules.broken(
        {path + ".in", path + ".on"},
        fmt::format("found {} on both sides, expected the cells of another body", shown(relation.on)));
  if (relation.at)
    for (std::size_t axis = 0; axis < relation.at->size(); ++axis)
      rules.number(fmt::format("{}.at.{}", path, axis), relation.at->at(axis));
}

void check_relation(Rules& rules, const Relation& relation, const std::string& path) {
  if (relation.kind == RelationKind::embedded)
    return check_embedded(rules, relation, path);
  if (relation.kind == RelationKind::equation)
    return check_equation(rules, relation, path);
  rules.name(path + ".on", relation.on);
  if (has_reference(relation))
    return check_reference(rules, relation, path);
  if (std::ranges::none_of(relation.components, [](bool component) { return component; }))
    rules.broken({path + ".in"}, "found an empty list, expected at least one of x, y, z");
  const bool all = std::ranges::all_of(relation.components, [](bool component) { return component; });
  for (std::size_t axis = 0; axis < relation.components.size(); ++axis)
    if (!all && relation.components.at(axis))
      rules.axis(path + ".in", axis);
  if (relation.kind == RelationKind::pairs)
    check_pairs(rules, relation, path);
}

} // namespace

bool is_reference(const Study& study, const std::string& name) {
  return std::ranges::any_of(study.relations, [&](const Relation& relation) {
    return relation.name == name && has_reference(relation);
  });
}

void check_rotation(Rules& rules, const std::string& name, std::vector<std::string> paths) {
  if (!is_reference(rules.study, name))
    return rules.broken(std::move(paths), expected_reference(rules.study, name));
  const auto relation = std::ranges::find(rules.study.relations, name, &Relation::name);
  if (!has_rotation(relation->kind))
    rules.broken(
        std::move(paths),
        fmt::format("{} is a place in a cell, which has no rotation; expected the reference of a rigid "
                    "or distributed relation",
                    shown(name)));
}

std::string expected_reference(const Study& study, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& relation : study.relations)
    if (has_reference(relation))
      names.push_back(relation.name);
  return names.empty()
             ? fmt::format("found {}, expected a reference: the name of a rigid, distributed or embedded "
                           "relation, of "
                           "which there is none",
                           shown(name))
             : fmt::format("found {}, which is no reference of a rigid, distributed or embedded relation{}",
                           shown(name), suggestion(name, names));
}

void check_relations(Rules& rules) {
  std::vector<std::string> names;
  for (const auto& relation : rules.study.relations) {
    const auto path = "relations." + relation.name;
    rules.chosen_name(path, relation.name, names);
    names.push_back(relation.name);
    check_relation(rules, relation, fmt::format("{}.{}", path, word_of(relation_words, relation.kind)));
  }
}

} // namespace rubato::study
