// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rubato::mesh {

using Eigen::AlignedBox3d;

namespace {

constexpr std::size_t boxes_of_a_leaf = 8;

std::size_t slot(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

} // namespace

BoxTree::BoxTree(std::vector<AlignedBox3d> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes_.empty())
    grow(0, order_.size());
}

void BoxTree::grow(std::size_t begin, std::size_t end) {
  const auto self = branches_.size();
  branches_.push_back({AlignedBox3d(), begin, end, 0});
  auto box = branches_[self].box;
  for (auto i = begin; i < end; ++i)
    box.extend(boxes_[slot(order_[i])]);
  branches_[self].box = box;
  if (end - begin <= boxes_of_a_leaf)
    return;
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t a, std::int32_t b) {
    return boxes_[slot(a)].center()[axis] < boxes_[slot(b)].center()[axis];
  });
  grow(begin, middle);
  branches_[self].right = branches_.size();
  grow(middle, end);
}

std::vector<std::int32_t> BoxTree::boxes_at(const Eigen::Vector3d& place) const {
  std::vector<std::int32_t> found;
  std::vector<std::size_t> open;
  if (!branches_.empty())
    open.push_back(0);
  while (!open.empty()) {
    const auto index = open.back();
    open.pop_back();
    const auto& branch = branches_[index];
    if (!branch.box.contains(place))
      continue;
    if (branch.right != 0) {
      open.push_back(index + 1);
      open.push_back(branch.right);
      continue;
    }
    for (auto i = branch.begin; i < branch.end; ++i)
      if (boxes_[slot(order_[i])].contains(place))
        found.push_back(order_[i]);
  }
  std::ranges::sort(found);
  return found;
}

} // namespace rubato::mesh
