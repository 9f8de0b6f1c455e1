// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/nearest.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/disjoint_sets.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::contact::mortar {
namespace {

/// Of the sub-facet's area: curved edges are cut into chords, pieces of neighbours may overlap by that much.
constexpr double one_layer = 1.001;
/// Of the sub-facet's size.
constexpr double still_near = 0.25, far = 0.5;

const Face& face_of(const Surface& master, const PointRange& range) {
  return master.faces[static_cast<std::size_t>(range.master_face)];
}

bool have_common_node(const Face& one, const Face& other) {
  return std::ranges::any_of(one.node_span(), [&](auto node) {
    return std::ranges::find(other.node_span(), node) != other.node_span().end();
  });
}

/// 1 up to `still_near`, 0 from `far` on, smooth between.
double share_at(double excess) {
  const double s = std::clamp((far - excess) / (far - still_near), 0., 1.);
  return s * s * (3 - 2 * s);
}

} // namespace

double size_of(const SlaveFace& placed, const SubFacet& facet) {
  double size = 0;
  for (int i = 0; i < facet.node_count; ++i)
    for (int j = 0; j < i; ++j)
      size = std::max(
          size, length_of(difference_of(column_of(placed.x, facet.nodes[static_cast<std::size_t>(i)]),
                                        column_of(placed.x, facet.nodes[static_cast<std::size_t>(j)]))));
  return size;
}

void leave_out_hidden(const Surface& master, std::span<const PointRange> ranges, double full_area,
                      const DistanceBefore& distance_before, std::span<Point> points) {
  double area = 0;
  for (const auto& point : points)
    area += point.weight;
  if (!(area > one_layer * full_area))
    return;
  for (const auto& range : ranges)
    for (const auto& other : ranges)
      if (!have_common_node(face_of(master, range), face_of(master, other)))
        for (auto& point : points.subspan(range.first, range.last - range.first)) {
          const auto distance = distance_before(other.master_face, point.xi);
          if (distance && std::abs(*distance) < std::abs(point.distance))
            point.weight = 0;
        }
}

namespace {

double least_distance(std::span<const Point> points) {
  double least = INFINITY;
  for (const auto& point : points)
    if (point.weight != 0)
      least = std::min(least, std::abs(point.distance));
  return least;
}

/// Of each range the least distance of all that common nodes connect it with.
std::vector<double> connected_distances(const Surface& master, std::span<const PointRange> ranges,
                                        std::span<const Point> points) {
  DisjointSets sets(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (have_common_node(face_of(master, ranges[i]), face_of(master, ranges[j])))
        sets.join(i, j);
  std::vector<double> least(ranges.size(), INFINITY);
  for (std::size_t i = 0; i < ranges.size(); ++i)
    least[sets.root(i)] = std::min(least[sets.root(i)], least_distance(ranges[i].of(points)));
  for (std::size_t i = 0; i < ranges.size(); ++i)
    least[i] = least[sets.root(i)];
  return least;
}

} // namespace

void leave_out_far(const Surface& master, std::span<const PointRange> ranges, double size,
                   std::span<Point> points) {
  const double nearest = least_distance(points);
  const auto is_far = [&](double distance) { return distance > nearest + still_near * size; };
  if (std::ranges::none_of(ranges,
                           [&](const PointRange& range) { return is_far(least_distance(range.of(points))); }))
    return;
  const auto least = connected_distances(master, ranges, points);
  for (std::size_t i = 0; i < ranges.size(); ++i)
    if (is_far(least[i]))
      for (auto& point : ranges[i].of(points))
        point.weight *= share_at((least[i] - nearest) / size);
}

} // namespace rubato::contact::mortar
