// SPDX-License-Identifier: LGPL-3.0-or-later
// Slave nodes that ties and contact pairs move onto their masters before the analysis.
#include "rubato/cell/topology.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rubato::mesh::inp {
namespace {

using Eigen::Vector3d;

/// Part of the mean length of slave faces within which ties move nodes where the file gives no tolerance.
constexpr double usual_tolerance = 0.05;

/// Flat pieces of a face by its corners and the nodes between them, −1: none.
std::vector<std::array<int, 3>> pieces_of(CellType type) {
  switch (type) {
  case CellType::seg2:
    return {{0, 1, -1}};
  case CellType::seg3:
    return {{0, 2, -1}, {2, 1, -1}};
  case CellType::tria3:
    return {{0, 1, 2}};
  case CellType::tria6:
    return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  case CellType::quad4:
    return {{0, 1, 2}, {0, 2, 3}};
  default: // eight or nine nodes
    return {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {7, 6, 3}, {4, 5, 6}, {4, 6, 7}};
  }
}

Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d way = b - a;
  const double length = way.squaredNorm();
  const double part = length > 0 ? std::clamp((p - a).dot(way) / length, 0.0, 1.0) : 0.0;
  return a + part * way;
}

Vector3d nearest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (area > 0) {
    const double v = (p - a).cross(c - a).dot(normal) / area;
    const double w = (b - a).cross(p - a).dot(normal) / area;
    if (v >= 0 && w >= 0 && v + w <= 1)
      return a + v * (b - a) + w * (c - a);
  }
  Vector3d nearest = nearest_on_segment(p, a, b);
  for (const auto& other : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)})
    if ((other - p).squaredNorm() < (nearest - p).squaredNorm())
      nearest = other;
  return nearest;
}

/// The flat pieces of the faces of a surface.
class Facets {
public:
  Facets(const Content& content, const Surface& surface) {
    for (const auto& face : surface.faces) {
      const auto& element = content.elements[static_cast<std::size_t>(face.element)];
      const auto& side = cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)];
      const auto nodes = content.nodes_of(element);
      const auto point = [&](int i) {
        return content.points[static_cast<std::size_t>(nodes[side.nodes[static_cast<std::size_t>(i)]])];
      };
      for (const auto& piece : pieces_of(side.type)) {
        const Vector3d last = piece[2] < 0 ? point(piece[1]) : point(piece[2]);
        pieces_.push_back({point(piece[0]), point(piece[1]), last});
      }
    }
  }

  Vector3d nearest(const Vector3d& place) const {
    Vector3d best = place;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : pieces_) {
      const Vector3d found = b == c ? nearest_on_segment(place, a, b) : nearest_on_triangle(place, a, b, c);
      if (const double distance = (found - place).squaredNorm(); distance < least) {
        least = distance;
        best = found;
      }
    }
    return best;
  }

private:
  std::vector<std::array<Vector3d, 3>> pieces_;
};

std::vector<NodeIndex> nodes_of_surface(const Content& content, const Surface& surface) {
  auto nodes = surface.nodes;
  for (const auto& face : surface.faces) {
    const auto& element = content.elements[static_cast<std::size_t>(face.element)];
    const auto all = content.nodes_of(element);
    for (const auto i : cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)].nodes)
      nodes.push_back(all[i]);
  }
  sort_without_repeats(nodes);
  return nodes;
}

/// Mean distance of the first two corners of the faces.
double face_length(const Content& content, const Surface& surface) {
  double sum = 0;
  for (const auto& face : surface.faces) {
    const auto& element = content.elements[static_cast<std::size_t>(face.element)];
    const auto& side = cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)];
    const auto nodes = content.nodes_of(element);
    sum += (content.points[static_cast<std::size_t>(nodes[side.nodes[0]])] -
            content.points[static_cast<std::size_t>(nodes[side.nodes[1]])])
               .norm();
  }
  return surface.faces.empty() ? 0 : sum / static_cast<double>(surface.faces.size());
}

/// Parameters of a keyword that moves slave nodes.
struct Adjustment {
  double within = 0;                            ///< largest distance
  bool all = false;                             ///< whatever the distance
  const std::vector<NodeIndex>* only = nullptr; ///< ascending; nullptr: every slave node
};

void adjust(Content& content, const Surface& slave, const Surface& master, const Adjustment& wanted,
            const Word& at) {
  const Facets facets(content, master);
  const auto of_master = nodes_of_surface(content, master);
  int count = 0;
  double farthest = 0;
  for (const auto node : nodes_of_surface(content, slave)) {
    if ((wanted.only != nullptr && !std::ranges::binary_search(*wanted.only, node)) ||
        std::ranges::binary_search(of_master, node))
      continue;
    auto& point = content.points[static_cast<std::size_t>(node)];
    const Vector3d nearest = facets.nearest(point);
    const double distance = (nearest - point).norm();
    if (distance == 0 || (!wanted.all && distance > wanted.within))
      continue;
    point = nearest;
    ++count;
    farthest = std::max(farthest, distance);
  }
  if (count > 0)
    content.remarks.push_back(
        {at, fmt::format("{} slave nodes are moved onto the master, without strain, by {:.3g} at most", count,
                         farthest)});
}

/// The tolerance of a tie, and whether it moves nodes.
std::optional<Adjustment> adjustment_of_tie(const Content& content, const Block& block,
                                            const Surface& slave) {
  const auto* const given = block.find("ADJUST");
  if (given != nullptr && compact(given->value.text) == "NO")
    return std::nullopt;
  Adjustment wanted;
  wanted.within = usual_tolerance * face_length(content, slave);
  if (const auto* const tolerance = block.find("POSITIONTOLERANCE"); tolerance != nullptr)
    wanted.within = number_in(tolerance->value.text).value_or(wanted.within);
  return wanted;
}

std::optional<Adjustment> adjustment_of_pair(const Content& content, const Placed& placed, Faults& faults,
                                             std::vector<NodeIndex>& storage) {
  const auto* const given = placed.block->find("ADJUST");
  if (given == nullptr)
    return std::nullopt;
  Adjustment wanted;
  if (const auto within = number_in(given->value.text); within) {
    wanted.within = *within;
    return wanted;
  }
  const auto found = find_nodes(content, placed.scope, given->value, faults);
  if (!found)
    return std::nullopt;
  storage = found->items;
  wanted.only = &storage;
  wanted.all = true;
  return wanted;
}

} // namespace

void adjust_slaves(Content& content, Faults& faults) {
  Faults told_elsewhere;
  for (const auto& placed : content.layout.blocks) {
    const bool tie = placed.block->is("TIE");
    if (!tie && !placed.block->is("CONTACT PAIR"))
      continue;
    for (const auto& line : placed.block->lines) {
      const auto fields = fields_of(line);
      if (fields.size() < 2 || fields[1].empty())
        continue;
      const auto* const slave = find_surface(content, placed.scope, fields[0], told_elsewhere);
      const auto* const master = find_surface(content, placed.scope, fields[1], told_elsewhere);
      if (slave == nullptr || master == nullptr || master->faces.empty())
        continue;
      std::vector<NodeIndex> storage;
      const auto wanted = tie ? adjustment_of_tie(content, *placed.block, *slave)
                              : adjustment_of_pair(content, placed, faults, storage);
      if (wanted)
        adjust(content, *slave, *master, *wanted, fields[0]);
    }
  }
}

std::pair<double, double> distances(const Content& content, const Surface& slave, const Surface& master) {
  const Facets facets(content, master);
  std::pair<double, double> range{std::numeric_limits<double>::infinity(), 0};
  for (const auto node : nodes_of_surface(content, slave)) {
    const auto& point = content.points[static_cast<std::size_t>(node)];
    const double distance = (facets.nearest(point) - point).norm();
    range = {std::min(range.first, distance), std::max(range.second, distance)};
  }
  return range;
}

} // namespace rubato::mesh::inp
