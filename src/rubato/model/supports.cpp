// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/build.hpp"
#include "rubato/study/fields.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <span>

namespace rubato::model {
namespace {

using constraint::PrescribedDof;

class SupportCollector {
public:
  SupportCollector(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                   std::vector<Fault>& faults)
      : study_(study), mesh_(mesh), dofs_(dofs), faults_(faults) {}

  void add(const study::Support& support, const std::string& path) {
    const auto nodes = body_nodes_or_fault(mesh_, dofs_, {support.on, path + ".on"}, "to hold", faults_);
    for (int i = 0; i < dofs_.components; ++i)
      if (const auto& displacement = support.components[static_cast<std::size_t>(i)])
        prescribe(path, nodes, i, *displacement);
  }

  std::vector<PrescribedDof> prescribed() const {
    std::vector<PrescribedDof> list;
    for (const auto& [dof, prescribed] : by_dof_)
      list.push_back(prescribed);
    return list;
  }

private:
  void prescribe(const std::string& path, std::span<const mesh::NodeIndex> nodes, int component,
                 const study::Field& displacement) {
    const auto at = fmt::format("{}.{}", path, "xyz"[static_cast<std::size_t>(component)]);
    const auto field =
        std::make_shared<const FieldFunction>(study::field_function(displacement, study_.functions, at));
    try {
      for (const auto node : nodes)
        prescribe(path, node, component, prescribed_at(node, dofs_.dof(node, component), field));
    } catch (const InputError& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
    }
  }

  /// An expression that does not change with time, or a profile, is a number at each node.
  PrescribedDof prescribed_at(mesh::NodeIndex node, int dof,
                              const std::shared_ptr<const FieldFunction>& field) const {
    if (!field->expression && !field->profile)
      return {dof, field->number, field->function};
    const auto& x = mesh_.points[static_cast<std::size_t>(node)];
    const std::array place{x[0], x[1], x[2]};
    for (const double t : {study_.time.begin, study_.time.end})
      field->at(place, t); // throws now rather than in a step
    if (field->expression && field->expression->has('t'))
      return {dof, 0, std::nullopt,
              std::make_shared<const constraint::FieldAtPlace>(constraint::FieldAtPlace{field, place})};
    return {dof, field->multiplied_at(place, study_.time.begin), field->function};
  }

  void prescribe(const std::string& path, mesh::NodeIndex node, int component, const PrescribedDof& wanted) {
    const auto [entry, fresh] = by_dof_.emplace(wanted.dof, wanted);
    if (fresh || entry->second == wanted || told_)
      return;
    told_ = true;
    faults_.push_back(
        fault_at(path, fmt::format("node {} has two different displacements prescribed in {}",
                                   node_label(mesh_, node), "xyz"[static_cast<std::size_t>(component)])));
  }

  const study::Study& study_;
  const mesh::Mesh& mesh_;
  const domain::DofMap& dofs_;
  std::vector<Fault>& faults_;
  std::map<int, PrescribedDof> by_dof_;
  bool told_ = false;
};

} // namespace

constraint::Reduction make_reduction(const study::Study& study, const mesh::Mesh& mesh,
                                     const domain::DofMap& dofs, std::vector<Fault>& faults) {
  SupportCollector collector(study, mesh, dofs, faults);
  for (std::size_t i = 0; i < study.supports.size(); ++i)
    collector.add(study.supports[i], fmt::format("supports.{}", i));
  return {dofs.dof_count, collector.prescribed()};
}

} // namespace rubato::model
