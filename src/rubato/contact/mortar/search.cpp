// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/search.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <unsupported/Eigen/BVH>

namespace rubato::contact::mortar {
namespace {

/// A quadratic face leaves the box of its nodes by an eighth of it at most in each half.
constexpr double bulge = 0.25;

/// What Eigen's tree asks: whether to look into a box, and what to do with a face.
struct Finder {
  const Box& box;
  std::vector<int>& found;
  bool intersectVolume(const Box& volume) const { return volume.intersects(box); }
  bool intersectObject(int index) const {
    found.push_back(index);
    return false;
  }
};

} // namespace

struct FaceSearch::Tree {
  Eigen::KdBVH<double, 3, int> boxes;
  std::vector<Box> own;
  std::vector<int> indices;
};

FaceSearch::FaceSearch() : tree_(std::make_unique<Tree>()) {}
FaceSearch::~FaceSearch() = default;
FaceSearch::FaceSearch(FaceSearch&&) noexcept = default;
FaceSearch& FaceSearch::operator=(FaceSearch&&) noexcept = default;

Box box_of(CellType type, const FaceCoordinates& x) {
  Eigen::Vector3d low = column_of(x, 0), high = low;
  for (Eigen::Index node = 1; node < x.cols(); ++node)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x(i, node));
      high[i] = std::max(high[i], x(i, node));
    }
  if (cell::topology(type).order == 2) {
    const double margin = bulge * length_of(difference_of(high, low));
    for (int i = 0; i < 3; ++i) {
      low[i] -= margin;
      high[i] += margin;
    }
  }
  return {low, high};
}

void FaceSearch::build(std::span<const Box> boxes) {
  tree_->own.assign(boxes.begin(), boxes.end());
  tree_->indices.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    tree_->indices[i] = static_cast<int>(i);
  tree_->boxes.init(tree_->indices.begin(), tree_->indices.end(), tree_->own.begin(), tree_->own.end());
}

void FaceSearch::find(const Box& box, std::vector<int>& found) const {
  found.clear();
  if (tree_->own.empty())
    return;
  Finder finder{box, found};
  Eigen::BVIntersect(tree_->boxes, finder);
  std::erase_if(found,
                [&](int index) { return !tree_->own[static_cast<std::size_t>(index)].intersects(box); });
  std::sort(found.begin(), found.end());
}

} // namespace rubato::contact::mortar
