// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <map>

namespace rubato::model {
namespace {

using constraint::PrescribedDof;

class SupportCollector {
public:
  SupportCollector(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                   std::vector<Fault>& faults)
      : study_(study), mesh_(mesh), dofs_(dofs), faults_(faults) {}

  void add(const study::Support& support, const std::string& path) {
    for (const auto node : body_nodes_or_fault(mesh_, dofs_, {support.on, path + ".on"}, "to hold", faults_))
      for (int i = 0; i < dofs_.components; ++i)
        if (const auto& amplitude = support.components[static_cast<std::size_t>(i)])
          prescribe(path, node, i, *amplitude);
  }

  std::vector<PrescribedDof> prescribed() const {
    std::vector<PrescribedDof> list;
    for (const auto& [dof, prescribed] : by_dof_)
      list.push_back(prescribed);
    return list;
  }

private:
  void prescribe(const std::string& path, mesh::NodeIndex node, int component,
                 const study::Amplitude& amplitude) {
    const int dof = dofs_.dof(node, component);
    const PrescribedDof wanted{dof, amplitude.value, function_named(study_, amplitude.function)};
    const auto [entry, fresh] = by_dof_.emplace(dof, wanted);
    const auto& there = entry->second;
    if (fresh || (there.value == wanted.value && there.function == wanted.function) || told_)
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
