// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/point_tree.hpp"

#include <nanoflann.hpp>

#include <utility>

namespace rubato::contact {
namespace {

/// Points of a leaf: the default of nanoflann.
constexpr std::size_t leaf_size = 10;

/// Points as nanoflann wants to see them.
struct Cloud {
  std::span<const Eigen::Vector3d> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t component) const {
    return points[index][static_cast<Eigen::Index>(component)];
  }
  template <class Box> bool kdtree_get_bbox(Box& /*unused*/) const { return false; }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3>;

} // namespace

struct PointTree::Index {
  Cloud cloud;
  Tree tree{3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size)};
};

PointTree::PointTree(std::span<const Eigen::Vector3d> points) : index_(new Index{Cloud{points}}) {}

PointTree::~PointTree() = default;

PointTree::Nearest PointTree::nearest(const Eigen::Vector3d& x) const {
  std::uint32_t index = 0;
  double squared = 0;
  index_->tree.knnSearch(x.data(), 1, &index, &squared);
  return {index, squared};
}

void PointTree::append_within(const Eigen::Vector3d& x, double distance,
                              std::vector<std::uint32_t>& indices) const {
  std::vector<std::pair<std::uint32_t, double>> found;
  const nanoflann::SearchParams unsorted(32, 0, false); // the first is ignored, the second: no approximation
  index_->tree.radiusSearch(x.data(), distance * distance, found, unsorted);
  for (const auto& [index, squared] : found)
    indices.push_back(index);
}

} // namespace rubato::contact
