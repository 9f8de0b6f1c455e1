// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/follower_pressure.hpp"

#include "rubato/load/face_integrals.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace rubato::load {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The most nodes of a face.
using Places = std::array<Vector3d, 9>;

bool is_edge(CellType type) {
  return cell::topology(type).dimension == 1;
}

int components_of(const FollowerFace& face) {
  return is_edge(face.type) ? 2 : 3;
}

/// Whether the value changes with time otherwise than by its function.
bool varies_by_itself(const FieldFunction& value) {
  return (value.expression && value.expression->has('t')) ||
         (value.sampled && value.sampled->varies_in_time());
}

FacePoint undeformed_point(const FollowerFace& face, const cell::ShapeTable& table, Index q) {
  return face_point(table, q, [&](std::size_t i) -> const Vector3d& { return face.places[i]; });
}

std::array<double, 3> place_of(const FollowerFace& face, const cell::ShapeTable& table, Index q) {
  const auto x = undeformed_point(face, table, q).place;
  return {x[0], x[1], x[2]};
}

/// Where the nodes of a face are at displacements u.
Places current_places(const FollowerFace& face, const VectorXd& u) {
  Places places;
  const int components = components_of(face);
  for (std::size_t i = 0; i < face.dofs.size(); ++i) {
    places.at(i) = face.places[i];
    places.at(i).head(components) += u.segment(face.dofs[i], components);
  }
  return places;
}

/// The pressure at the points of faces at an instant.
class PressureAt {
public:
  PressureAt(const FollowerPressure& load, double t)
      : load_(load), t_(t), factor_(load.value.function ? value_at(*load.value.function, t) : 1.0) {}

  double operator()(const FollowerFace& face, const cell::ShapeTable& table, Index q) const {
    if (!face.pressure.empty())
      return factor_ * face.pressure[static_cast<std::size_t>(q)];
    return factor_ * load_.value.multiplied_at(place_of(face, table, q), t_);
  }

private:
  const FollowerPressure& load_;
  double t_;
  double factor_;
};

Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

/// How much the measure of a ring grows with its radius, per length of the meridian.
double measure_slope(const element::Section& section) {
  return section.physics == study::Physics::axisymmetric ? 2 * std::numbers::pi : 0.0;
}

/// ∂(measure t)/∂u_j at a point.
Matrix3d slope_of_area(const element::Section& section, CellType type, const FacePoint& point,
                       const cell::ShapeTable& table, Index q, Index j) {
  if (!is_edge(type))
    return cross_matrix(table.gradients(2 * j + 1, q) * point.tangent -
                        table.gradients(2 * j, q) * point.second_tangent);
  Matrix3d slope = Matrix3d::Zero();
  const double turned = element::measure(section, point.place.x()) * table.gradients(j, q);
  slope(0, 1) = turned;
  slope(1, 0) = -turned;
  slope.col(0) += measure_slope(section) * table.values(j, q) * area_vector(type, point);
  return slope;
}

FollowerStiffness stiffness_of(const FollowerPressure& load, const FollowerFace& face, const VectorXd& u,
                               const PressureAt& pressure_at) {
  const auto& table = cell::mass_table(face.type);
  const auto places = current_places(face, u);
  const int d = components_of(face);
  const Index nodes = table.values.rows();
  FollowerStiffness k = FollowerStiffness::Zero(nodes * d, nodes * d);
  for (Index q = 0; q < table.weights.size(); ++q) {
    const auto point = face_point(table, q, [&](std::size_t i) -> const Vector3d& { return places.at(i); });
    const double weight = table.weights[q] * pressure_at(face, table, q);
    for (Index j = 0; j < nodes; ++j) {
      const Matrix3d slope = weight * slope_of_area(load.section, face.type, point, table, q, j);
      for (Index i = 0; i < nodes; ++i)
        k.block(i * d, j * d, d, d) += table.values(i, q) * slope.topLeftCorner(d, d);
    }
  }
  return k;
}

/// The first of the values that a node's rows have in a column, one after another.
double* values_of(domain::SparseMatrix& matrix, int row, int column) {
  const int* const first = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
  const int* const last = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
  const int* const place = std::lower_bound(first, last, row);
  if (place == last || *place != row)
    throw std::invalid_argument("the matrix lacks places for the nodes of a loaded face");
  return matrix.valuePtr() + (place - matrix.innerIndexPtr());
}

void add_symmetric_part(const FollowerFace& face, const FollowerStiffness& k, double factor,
                        domain::SparseMatrix& matrix) {
  const int d = components_of(face);
  for (std::size_t j = 0; j < face.dofs.size(); ++j)
    for (int b = 0; b < d; ++b) {
      const auto column = static_cast<Index>(j) * d + b;
      for (std::size_t i = 0; i < face.dofs.size(); ++i) {
        double* const values = values_of(matrix, face.dofs[i], face.dofs[j] + b);
        for (int a = 0; a < d; ++a) {
          const auto row = static_cast<Index>(i) * d + a;
          values[a] += factor / 2 * (k(row, column) + k(column, row));
        }
      }
    }
}

FollowerFace face_of(const mesh::Mesh& mesh, const domain::DofMap& dofs, const Face& face) {
  FollowerFace made{face.type, {}, {}, {}};
  for (const auto node : face.nodes) {
    check_carried(mesh, dofs, node);
    made.places.push_back(mesh.points[static_cast<std::size_t>(node)]);
    made.dofs.push_back(dofs.dof(node, 0));
  }
  return made;
}

} // namespace

FollowerPressure make_follower_pressure(const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                        const element::Section& section, std::span<const Face> faces,
                                        FieldFunction value) {
  check_sides(section, faces);
  FollowerPressure load{section, std::move(value), {}};
  const bool known = !varies_by_itself(load.value);
  for (const auto& face : faces) {
    auto& made = load.faces.emplace_back(face_of(mesh, dofs, face));
    const auto& table = cell::mass_table(face.type);
    for (Index q = 0; known && q < table.weights.size(); ++q)
      made.pressure.push_back(load.value.multiplied_at(place_of(made, table, q), 0));
  }
  return load;
}

void add_follower_force(const FollowerPressure& load, const VectorXd& u, double t, VectorXd& force) {
  const PressureAt pressure_at(load, t);
  for (const auto& face : load.faces) {
    const auto& table = cell::mass_table(face.type);
    const auto places = current_places(face, u);
    const int d = components_of(face);
    for (Index q = 0; q < table.weights.size(); ++q) {
      const auto point = face_point(table, q, [&](std::size_t i) -> const Vector3d& { return places.at(i); });
      const Vector3d traction = -table.weights[q] * pressure_at(face, table, q) *
                                element::measure(load.section, point.place.x()) *
                                area_vector(face.type, point);
      for (Index i = 0; i < table.values.rows(); ++i)
        force.segment(face.dofs[static_cast<std::size_t>(i)], d) += table.values(i, q) * traction.head(d);
    }
  }
}

FollowerStiffness stiffness_of(const FollowerPressure& load, const FollowerFace& face, const VectorXd& u,
                               double t) {
  return stiffness_of(load, face, u, PressureAt(load, t));
}

void add_follower_tangent(const FollowerPressure& load, const VectorXd& u, double t, double factor,
                          domain::SparseMatrix& matrix) {
  const PressureAt pressure_at(load, t);
  for (const auto& face : load.faces)
    add_symmetric_part(face, stiffness_of(load, face, u, pressure_at), factor, matrix);
}

} // namespace rubato::load
