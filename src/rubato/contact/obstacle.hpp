// SPDX-License-Identifier: LGPL-3.0-or-later
/// Rigid surfaces that a formula gives: masters without nodes, at rest or moved as a function of time.
///
/// The gap is the distance of a point x from the surface, g(x) > 0 where bodies may be, and the normal its
/// slope: n = ∇g, dn = ∇∇g dx. With r = x − p, the obstacle's point p moved by o(t), a and n turned by R(t):
///   plane      g = n·r                            ∇∇g = 0
///   cylinder   g = ±(|r′| − R), r′ = r − (a·r) a    ∇∇g = ±(I − a aᵀ − e eᵀ)/|r′|,  e = r′/|r′|, n = ±e
///   sphere     g = ±(|r| − R)                     ∇∇g = ±(I − e eᵀ)/|r|
/// + outside, − inside.
#pragma once

#include "rubato/constraint/rotation.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rubato::contact {

/// Where an obstacle is at an instant.
struct Pose {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   ///< o(t), of its point [length]
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< R(t), of its normal or axis
};

/// As the space of the unknowns sees it: a sphere of an axisymmetric study is a circle there.
struct Obstacle {
  study::ObstacleKind kind = study::ObstacleKind::plane;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();      ///< p where the deck puts it [length]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ(); ///< unit normal of a plane, unit axis of a cylinder
  double radius = 0;                                    ///< R [length]
  double sign = 1;                                      ///< −1 where bodies are inside
  std::array<double, 3> move{};                         ///< factors of the functions [length]
  std::array<std::optional<Function>, 3> functions;
  std::array<std::optional<FieldFunction>, 3> base; ///< motion of the ground that carries it [length]
  std::optional<constraint::Rotation> rotation;     ///< the line is carried along by all translations

  Pose pose(double t) const;
  /// How far it is translated from where the deck puts it.
  Eigen::Vector3d translation(double t) const;
  Eigen::Vector3d translation(double from, double to) const { return translation(to) - translation(from); }
  /// How far its surface comes between two instants under a point that is at `start` and at `end` then: half
  /// the chord of the place of the obstacle that is at `start`, from there on, and half the chord of the one
  /// that comes to `end`. A point that sticks comes as far, by any angle; under one that stays where it is
  /// the surface comes along a circle's tangent, by sin Δθ of the arm. Both places count only where it
  /// rotates.
  Eigen::Vector3d way(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double from, double to) const;
  /// ∂way/∂end; 0 where it does not rotate.
  Eigen::Matrix3d way_by_end(double from, double to) const;
  bool moves() const;
};

/// `functions` are the deck's; those that the obstacle names are among them. Without its rotation.
Obstacle make_obstacle(const study::Obstacle& obstacle, study::Physics physics,
                       const std::map<std::string, Function>& functions);

struct ObstacleEntry {
  study::ObstacleKind kind;
  std::string_view name;
  std::string_view summary;
};
/// Every obstacle there is, for `rubato list`.
std::span<const ObstacleEntry> all_obstacles();

/// What a point sees of an obstacle. Tangents are τ₁ and τ₂ = n × τ₁; τ₂ is e_z in 2D and the axis on a
/// cylinder; those of a plane turn with it. On a sphere τ₁ is turned along with the normal, by the least turn
/// from where a reference point sees it: no field of tangents is smooth all over a sphere.
struct PlaceOnObstacle {
  double gap = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero(); ///< dn = curvature dx
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  ///< τ₁
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< τ₂·dτ₁ = spin·dn
};

/// The place that x sees of an obstacle in a pose. `reference`: the same point undeformed, of an obstacle
/// that has not moved.
PlaceOnObstacle place_on(const Obstacle& obstacle, const Pose& pose, const Eigen::Vector3d& x,
                         const Eigen::Vector3d& reference);

} // namespace rubato::contact
