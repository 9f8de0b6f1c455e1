// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/self_contact_normals.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

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

Vector3d across(const Vector3d& apart, const Vector3d& direction) {
  return apart - apart.dot(direction) * direction;
}

/// η with (x(η) − x) × p = 0 by Newton's method, then the nearest of the face.
Vector2d place_along(const MasterFace& face, const Vector3d& x, const Vector3d& direction) {
  const bool line = parametric_dimension(face.type) == 1;
  Projection place;
  if (cell::topology(face.type).corner_count == 3)
    place.xi.setConstant(1. / 3);
  for (int iteration = 0; iteration < max_foot_iterations; ++iteration) {
    const auto at = face_geometry(face.type, face.x, place.xi);
    const Vector3d off = across(at.position - x, direction);
    Eigen::Matrix<double, 3, 2> slopes;
    for (int a = 0; a < 2; ++a)
      slopes.col(a) = across(at.tangents.col(a), direction);
    Vector2d step = Vector2d::Zero();
    if (line)
      step[0] = -slopes.col(0).dot(off) / slopes.col(0).squaredNorm();
    else
      step = -(slopes.transpose() * slopes).ldlt().solve(slopes.transpose() * off);
    if (!step.allFinite())
      break;
    place.xi = (place.xi + step).cwiseMax(-farthest_foot).cwiseMin(farthest_foot);
    if (step.norm() <= last_foot_step)
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
    const Vector3d grown = Vector3d::Constant(2 * reach_);
    work_.search.find(Box(x_[k] - grown, x_[k] + grown), work_.candidates);
    const auto& around = surface_.faces_of_node[k];
    std::erase_if(work_.candidates, [&](int candidate) {
      return std::ranges::none_of(around, [&](int face) { return options_.may_pair(face, candidate); });
    });
  }

  Vector3d normal_at(int face, const Vector2d& eta) const {
    const auto& of = surface_.faces[static_cast<std::size_t>(face)];
    const auto values = face_values(of.type, eta);
    Vector3d normal = Vector3d::Zero();
    for (std::size_t i = 0; i < of.node_span().size(); ++i)
      normal += values[i] * own_[static_cast<std::size_t>(of.positions[i])];
    return normal.stableNormalized();
  }

  MetFace met_along(std::size_t k, const Vector3d& direction) const {
    MetFace best;
    for (const int candidate : work_.candidates) {
      const auto& face = work_.masters[static_cast<std::size_t>(candidate)];
      MetFace met{.face = candidate, .eta = place_along(face, x_[k], direction)};
      const Vector3d apart = face_position(face.type, face.x, met.eta) - x_[k];
      met.beside = across(apart, direction).norm();
      met.ahead = std::abs(apart.dot(direction));
      met.normal = normal_at(candidate, met.eta);
      if (met.normal.dot(direction) < 0 && met.beside <= reach_ && met.ahead <= reach_ &&
          met.precedes(best, same_distance * reach_))
        best = met;
    }
    return best;
  }

  Vector3d mean_normal(std::size_t k) const {
    Vector3d direction = own_[k];
    for (int round = 0; round < max_rounds; ++round) {
      const auto met = met_along(k, direction);
      const Vector3d difference = own_[k] - met.normal;
      if (met.face < 0 || difference.norm() < no_difference)
        return round == 0 ? own_[k] : direction;
      const Vector3d next = difference.normalized();
      const double turn = (next - direction).norm();
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
