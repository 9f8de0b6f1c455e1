// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rubato::mesh {

namespace {

constexpr std::size_t boxes_of_a_leaf = 8;

std::size_t slot(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

double middle_of(const Box& box, Eigen::Index axis) {
  return (box.least[axis] + box.largest[axis]) / 2;
}

} // namespace

void Box::extend(const Eigen::Vector3d& place) {
  least = least.cwiseMin(place);
  largest = largest.cwiseMax(place);
}

void Box::extend(const Box& other) {
  least = least.cwiseMin(other.least);
  largest = largest.cwiseMax(other.largest);
}

bool Box::contains(const Eigen::Vector3d& place) const {
  for (int i = 0; i < 3; ++i)
    if (!(least[i] <= place[i] && place[i] <= largest[i]))
      return false;
  return true;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes_.empty())
    grow(0, order_.size());
}

void BoxTree::grow(std::size_t begin, std::size_t end) {
  const auto self = branches_.size();
  branches_.push_back({Box(), begin, end, 0});
  auto box = branches_[self].box;
  for (auto i = begin; i < end; ++i)
    box.extend(boxes_[slot(order_[i])]);
  branches_[self].box = box;
  if (end - begin <= boxes_of_a_leaf)
    return;
  Eigen::Index axis = 0;
  (box.largest - box.least).maxCoeff(&axis);
  const auto middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t a, std::int32_t b) {
    return middle_of(boxes_[slot(a)], axis) < middle_of(boxes_[slot(b)], axis);
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
