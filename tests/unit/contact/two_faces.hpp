// SPDX-License-Identifier: LGPL-3.0-or-later
/// A slave face above a master face, both of any type, warped and shifted by seeded random numbers. The
/// master may be an obstacle instead.
#pragma once

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/enforcement.hpp"

#include <optional>
#include <random>

namespace rubato::test {

struct TwoFaces {
  mesh::Mesh mesh;
  domain::DofMap dofs;
  contact::Zone zone;
  Eigen::VectorXd u;
  Eigen::VectorXd u_start;
  double t = 1;
  double t_start = 0.4;

  contact::Configuration configuration(const Eigen::VectorXd& displacement) const {
    return {&mesh, &dofs, &displacement, &u_start, t, t_start};
  }
};

struct TwoFacesOptions {
  CellType slave = CellType::quad4;
  CellType master = CellType::quad4;
  study::ContactNormal normal = study::ContactNormal::master;
  study::ClampedNormal clamped_normal = study::ClampedNormal::projection;
  double friction = 0.3;
  int gauss = 0;
  double shift = 0;      ///< of the slave along x: beyond 1 its points leave the master
  double height = -0.02; ///< of the slave above the master
  unsigned seed = 1;
  std::optional<contact::Obstacle> obstacle = std::nullopt;
};

/// Reference points of the face, the master's normal upwards, the slave's downwards (mirrored in x).
inline void add_face(TwoFaces& setup, contact::Face& face, CellType type, bool downwards, double shift,
                     double height, std::mt19937& random, double warp) {
  std::uniform_real_distribution<double> noise(-warp, warp);
  const auto& cell = cell::reference_cell(type);
  const bool plane = cell.dimension == 1;
  face.type = type;
  face.node_count = cell.node_count;
  for (int i = 0; i < cell.node_count; ++i) {
    const auto& xi = cell.nodes[static_cast<std::size_t>(i)];
    face.nodes[static_cast<std::size_t>(i)] = setup.mesh.node_count();
    // In 2D the outward normal is (t_y, −t_x): a segment running to −x looks upwards.
    const double x = (plane ? !downwards : downwards) ? -xi[0] : xi[0];
    Eigen::Vector3d point =
        plane ? Eigen::Vector3d(x + shift, height, 0) : Eigen::Vector3d(x + shift, xi[1], height);
    for (int a = 0; a < (plane ? 2 : 3); ++a)
      point[a] += noise(random);
    setup.mesh.points.push_back(point);
  }
}

inline TwoFaces two_faces(const TwoFacesOptions& options) {
  TwoFaces setup;
  std::mt19937 random(options.seed);
  const bool plane = cell::topology(options.slave).dimension == 1;
  setup.mesh.dimension = plane ? 2 : 3;
  contact::Face master;
  contact::Face slave;
  add_face(setup, master, options.master, false, 0, 0, random, 0.06);
  add_face(setup, slave, options.slave, true, options.shift, options.height, random, 0.06);
  const auto count = setup.mesh.node_count();
  setup.dofs.components = setup.mesh.dimension;
  for (mesh::NodeIndex node = 0; node < count; ++node) {
    setup.dofs.first_dof.push_back(node * setup.mesh.dimension);
    setup.dofs.nodes.push_back(node);
    setup.mesh.node_numbers.push_back(node + 1);
  }
  setup.dofs.dof_count = count * setup.mesh.dimension;
  std::uniform_real_distribution<double> move(-0.03, 0.03);
  setup.u = Eigen::VectorXd::NullaryExpr(setup.dofs.dof_count, [&] { return move(random); });
  setup.u_start = Eigen::VectorXd::NullaryExpr(setup.dofs.dof_count, [&] { return move(random); });
  study::ContactZone settings;
  settings.name = "zone";
  settings.friction = options.friction;
  settings.normal = options.normal;
  settings.clamped_normal = options.clamped_normal;
  if (options.gauss > 0)
    settings.integration = {study::ContactIntegration::gauss, options.gauss};
  const contact::ZoneGeometry geometry{setup.mesh.dimension, 1.0, {}};
  const auto slaves = contact::make_surface(setup.mesh, {slave});
  setup.zone = options.obstacle
                   ? contact::make_zone(setup.mesh, settings, *options.obstacle, slaves, {}, geometry)
                   : contact::make_zone(setup.mesh, settings, contact::make_surface(setup.mesh, {master}),
                                        slaves, {}, geometry);
  return setup;
}

} // namespace rubato::test
