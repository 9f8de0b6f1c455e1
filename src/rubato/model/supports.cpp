// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/model/relations.hpp"
#include "rubato/model/rotations.hpp"
#include "rubato/study/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <span>

namespace rubato::model {
namespace {

using constraint::Contradiction;
using constraint::PrescribedDof;

/// Sources that a contradiction names.
constexpr std::size_t named_sources = 4;

class SupportCollector {
public:
  SupportCollector(const Parts& parts, std::vector<Fault>& faults) : parts_(parts), faults_(faults) {}

  void add(const study::Support& support, const std::string& path) {
    try {
      if (reference_named(parts_.references, support.on) != nullptr)
        return hold_reference(support, path);
      if (support.along)
        add_oblique(parts_, support, path, equations_, faults_);
      if (support.rotate)
        rotate(support, path);
      else if (has_components(support))
        prescribe(support, path);
    } catch (const InputError& error) {
      std::ranges::copy(error.faults(), std::back_inserter(faults_));
    }
  }

  void add(const study::Relation& relation) {
    try {
      add_relation(parts_, relation, equations_, faults_);
    } catch (const InputError& error) {
      std::ranges::copy(error.faults(), std::back_inserter(faults_));
    }
  }

  void add(const study::Preload& preload, const PreloadedCut& cut, const std::optional<double>& locked) {
    try {
      add_preload(parts_, preload, cut, locked, equations_);
    } catch (const InputError& error) {
      std::ranges::copy(error.faults(), std::back_inserter(faults_));
    }
  }

  void add(const contact::Zone& tied) { add_tie(parts_, tied, equations_); }

  constraint::Reduction reduction(std::vector<std::string>& notes) {
    std::vector<PrescribedDof> list;
    for (const auto& [dof, prescribed] : by_dof_)
      list.push_back(prescribed);
    const std::array instants = sample_instants();
    auto found = constraint::eliminate(list, equations_.list, instants);
    tell(found.contradictions);
    refuse_dense(found.dependents);
    note_redundant(found.redundant, notes);
    return number_right_sides(std::move(list), std::move(found.dependents));
  }

private:
  static bool has_components(const study::Support& support) {
    return std::ranges::any_of(support.components,
                               [](const auto& component) { return component.has_value(); });
  }

  void hold_reference(const study::Support& support, const std::string& path) {
    const auto& reference = *reference_named(parts_.references, support.on);
    const bool turned = std::ranges::any_of(support.turns, [](const auto& turn) { return turn.has_value(); });
    if (turned && !reference.turns)
      return faults_.push_back(
          fault_at(path + ".turn", fmt::format("the nodes of '{}' lie on a line or in a point and "
                                               "tell no rotation, expected a displacement",
                                               reference.name)));
    if (support.along && support.along->normal)
      return faults_.push_back(
          fault_at(path + ".along",
                   fmt::format("the reference '{}' has no faces, expected a direction", reference.name)));
    add_held_reference(parts_, support, path, equations_);
  }

  void prescribe(const study::Support& support, const std::string& path) {
    const auto nodes =
        body_nodes_or_fault(parts_.mesh, parts_.dofs, {support.on, path + ".on"}, "to hold", faults_);
    for (int i = 0; i < parts_.dofs.components; ++i)
      if (const auto& displacement = support.components[static_cast<std::size_t>(i)])
        prescribe(path, nodes, i, *displacement);
  }

  /// Every component of every node: translations that are not given are 0.
  void rotate(const study::Support& support, const std::string& path) {
    const auto nodes =
        body_nodes_or_fault(parts_.mesh, parts_.dofs, {support.on, path + ".on"}, "to hold", faults_);
    const auto rotation = shared_rotation(parts_, *support.rotate, path + ".rotate");
    check_angle(parts_, nodes, *rotation, path + ".rotate");
    for (int i = 0; i < parts_.dofs.components; ++i) {
      const auto& given = support.components[static_cast<std::size_t>(i)];
      const auto field =
          shared_field(parts_, given.value_or(study::Field()), fmt::format("{}.{}", path, "xyz"[i]));
      for (const auto node : nodes) {
        PrescribedDof wanted{parts_.dofs.dof(node, i), imposed_at(parts_, node, field)};
        const auto& place = parts_.mesh.points[static_cast<std::size_t>(node)];
        if (!constraint::leaves(*rotation, place, i))
          wanted.imposed.rotation =
              std::make_shared<const constraint::RotatedPlace>(constraint::RotatedPlace{rotation, place, i});
        prescribe(path, node, i, wanted);
      }
    }
  }

  void prescribe(const std::string& path, std::span<const mesh::NodeIndex> nodes, int component,
                 const study::Field& displacement) {
    const auto at = fmt::format("{}.{}", path, "xyz"[static_cast<std::size_t>(component)]);
    const auto field = shared_field(parts_, displacement, at);
    for (const auto node : nodes)
      prescribe(path, node, component,
                PrescribedDof{parts_.dofs.dof(node, component), imposed_at(parts_, node, field)});
  }

  void prescribe(const std::string& path, mesh::NodeIndex node, int component, const PrescribedDof& wanted) {
    const auto [entry, fresh] = by_dof_.emplace(wanted.dof, wanted);
    if (fresh || entry->second == wanted || told_)
      return;
    told_ = true;
    faults_.push_back(fault_at(path, fmt::format("node {} has two different displacements prescribed in {}",
                                                 node_label(parts_.mesh, node),
                                                 "xyz"[static_cast<std::size_t>(component)])));
  }

  /// Where right sides of equations are compared: the ends of the run and three instants without a pattern.
  std::array<double, 5> sample_instants() const {
    const auto& time = parts_.study.time;
    const auto at = [&](double part) { return time.begin + part * (time.end - time.begin); };
    return {time.begin, at(0.2137), at(0.5411), at(0.8093), time.end};
  }

  const std::string& path_of(int equation) const {
    const auto source = equations_.list[static_cast<std::size_t>(equation)].source;
    return equations_.paths[static_cast<std::size_t>(source)];
  }

  std::string place_of(int dof) const {
    const int components = parts_.dofs.components;
    return fmt::format("{} in {}",
                       node_label(parts_.mesh, parts_.dofs.nodes[static_cast<std::size_t>(dof / components)]),
                       "xyz"[static_cast<std::size_t>(dof % components)]);
  }

  /// One for each source.
  void tell(const std::vector<Contradiction>& contradictions) {
    std::set<std::string> told;
    for (const auto& found : contradictions) {
      const auto& path = path_of(found.equation);
      if (!told.insert(path).second)
        continue;
      std::set<std::string> others;
      for (const int other : found.others)
        others.insert(path_of(other));
      others.erase(path);
      if (!found.dofs.empty())
        others.insert(fmt::format("the support of node {}", place_of(found.dofs.front())));
      std::vector<std::string> named(others.begin(), others.end());
      if (named.size() > named_sources)
        named.resize(named_sources);
      const auto dof = equations_.list[static_cast<std::size_t>(found.equation)].terms.front().dof;
      faults_.push_back(fault_at(
          path, fmt::format("{} contradicts {} at node {}: {:.3g} is left at t = {}; expected relations that "
                            "can hold together",
                            path, named.empty() ? std::string("itself") : joined(named, ", "), place_of(dof),
                            found.excess, found.at)));
    }
  }

  /// A dof that depends on k others couples them all with one another: k² entries of the matrix.
  void refuse_dense(const std::vector<constraint::DependentDof>& dependents) {
    double entries = 0;
    for (const auto& dependent : dependents)
      entries += std::pow(static_cast<double>(dependent.of.size()), 2);
    const double bytes = entries * (sizeof(double) + sizeof(int));
    if (bytes < 0.5 * static_cast<double>(linalg::available_memory()))
      return;
    const auto largest = std::ranges::max_element(
        equations_.list, {}, [](const constraint::Equation& equation) { return equation.terms.size(); });
    const auto& path = equations_.paths[static_cast<std::size_t>(largest->source)];
    faults_.push_back(fault_at(
        path, fmt::format(
                  "{} relates {} displacements in one equation, which couples them all: {:.3g} GB beside the "
                  "rest of the matrix; expected a smaller group, or a rigid relation instead of a "
                  "distributed one that is held",
                  path, largest->terms.size(), bytes / 1e9)));
  }

  void note_redundant(const std::vector<int>& redundant, std::vector<std::string>& notes) const {
    std::map<std::string, int> count;
    for (const int equation : redundant)
      ++count[path_of(equation)];
    for (const auto& [path, number] : count)
      notes.push_back(fmt::format("{}: {} of its equations {} from supports and relations before and {} left "
                                  "out",
                                  path, number, number == 1 ? "follows" : "follow",
                                  number == 1 ? "is" : "are"));
  }

  constraint::Reduction number_right_sides(std::vector<PrescribedDof> list,
                                           std::vector<constraint::DependentDof> dependents) {
    std::map<int, int> numbers;
    std::vector<constraint::ImposedValue> right_sides;
    for (std::size_t i = 0; i < equations_.list.size(); ++i)
      if (equations_.list[i].has_multiplier) {
        numbers.emplace(static_cast<int>(i), static_cast<int>(right_sides.size()));
        right_sides.push_back(equations_.list[i].value);
      }
    for (auto& dependent : dependents)
      for (auto& term : dependent.given) {
        const auto [entry, fresh] = numbers.emplace(term.dof, static_cast<int>(right_sides.size()));
        if (fresh)
          right_sides.push_back(equations_.list[static_cast<std::size_t>(term.dof)].value);
        term.dof = entry->second;
      }
    return {parts_.dofs.dof_count, std::move(list), std::move(dependents), std::move(right_sides)};
  }

  const Parts& parts_;
  std::vector<Fault>& faults_;
  std::map<int, PrescribedDof> by_dof_;
  Equations equations_;
  bool told_ = false;
};

} // namespace

constraint::Reduction make_reduction(const study::Study& study, const mesh::Mesh& mesh,
                                     const domain::DofMap& dofs, std::span<const Reference> references,
                                     std::vector<Fault>& faults, std::vector<std::string>& notes,
                                     std::span<const PreloadedCut> preloads, const Stage& stage,
                                     std::span<const contact::Zone> ties) {
  const Parts parts{study, mesh, dofs, references};
  SupportCollector collector(parts, faults);
  for (std::size_t i = 0; i < study.supports.size(); ++i)
    if (const auto& support = study.supports[i]; !(support.until && *support.until <= stage.released))
      collector.add(support, fmt::format("supports.{}", i));
  for (const auto& relation : study.relations)
    collector.add(relation);
  for (std::size_t i = 0; i < preloads.size(); ++i) {
    std::optional<double> locked;
    if (is_locked(study.preload[i], stage))
      locked = stage.shortening.size() > 0 ? stage.shortening[static_cast<Eigen::Index>(i)] : 0.0;
    collector.add(study.preload[i], preloads[i], locked);
  }
  for (const auto& zone : ties)
    if (zone.settings.tie)
      collector.add(zone);
  auto reduction = collector.reduction(notes);
  if (auto base = make_base(study, faults);
      std::ranges::any_of(base, [](const auto& component) { return component.has_value(); }))
    reduction.carry(std::move(base), dofs.components);
  return reduction;
}

} // namespace rubato::model
