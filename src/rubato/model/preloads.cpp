// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/preloads.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/embedding.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace rubato::model {
namespace {

using Eigen::Vector3d;
using mesh::CellIndex;
using mesh::NodeIndex;

/// Centres of cells nearer to a plane than this part of its distance to the farthest one are on it.
constexpr double on_plane = 1e-9;

Vector3d as_vector(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

Vector3d centre_of_cell(const mesh::Mesh& mesh, CellIndex cell) {
  const auto nodes = mesh.nodes_of(cell);
  Vector3d sum = Vector3d::Zero();
  for (const auto node : nodes)
    contact::add_scaled(1, mesh.points[static_cast<std::size_t>(node)], sum);
  for (auto& value : sum)
    value /= static_cast<double>(nodes.size());
  return sum;
}

bool fills_space(const mesh::Mesh& mesh, CellIndex cell) {
  return cell::topology(mesh.type_of(cell)).dimension == mesh.dimension;
}

std::set<NodeIndex> nodes_of(const mesh::Mesh& mesh, std::span<const CellIndex> cells) {
  std::set<NodeIndex> nodes;
  for (const auto cell : cells)
    nodes.insert(mesh.nodes_of(cell).begin(), mesh.nodes_of(cell).end());
  return nodes;
}

std::vector<CellIndex> all_cells(const mesh::Mesh& mesh) {
  std::vector<CellIndex> cells(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(cells.begin(), cells.end(), 0);
  return cells;
}

struct CellSides {
  std::vector<CellIndex> behind;
  std::vector<CellIndex> in_front;
};

CellSides sides_of(const mesh::Mesh& mesh, const std::vector<CellIndex>& cells, const study::Cut& plane) {
  const auto behind = behind_plane(mesh, cells, plane);
  CellSides sides;
  for (std::size_t i = 0; i < cells.size(); ++i)
    (behind[i] != 0 ? sides.behind : sides.in_front).push_back(cells[i]);
  return sides;
}

class Splitter {
public:
  Splitter(const study::Preload& preload, mesh::Mesh& mesh, std::vector<Fault>& faults)
      : preload_(preload), path_(fmt::format("preload.{}.cut", preload.name)), mesh_(mesh), faults_(faults) {}

  PreloadedCut split() {
    PreloadedCut cut;
    cut.normal = contact::unit_of(as_vector(preload_.cut.normal));
    const auto cells = host_cells(mesh_, mesh_.dimension, {preload_.cut.cells, path_ + ".cells"}, faults_);
    if (cells.empty())
      return cut;
    const auto sides = sides_of(mesh_, cells, preload_.cut);
    const auto behind = nodes_of(mesh_, sides.behind);
    const auto in_front = nodes_of(mesh_, sides.in_front);
    std::vector<NodeIndex> shared;
    std::ranges::set_intersection(behind, in_front, std::back_inserter(shared));
    if (shared.empty())
      fault(path_, "the plane cuts nothing, expected cells on both of its sides that share nodes");
    else if (check_others(cells, shared))
      cut.pairs = separate(sides, behind, in_front, shared);
    return cut;
  }

private:
  void fault(const std::string& path, const std::string& text) {
    faults_.push_back(fault_at(path, fmt::format("preload '{}': {}", preload_.name, text)));
  }

  /// A body that holds on to the cut from outside would be on one of its sides by chance.
  bool check_others(const std::vector<CellIndex>& cells, const std::vector<NodeIndex>& shared) {
    for (const auto cell : all_cells(mesh_)) {
      if (!fills_space(mesh_, cell) || std::ranges::binary_search(cells, cell))
        continue;
      for (const auto node : mesh_.nodes_of(cell))
        if (std::ranges::binary_search(shared, node)) {
          fault(path_,
                fmt::format("node {} of the cut is also one of cells that are not in '{}', expected a cut "
                            "through cells that nothing else holds there",
                            node_label(mesh_, node), preload_.cut.cells));
          return false;
        }
    }
    return true;
  }

  std::vector<NodePair> separate(const CellSides& sides, const std::set<NodeIndex>& behind,
                                 const std::set<NodeIndex>& in_front, const std::vector<NodeIndex>& shared) {
    std::vector<NodePair> pairs;
    std::map<NodeIndex, NodeIndex> twins;
    for (const auto node : shared) {
      pairs.push_back({node, add_twin(node)});
      twins.emplace(node, pairs.back().in_front);
    }
    if (!mesh_.node_names.empty())
      mesh::name_the_rest(mesh_);
    const std::set<CellIndex> front(sides.in_front.begin(), sides.in_front.end());
    CellIndex cell = 0;
    for (auto& block : mesh_.blocks) {
      const auto size = static_cast<std::size_t>(cell::topology(block.type).node_count);
      for (std::size_t first = 0; first < block.nodes.size(); first += size, ++cell) {
        const auto nodes = std::span(block.nodes).subspan(first, size);
        if (front.contains(cell) ||
            (cell::topology(block.type).dimension < mesh_.dimension && is_in_front(nodes, behind, in_front)))
          for (auto& node : nodes)
            if (const auto twin = twins.find(node); twin != twins.end())
              node = twin->second;
      }
    }
    return pairs;
  }

  NodeIndex add_twin(NodeIndex node) {
    const auto twin = mesh_.node_count();
    const auto last = std::ranges::max_element(mesh_.node_numbers);
    const auto number = last == mesh_.node_numbers.end() ? 1 : *last + 1;
    mesh_.points.push_back(mesh_.points[static_cast<std::size_t>(node)]);
    mesh_.node_numbers.push_back(number);
    return twin;
  }

  /// A face or an edge that the front has and the other side has not.
  static bool is_in_front(std::span<const NodeIndex> nodes, const std::set<NodeIndex>& behind,
                          const std::set<NodeIndex>& in_front) {
    const auto is_there = [&](NodeIndex node) { return in_front.contains(node); };
    const auto is_alone = [&](NodeIndex node) { return !behind.contains(node); };
    return std::ranges::all_of(nodes, is_there) && std::ranges::any_of(nodes, is_alone);
  }

  const study::Preload& preload_;
  std::string path_;
  mesh::Mesh& mesh_;
  std::vector<Fault>& faults_;
};

} // namespace

std::vector<char> behind_plane(const mesh::Mesh& mesh, std::span<const CellIndex> cells,
                               const study::Cut& plane) {
  const Vector3d normal = contact::unit_of(as_vector(plane.normal));
  std::vector<double> distances;
  double farthest = 0;
  for (const auto cell : cells) {
    distances.push_back(
        contact::dot(normal, contact::difference_of(centre_of_cell(mesh, cell), as_vector(plane.point))));
    farthest = std::max(farthest, std::abs(distances.back()));
  }
  return transformed<char>(distances,
                           [&](double distance) { return distance < -on_plane * farthest ? 1 : 0; });
}

std::vector<PreloadedCut> split_at_preloads(const study::Study& study, mesh::Mesh& mesh,
                                            std::vector<Fault>& faults) {
  std::vector<PreloadedCut> cuts;
  for (const auto& preload : study.preload)
    cuts.push_back(Splitter(preload, mesh, faults).split());
  return cuts;
}

std::vector<NodeIndex> nodes_behind(const mesh::Mesh& mesh, std::span<const PreloadedCut> preloads) {
  std::vector<NodeIndex> nodes(static_cast<std::size_t>(mesh.node_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  for (const auto& cut : preloads)
    for (const auto& pair : cut.pairs)
      nodes[static_cast<std::size_t>(pair.in_front)] = pair.behind;
  return nodes;
}

} // namespace rubato::model
