// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/self_contact_normals.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int max_rounds = 60;
constexpr double last_turn = 1e-15;
constexpr int max_foot_iterations = 20;
constexpr double last_foot_step = 1e-12;
/// On the master's reference face the line is followed up to there.
constexpr double farthest_foot = 3;
/// Of normals that turn away from each other by less, their difference has no direction.
constexpr double no_difference = 1e-3;
/// Distances this near to each other, in reaches, are the same: rounding would choose one of two faces.
constexpr double same_distance = 1e-9;

/// Where a line meets a face, or the place of the face beside it.
struct MetFace {
  int face = -1;
  Vector2d eta = Vector2d::Zero();
  double beside = INFINITY; ///< distance of the line from the face
  double ahead = INFINITY;  ///< along the line, to either side
  Vector3d normal = Vector3d::Zero();

  bool precedes(const MetFace& other, double same) const {
    if (std::abs(beside - other.beside) > same)
      return beside < other.beside;
    return ahead < other.ahead - same || other.face < 0;
  }
};

/// The solution of a symmetric system of two equations without negative eigenvalues, by L D Lᵀ with the
/// larger diagonal entry first; 0 along what the matrix has no stiffness for.
Vector2d solve_symmetric(double m00, double m01, double m11, const Vector2d& right) {
  const int first = m11 > m00 ? 1 : 0;
  const double largest = first == 0 ? m00 : m11, other = first == 0 ? m11 : m00;
  constexpr double least = std::numeric_limits<double>::min();
  const double factor = largest > least ? m01 / largest : 0;
  const double left = other - factor * m01;
  Vector2d x(0, 0);
  if (std::abs(left) > least)
    x[1 - first] = (right[1 - first] - factor * right[first]) / left;
  if (largest > least)
    x[first] = right[first] / largest - factor * x[1 - first];
  return x;
}

/// η with (x(η) − x) × p = 0 by Newton's method, then the nearest of the face.
Vector2d place_along(const MasterFace& face, const Vector3d& x, const Vector3d& direction) {
  const bool line = parametric_dimension(face.type) == 1;
  Projection place;
  if (cell::topology(face.type).corner_count == 3)
    place.xi.setConstant(1. / 3);
  for (int iteration = 0; iteration < max_foot_iterations; ++iteration) {
    const auto at = face_geometry(face.type, face.x, place.xi);
    const Vector3d off = part_across(direction, difference_of(at.position, x));
    const Vector3d first = part_across(direction, column_of(at.tangents, 0));
    const Vector3d second = part_across(direction, column_of(at.tangents, 1));
    Vector2d step(-dot(first, off) / dot(first, first), 0);
    if (!line)
      step = solve_symmetric(dot(first, first), dot(first, second), dot(second, second),
                             {-dot(first, off), -dot(second, off)});
    if (!std::isfinite(step[0]) || !std::isfinite(step[1]))
      break;
    for (int a = 0; a < 2; ++a)
      place.xi[a] = std::clamp(place.xi[a] + step[a], -farthest_foot, farthest_foot);
    if (std::hypot(step[0], step[1]) <= last_foot_step)
      break;
  }
  clamp_to_face(face.type, place);
  return place.clamped;
}

class MeanNormals {
public:
  MeanNormals(const Surface& surface, std::span<const Vector3d> x, const Options& options, double reach,
              Workspace::Impl& work)
      : surface_(surface), x_(x), options_(options), reach_(reach), work_(work), own_(work.normals) {}

  void take() {
    for (std::size_t k = 0; k < own_.size(); ++k) {
      if (own_[k].isZero(0))
        continue;
      find_candidates(k);
      if (!work_.candidates.empty())
        work_.normals[k] = mean_normal(k);
    }
  }

private:
  void find_candidates(std::size_t k) {
    const Vector3d grown(2 * reach_, 2 * reach_, 2 * reach_);
    work_.search.find(Box(difference_of(x_[k], grown), sum_of(x_[k], grown)), work_.candidates);
    const auto& around = surface_.faces_of_node[k];
    std::erase_if(work_.candidates, [&](int candidate) {
      return std::ranges::none_of(around, [&](int face) { return options_.may_pair(face, candidate); });
    });
  }

  Vector3d normal_at(int face, const Vector2d& eta) const {
    const auto& of = surface_.faces[static_cast<std::size_t>(face)];
    const auto values = face_values(of.type, eta);
    Vector3d normal(0, 0, 0);
    for (std::size_t i = 0; i < of.node_span().size(); ++i)
      add_scaled(values[i], own_[static_cast<std::size_t>(of.positions[i])], normal);
    return unit_of(normal);
  }

  MetFace met_along(std::size_t k, const Vector3d& direction) const {
    MetFace best;
    for (const int candidate : work_.candidates) {
      const auto& face = work_.masters[static_cast<std::size_t>(candidate)];
      MetFace met{.face = candidate, .eta = place_along(face, x_[k], direction)};
      const Vector3d apart = difference_of(face_position(face.type, face.x, met.eta), x_[k]);
      met.beside = length_of(part_across(direction, apart));
      met.ahead = std::abs(dot(apart, direction));
      met.normal = normal_at(candidate, met.eta);
      if (dot(met.normal, direction) < 0 && met.beside <= reach_ && met.ahead <= reach_ &&
          met.precedes(best, same_distance * reach_))
        best = met;
    }
    return best;
  }

  Vector3d mean_normal(std::size_t k) const {
    Vector3d direction = own_[k];
    for (int round = 0; round < max_rounds; ++round) {
      const auto met = met_along(k, direction);
      const Vector3d difference = difference_of(own_[k], met.normal);
      if (met.face < 0 || length_of(difference) < no_difference)
        return round == 0 ? own_[k] : direction;
      const Vector3d next = unit_of(difference);
      const double turn = length_of(difference_of(next, direction));
      direction = next;
      if (turn <= last_turn)
        break;
    }
    return direction;
  }

  const Surface& surface_;
  std::span<const Vector3d> x_;
  const Options& options_;
  double reach_;
  Workspace::Impl& work_;
  std::vector<Vector3d> own_; ///< m_k
};

} // namespace

void take_mean_normals(const Surface& surface, std::span<const Vector3d> x, const Options& options,
                       double reach, Workspace::Impl& work) {
  MeanNormals(surface, x, options, reach, work).take();
}

} // namespace rubato::contact::mortar
