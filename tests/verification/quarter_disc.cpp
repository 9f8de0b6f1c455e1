// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/quarter_disc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::verification {
namespace {

using Eigen::Vector3d;
using mesh::NodeIndex;

class DiscBlocks {
public:
  DiscBlocks(double radius, int n) : radius_(radius), n_(n) {}

  QuarterDisc fill() {
    const auto core = [&](int i, int j) { return core_point(i, j); };
    const auto right = [&](int i, int j) { return between(core_point(n_, j), angle(j), i); };
    const auto top = [&](int i, int j) {
      return between(core_point(i, n_), std::numbers::pi / 2 - angle(i), j);
    };
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) {
        add({core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)});
        add({right(i, j), right(i + 1, j), right(i + 1, j + 1), right(i, j + 1)});
        add({top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1)});
      }
    return std::move(disc_);
  }

private:
  /// A square with a corner that is drawn in, so that the three blocks meet at 120 degrees.
  Vector3d core_point(int i, int j) const {
    const double x = static_cast<double>(i) / n_, y = static_cast<double>(j) / n_;
    return 0.5 * radius_ * Vector3d(x * (1 - 0.12 * y), y * (1 - 0.12 * x), 0);
  }
  double angle(int step) const { return std::numbers::pi / 4 * step / n_; }
  Vector3d between(const Vector3d& inner, double phi, int step) const {
    const Vector3d outer = radius_ * Vector3d(std::cos(phi), std::sin(phi), 0);
    return inner + (outer - inner) * step / n_;
  }

  void add(const std::array<Vector3d, 4>& corners) {
    auto& cell = disc_.cells.emplace_back();
    std::ranges::transform(corners, cell.begin(), [&](const Vector3d& x) { return node_at(x); });
  }
  NodeIndex node_at(const Vector3d& x) {
    auto& points = disc_.points;
    const auto same = [&](const Vector3d& y) { return (x - y).norm() < 1e-9 * radius_; };
    const auto found = std::ranges::find_if(points, same);
    if (found != points.end())
      return static_cast<NodeIndex>(found - points.begin());
    points.push_back(x);
    return static_cast<NodeIndex>(points.size()) - 1;
  }

  double radius_;
  int n_;
  QuarterDisc disc_;
};

} // namespace

QuarterDisc quarter_disc(double radius, int n) {
  return DiscBlocks(radius, n).fill();
}

} // namespace rubato::verification
