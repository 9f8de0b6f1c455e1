// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/heat.hpp"

#include "rubato/model/build.hpp"
#include "rubato/study/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

namespace rubato::model {
namespace {

std::vector<mesh::NodeIndex> heated_by(const study::Temperature& temperature, const std::string& path,
                                       const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                       std::vector<Fault>& faults) {
  if (temperature.on == study::everywhere)
    return dofs.nodes;
  return body_nodes_or_fault(mesh, dofs, {temperature.on, path + ".on"}, "to heat", faults);
}

/// The entry that counts for each node of the dofs; below 0: none.
std::vector<int> entry_of_nodes(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                std::vector<Fault>& faults) {
  std::vector<int> entry(dofs.nodes.size(), -1);
  for (std::size_t i = 0; i < study.temperatures.size(); ++i)
    for (const auto node :
         heated_by(study.temperatures[i], fmt::format("temperature.{}", i), mesh, dofs, faults))
      entry[static_cast<std::size_t>(dofs.dof(node, 0) / dofs.components)] = static_cast<int>(i);
  return entry;
}

/// Values are asked for at both ends of the run: they throw now rather than in a step.
std::vector<domain::HeatedNodes> heated_nodes(const study::Study& study, const mesh::Mesh& mesh,
                                              const domain::DofMap& dofs, std::vector<Fault>& faults) {
  std::vector<domain::HeatedNodes> parts;
  for (std::size_t i = 0; i < study.temperatures.size(); ++i)
    parts.push_back({study::field_function(study.temperatures[i].value, study.functions,
                                           fmt::format("temperature.{}.value", i)),
                     {},
                     {}});
  const auto entry = entry_of_nodes(study, mesh, dofs, faults);
  for (std::size_t n = 0; n < entry.size(); ++n) {
    if (entry[n] < 0)
      continue;
    auto& part = parts[static_cast<std::size_t>(entry[n])];
    const auto& x = mesh.points[static_cast<std::size_t>(dofs.nodes[n])];
    part.nodes.push_back(static_cast<int>(n));
    part.places.push_back({x[0], x[1], x[2]});
    for (const double t : {study.time.begin, study.time.end})
      part.value.at(part.places.back(), t);
  }
  return parts;
}

} // namespace

std::shared_ptr<const domain::Heat> make_heat(const study::Study& study, const mesh::Mesh& mesh,
                                              const domain::DofMap& dofs, const domain::Bulk& bulk,
                                              std::vector<Fault>& faults) {
  if (study.temperatures.empty())
    return nullptr;
  try {
    std::vector<std::optional<study::ThermalExpansion>> expansions;
    std::ranges::transform(study.materials, std::back_inserter(expansions), &study::Material::expansion);
    return std::make_shared<domain::Heat>(mesh, bulk, dofs, std::move(expansions),
                                          heated_nodes(study, mesh, dofs, faults));
  } catch (const InputError& error) {
    for (const auto& fault : error.faults())
      faults.push_back(fault_at(fault.path.empty() ? "temperature" : fault.path, fault.text));
    return nullptr;
  }
}

} // namespace rubato::model
