// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/transformed.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace rubato::model {
namespace {

using Eigen::Vector3d;
using mesh::NodeIndex;

Vector3d vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Deforming cells by their places in the bulk, on both sides of a plane; those on it are in front.
struct Sides {
  std::vector<std::size_t> behind;
  std::vector<std::size_t> in_front;
};

class CutBuilder {
public:
  CutBuilder(const study::Probe& probe, const mesh::Mesh& mesh, const domain::DofMap& dofs,
             const domain::Bulk& bulk, const domain::Heat* heat, std::vector<Fault>& faults,
             std::span<const PreloadedCut> preloads)
      : probe_(probe), cut_(*probe.section), path_(fmt::format("probes.{}.section", probe.name)), mesh_(mesh),
        dofs_(dofs), bulk_(bulk), heat_(heat), faults_(faults), behind_(nodes_behind(mesh, preloads)) {}

  domain::CutForces build() {
    const auto cells = chosen_cells();
    if (cells.empty())
      return {};
    const auto sides = sides_of(cells);
    const auto nodes = cut_.on.empty() ? between(sides) : on_group(sides);
    if (nodes.empty())
      return {};
    return domain::make_cut_forces(mesh_, bulk_, dofs_, sides.behind, nodes, vector_of(cut_.point), heat_);
  }

private:
  void fault(const std::string& path, const std::string& text) {
    faults_.push_back(fault_at(path, fmt::format("probe '{}': {}", probe_.name, text)));
  }

  /// Empty and a fault when there are none.
  std::vector<std::size_t> chosen_cells() {
    std::vector<std::size_t> cells;
    const mesh::Group* group = nullptr;
    if (!cut_.cells.empty()) {
      group = cells_named(mesh_, {cut_.cells, path_ + ".cells"}, faults_);
      if (group == nullptr)
        return cells;
    }
    for (std::size_t i = 0; i < bulk_.cells.size(); ++i)
      if (group == nullptr || std::ranges::binary_search(group->items, bulk_.cells[i]))
        cells.push_back(i);
    if (cells.empty())
      fault(path_ + ".cells", fmt::format("group '{}' holds no cells that deform", cut_.cells));
    return cells;
  }

  Sides sides_of(const std::vector<std::size_t>& cells) const {
    const auto of_mesh =
        transformed<mesh::CellIndex>(cells, [&](std::size_t cell) { return bulk_.cells[cell]; });
    const auto behind = behind_plane(mesh_, of_mesh, cut_);
    Sides sides;
    for (std::size_t i = 0; i < cells.size(); ++i)
      (behind[i] != 0 ? sides.behind : sides.in_front).push_back(cells[i]);
    return sides;
  }

  std::vector<char> marked(const std::vector<std::size_t>& cells) const {
    std::vector<char> marks(mesh_.points.size(), 0);
    for (const auto cell : cells)
      for (const auto node : mesh_.nodes_of(bulk_.cells[cell]))
        marks[static_cast<std::size_t>(behind_[static_cast<std::size_t>(node)])] = 1;
    return marks;
  }

  std::vector<NodeIndex> between(const Sides& sides) {
    const auto behind = marked(sides.behind);
    const auto in_front = marked(sides.in_front);
    std::vector<NodeIndex> nodes;
    for (std::size_t i = 0; i < behind.size(); ++i)
      if (const auto node = static_cast<std::size_t>(behind_[i]); behind[node] != 0 && in_front[node] != 0)
        nodes.push_back(static_cast<NodeIndex>(i));
    if (nodes.empty())
      fault(path_,
            "the plane cuts nothing, expected cells on both of its sides that share nodes; 'on: GROUP' "
            "takes the nodes of a group at the border of a body");
    return nodes;
  }

  std::vector<NodeIndex> on_group(const Sides& sides) {
    auto nodes = nodes_or_fault(mesh_, {cut_.on, path_ + ".on"}, faults_);
    if (nodes.empty())
      return nodes;
    const auto behind = marked(sides.behind);
    std::erase_if(nodes, [&](NodeIndex node) {
      return behind[static_cast<std::size_t>(behind_[static_cast<std::size_t>(node)])] == 0;
    });
    if (nodes.empty())
      fault(
          path_ + ".on",
          fmt::format("no cell behind the plane has a node of group '{}', expected a normal that points out "
                      "of the part on which the forces act",
                      cut_.on));
    return nodes;
  }

  const study::Probe& probe_;
  const study::Cut& cut_;
  std::string path_;
  const mesh::Mesh& mesh_;
  const domain::DofMap& dofs_;
  const domain::Bulk& bulk_;
  const domain::Heat* heat_;
  std::vector<Fault>& faults_;
  std::vector<NodeIndex> behind_; ///< of the two nodes of a pair that a preload has cut apart
};

} // namespace

std::vector<domain::CutForces> make_probe_cuts(const study::Study& study, const mesh::Mesh& mesh,
                                               const domain::DofMap& dofs, const domain::Bulk& bulk,
                                               const domain::Heat* heat, std::vector<Fault>& faults,
                                               std::span<const PreloadedCut> preloads) {
  std::vector<domain::CutForces> cuts;
  for (const auto& probe : study.probes)
    cuts.push_back(probe.section ? CutBuilder(probe, mesh, dofs, bulk, heat, faults, preloads).build()
                                 : domain::CutForces{});
  return cuts;
}

} // namespace rubato::model
