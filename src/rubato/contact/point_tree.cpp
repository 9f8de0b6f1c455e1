// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/point_tree.hpp"

#include <nanoflann.hpp>

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

/// What nanoflann tells the points within a distance: nothing but the caller's list grows.
struct Appending {
  double squared_distance;
  std::vector<std::uint32_t>& indices;

  bool full() const { return true; }
  double worstDist() const { return squared_distance; }
  bool addPoint(double squared, std::uint32_t index) {
    if (squared < squared_distance)
      indices.push_back(index);
    return true;
  }
};

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
  Appending found{distance * distance, indices};
  index_->tree.findNeighbors(found, x.data(), nanoflann::SearchParams());
}

} // namespace rubato::contact
