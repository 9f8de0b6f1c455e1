// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/two_sides.hpp"

#include "rubato/contact/self_pairs.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

/// An axis must be that much stronger than one before it.
constexpr double clearly = 1.5;
/// Part of a face's size that is rounding of a centre.
constexpr double same_centre = 1e-6;

/// Sets of faces; each face knows whether it is on the side of the face above it (a union-find with parity).
class SidedSets {
public:
  explicit SidedSets(std::size_t faces) : above_(faces), other_(faces, 0) {
    std::iota(above_.begin(), above_.end(), 0);
  }

  Side side_of(int face) {
    bool other = false;
    int root = face;
    for (; above_[at(root)] != root; root = above_[at(root)])
      other ^= other_[at(root)] != 0;
    shorten(face, root, other);
    return {root, other};
  }

  void join(const Joint& joint) {
    const auto one = side_of(joint.one), other = side_of(joint.other);
    if (one.set == other.set)
      return;
    const auto [low, high] = std::minmax(one.set, other.set);
    above_[at(high)] = low;
    other_[at(high)] = (one.other ^ other.other ^ joint.opposite) ? 1 : 0;
  }

private:
  void shorten(int face, int root, bool other) {
    while (face != root) {
      const int next = above_[at(face)];
      const bool step = other_[at(face)] != 0;
      above_[at(face)] = root;
      other_[at(face)] = other ? 1 : 0;
      other ^= step;
      face = next;
    }
  }

  std::vector<int> above_;
  std::vector<char> other_;
};

/// Of one side of a set.
struct Mean {
  Vector3d sum{0, 0, 0};
  double size = 0;
  int count = 0;

  Vector3d centre() const { return scaled(1. / std::max(1, count), sum); }
};

/// Whether the side that is not the set's own is the farther one.
bool other_is_farther(const std::array<Mean, 2>& sides) {
  const auto apart = difference_of(sides[1].centre(), sides[0].centre());
  const int axis = strongest_axis(apart);
  return apart[axis] > same_centre * std::max(sides[0].size, sides[1].size);
}

} // namespace

int strongest_axis(const Vector3d& along) {
  int axis = 0;
  for (int c = 1; c < 3; ++c)
    if (std::abs(along[c]) > clearly * std::abs(along[axis]))
      axis = c;
  return axis;
}

std::vector<Side> two_sides(std::size_t faces, std::vector<Joint> joints) {
  const auto key = [](const Joint& joint) {
    return std::tuple(joint.apart, !joint.opposite, joint.one, joint.other);
  };
  std::sort(joints.begin(), joints.end(),
            [&](const Joint& one, const Joint& other) { return key(one) < key(other); });
  SidedSets sets(faces);
  for (const auto& joint : joints)
    sets.join(joint);
  std::vector<Side> sides;
  for (std::size_t f = 0; f < faces; ++f)
    sides.push_back(sets.side_of(static_cast<int>(f)));
  return sides;
}

std::vector<char> farther_sides(std::span<const Side> sides, std::span<const FlatFace> undeformed) {
  std::vector<std::array<Mean, 2>> means(sides.size());
  for (std::size_t f = 0; f < sides.size(); ++f) {
    auto& mean = means[at(sides[f].set)][sides[f].other ? 1 : 0];
    mean.sum += undeformed[f].centre;
    mean.size = std::max(mean.size, undeformed[f].size);
    ++mean.count;
  }
  std::vector<char> farther(sides.size());
  for (std::size_t f = 0; f < sides.size(); ++f)
    farther[f] = sides[f].other == other_is_farther(means[at(sides[f].set)]) ? 1 : 0;
  return farther;
}

} // namespace rubato::contact
