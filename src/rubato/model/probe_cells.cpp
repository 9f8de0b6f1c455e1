// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/shape_table.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/element/element.hpp"
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace rubato::model {
namespace {

using Eigen::Vector3d;

/// Squares of distances that differ by less than this part of the cell's size are the same.
constexpr double same_square = 1e-9;

bool is_in_cells(const study::Probe& probe) {
  return probe.place != study::ProbePlace::nodes;
}

class CellFinder {
public:
  CellFinder(const study::Probe& probe, const mesh::Mesh& mesh, const domain::Bulk& bulk,
             std::vector<Fault>& faults, std::vector<std::string>& notes)
      : probe_(probe), mesh_(mesh), bulk_(bulk), faults_(faults), notes_(notes) {}

  ProbedCells find() { return probe_.point ? nearest() : ProbedCells{of_group()}; }

private:
  std::vector<std::size_t> of_group() {
    std::vector<std::size_t> cells(bulk_.cells.size());
    std::iota(cells.begin(), cells.end(), std::size_t{0});
    if (probe_.node == study::everywhere)
      return cells;
    const Mention on{probe_.node, fmt::format("probes.{}.on", probe_.name)};
    const auto* group = cells_named(mesh_, on, faults_);
    if (group == nullptr)
      return {};
    std::erase_if(cells, [&](std::size_t cell) {
      return !std::ranges::binary_search(group->items, bulk_.cells[cell]);
    });
    if (cells.empty())
      faults_.push_back(fault_at(
          on.path, fmt::format("probe '{}': group '{}' holds no cells that deform, expected some, or 'all'",
                               probe_.name, probe_.node)));
    return cells;
  }

  /// The Gauss point nearest to the place, or all points of its cell.
  ProbedCells nearest() {
    const Vector3d place(probe_.point->at(0), probe_.point->at(1), probe_.point->at(2));
    ProbedCells found;
    double least = std::numeric_limits<double>::infinity();
    int equally_near = 0;
    for (std::size_t i = 0; i < bulk_.cells.size(); ++i) {
      const domain::CellPoints nodes(mesh_, mesh_.nodes_of(bulk_.cells[i]));
      const auto points = element::places(cell::stiffness_table(mesh_.type_of(bulk_.cells[i])), nodes);
      std::vector<double> distances;
      for (Eigen::Index q = 0; q < points.cols(); ++q)
        distances.push_back(squared_distance(contact::column_of(points, q), place));
      const double same = same_square * size_of(nodes);
      for (std::size_t q = 0; q < distances.size(); ++q) {
        equally_near =
            distances[q] < least - same ? 1 : equally_near + (distances[q] <= least + same ? 1 : 0);
        if (distances[q] >= least - same)
          continue;
        least = distances[q];
        found = {{i}, static_cast<int>(q)};
      }
    }
    if (equally_near > 1)
      notes_.push_back(ambiguity(equally_near, found));
    if (probe_.place == study::ProbePlace::cells)
      found.point = -1;
    return found;
  }

  static double squared_distance(const Vector3d& a, const Vector3d& b) {
    const auto apart = contact::difference_of(a, b);
    return contact::dot(apart, apart);
  }

  /// Square of the largest distance from its first node.
  static double size_of(std::span<const Vector3d> nodes) {
    double size = 0;
    for (const auto& node : nodes)
      size = std::max(size, squared_distance(node, nodes.front()));
    return size;
  }

  std::string ambiguity(int count, const ProbedCells& taken) const {
    return fmt::format(
        "probe '{}': {} Gauss points are equally near to its point; one of {} is taken, a place "
        "nearer to one of them says which is meant",
        probe_.name, count, domain::cell_label(mesh_, bulk_.cells[taken.cells.front()]));
  }

  const study::Probe& probe_;
  const mesh::Mesh& mesh_;
  const domain::Bulk& bulk_;
  std::vector<Fault>& faults_;
  std::vector<std::string>& notes_;
};

} // namespace

std::vector<ProbedCells> make_probe_cells(const study::Study& study, const mesh::Mesh& mesh,
                                          const domain::Bulk& bulk, std::vector<Fault>& faults,
                                          std::vector<std::string>& notes) {
  std::vector<ProbedCells> cells;
  for (const auto& probe : study.probes)
    cells.push_back(is_in_cells(probe) ? CellFinder(probe, mesh, bulk, faults, notes).find() : ProbedCells{});
  return cells;
}

} // namespace rubato::model
