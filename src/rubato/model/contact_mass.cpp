// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/contact_mass.hpp"

#include "rubato/constraint/reduction.hpp"
#include "rubato/core/index.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/node_label.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace rubato::model {
namespace {

using domain::SparseMatrix;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Neighbours of neighbours up to that are near a node.
constexpr int most_rings = 4;
/// Distances that differ by less, relative, are the same.
constexpr double equally_far = 1e-6;
/// A determinant of an inertia over the cube of its trace that is none.
constexpr double flat = 1e-6;

struct Weight {
  int node = 0; ///< a numbered one
  Matrix3d value = Matrix3d::Zero();
};
using Weights = std::vector<Weight>;

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d matrix;
  matrix << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return matrix;
}

/// The inverse of an inertia; in the plane about z. Nothing where a rotation moves no place.
std::optional<Matrix3d> inverse_of(const Matrix3d& inertia, int dimension) {
  const double size = inertia.trace();
  Matrix3d inverse = Matrix3d::Zero();
  if (dimension == 2) {
    if (!(inertia(2, 2) > 0))
      return std::nullopt;
    inverse(2, 2) = 1 / inertia(2, 2);
    return inverse;
  }
  if (!(inertia.determinant() > flat * size * size * size))
    return std::nullopt;
  return Matrix3d(inertia.inverse());
}

/// A node inside, seen from a surface node.
struct Seen {
  double distance = 0;
  int node = 0;
};

/// Numbered nodes that have a cell in common, by the places of a mass matrix.
class Surroundings {
public:
  Surroundings(const mesh::Mesh& mesh, const domain::DofMap& dofs, const SparseMatrix& mass,
               const std::vector<char>& on_surface)
      : mesh_(mesh), dofs_(dofs), mass_(mass), on_surface_(on_surface) {}

  const Eigen::Vector3d& place(int node) const { return mesh_.points[at(dofs_.nodes[at(node)])]; }

  template <class Visit> void for_each_neighbour(int node, const Visit& visit) const {
    const Index column = static_cast<Index>(node) * dofs_.components;
    for (SparseMatrix::InnerIterator entry(mass_, column); entry; ++entry)
      if (entry.row() % dofs_.components == 0)
        visit(static_cast<int>(entry.row() / dofs_.components));
  }

  /// Nodes inside within so many rings around a node, the nearest first.
  std::vector<Seen> inside_near(int node, int rings) const {
    std::set<int> found{node};
    std::vector<int> front{node};
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<int> next;
      for (const int from : front)
        for_each_neighbour(from, [&](int to) {
          if (found.insert(to).second)
            next.push_back(to);
        });
      front = std::move(next);
    }
    std::vector<Seen> seen;
    for (const int other : found)
      if (on_surface_[at(other)] == 0)
        seen.push_back({(place(other) - place(node)).norm(), other});
    std::ranges::sort(seen, [](const Seen& a, const Seen& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
    });
    return seen;
  }

  int dimension() const { return mesh_.dimension; }

private:
  const mesh::Mesh& mesh_;
  const domain::DofMap& dofs_;
  const SparseMatrix& mass_;
  const std::vector<char>& on_surface_;
};

/// v = v_a + ω × (x − x_a). Node a is the nearest one, or the mean of those that are equally near. The nodes
/// around rotate by ω = I⁻¹ Σ w_k r_k × v_k, I = Σ w_k (|r_k|² 1 − r_k r_kᵀ), w_k = d_k⁻⁴, r_k from their
/// centre. Nothing where their places do not determine a rotation.
///
/// The nearest node alone carries the translation: a smooth mean would not accelerate all nodes of a plane
/// front alike.
std::optional<Weights> weights_of(const Surroundings& around, int node, std::span<const Seen> seen) {
  const double nearest = seen.front().distance;
  const auto anchors = std::ranges::count_if(
      seen, [&](const Seen& other) { return other.distance <= (1 + equally_far) * nearest; });
  std::vector<double> parts;
  double sum = 0;
  Vector3d centre(0, 0, 0), anchor(0, 0, 0);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    sum += parts.emplace_back(std::pow(nearest / seen[k].distance, 4));
    centre += parts[k] * around.place(seen[k].node);
    if (static_cast<std::ptrdiff_t>(k) < anchors)
      anchor += around.place(seen[k].node) / static_cast<double>(anchors);
  }
  centre /= sum;
  Matrix3d inertia = Matrix3d::Zero();
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Matrix3d across = cross_matrix(around.place(seen[k].node) - centre);
    inertia -= parts[k] * across * across;
  }
  const auto inverse = inverse_of(inertia, around.dimension());
  if (!inverse)
    return std::nullopt;
  const Matrix3d arm = cross_matrix(around.place(node) - anchor) * *inverse;
  Weights weights;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    Matrix3d value = -parts[k] * arm * cross_matrix(around.place(seen[k].node) - centre);
    if (static_cast<std::ptrdiff_t>(k) < anchors)
      value += Matrix3d::Identity() / static_cast<double>(anchors);
    weights.push_back({seen[k].node, value});
  }
  return weights;
}

/// From the nodes inside of the cells around, or farther ones where these are in a line.
std::optional<Weights> extrapolated(const Surroundings& around, int node) {
  for (int rings = 1; rings <= most_rings; ++rings)
    if (const auto seen = around.inside_near(node, rings); !seen.empty())
      if (auto weights = weights_of(around, node, seen))
        return weights;
  return std::nullopt;
}

/// The velocity of the nearest node inside.
Weights nearest_of(const Surroundings& around, int node) {
  for (int rings = 1; rings <= most_rings; ++rings)
    if (const auto seen = around.inside_near(node, rings); !seen.empty())
      return {{seen.front().node, Matrix3d::Identity()}};
  return {};
}

/// The slave nodes of all zones but ties, by body; zones in the terms of bodies.
struct Surfaces {
  std::vector<char> on_surface;              ///< by numbered node
  std::vector<std::vector<int>> of_body;     ///< numbered nodes
  std::vector<std::set<int>> bodies_of_zone; ///< of zones but ties
};

Surfaces surfaces_of(std::span<const contact::Zone> zones, const domain::DofMap& dofs, const Bodies& bodies) {
  Surfaces surfaces;
  surfaces.on_surface.assign(dofs.nodes.size(), 0);
  surfaces.of_body.resize(at(bodies.count()));
  for (const auto& zone : zones) {
    if (zone.settings.tie) // nothing ever hits there
      continue;
    auto& of_zone = surfaces.bodies_of_zone.emplace_back();
    for (const auto node : zone.slave.nodes) {
      const int body = bodies.of(node), number = dofs.dof(node, 0) / dofs.components;
      of_zone.insert(body);
      if (std::exchange(surfaces.on_surface[at(number)], 1) == 0)
        surfaces.of_body[at(body)].push_back(number);
    }
  }
  return surfaces;
}

/// Bodies whose inertia moves nothing: supports hold all their nodes but those on the surface, or they have
/// no mass.
std::vector<char> held_bodies(const domain::DofMap& dofs, const constraint::Reduction& reduction,
                              const Bodies& bodies, const Surfaces& surfaces, const SparseMatrix& mass) {
  const auto count = at(bodies.count());
  std::vector<char> has_mass(count, 0), is_held(count, 0), is_free(count, 0);
  for (std::size_t i = 0; i < dofs.nodes.size(); ++i) {
    const int body = bodies.of(dofs.nodes[i]);
    if (body < 0)
      continue;
    for (int c = 0; c < dofs.components; ++c) {
      const int dof = dofs.dof(dofs.nodes[i], c);
      if (mass.coeff(dof, dof) > 0)
        has_mass[at(body)] = 1;
      if (surfaces.on_surface[i] == 0)
        (reduction.is_prescribed(dof) ? is_held : is_free)[at(body)] = 1;
    }
  }
  std::vector<char> held(count);
  for (std::size_t b = 0; b < count; ++b)
    held[b] = has_mass[b] == 0 || (is_held[b] != 0 && is_free[b] == 0) ? 1 : 0;
  return held;
}

/// A zone keeps the mass of its whole slave or of nothing.
void spread_over_zones(const Surfaces& surfaces, std::vector<char>& keeps) {
  const auto keeps_mass = [&](int body) { return keeps[at(body)] != 0; };
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& bodies : surfaces.bodies_of_zone)
      if (std::ranges::any_of(bodies, keeps_mass) && !std::ranges::all_of(bodies, keeps_mass)) {
        for (const int body : bodies)
          keeps[at(body)] = 1;
        changed = true;
      }
  }
}

/// P, the identity where a node has no weights of its own.
SparseMatrix matrix_of(const std::map<int, Weights>& weights, const domain::DofMap& dofs) {
  const int components = dofs.components;
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int node = 0; node < static_cast<int>(dofs.nodes.size()); ++node) {
    const auto found = weights.find(node);
    for (int row = 0; row < components; ++row)
      if (found == weights.end())
        entries.emplace_back(node * components + row, node * components + row, 1);
      else
        for (const auto& weight : found->second)
          for (int column = 0; column < components; ++column)
            if (weight.value(row, column) != 0)
              entries.emplace_back(node * components + row, weight.node * components + column,
                                   weight.value(row, column));
  }
  SparseMatrix matrix(dofs.dof_count, dofs.dof_count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::string note_on(const mesh::Mesh& mesh, mesh::NodeIndex node) {
  return fmt::format(
      "contact_mass: the body around {} has no nodes beside its contact surface that could carry "
      "the mass; the surface keeps it, and contact forces may oscillate from step to step; expected "
      "more cells, or this side as the master",
      node_label(mesh, node));
}

} // namespace

MasslessSurfaces massless_surfaces(const mesh::Mesh& mesh, const domain::Bulk& bulk,
                                   const domain::DofMap& dofs, const constraint::Reduction& reduction,
                                   std::span<const contact::Zone> zones, const SparseMatrix& mass) {
  const Bodies bodies(mesh, bulk);
  const auto surfaces = surfaces_of(zones, dofs, bodies);
  const auto held = held_bodies(dofs, reduction, bodies, surfaces, mass);
  const Surroundings around(mesh, dofs, mass, surfaces.on_surface);
  MasslessSurfaces found;
  std::vector<char> keeps(held.size(), 0);
  std::map<int, Weights> weights;
  for (std::size_t b = 0; b < held.size(); ++b)
    for (const int node : surfaces.of_body[b]) {
      auto of_node = held[b] != 0 ? std::optional(nearest_of(around, node)) : extrapolated(around, node);
      if (!of_node) {
        keeps[b] = 1;
        found.notes.push_back(note_on(mesh, dofs.nodes[at(node)]));
        break;
      }
      weights.emplace(node, std::move(*of_node));
    }
  spread_over_zones(surfaces, keeps);
  for (auto entry = weights.begin(); entry != weights.end();) {
    const auto node = dofs.nodes[at(entry->first)];
    if (keeps[at(bodies.of(node))] != 0) {
      entry = weights.erase(entry);
      continue;
    }
    found.nodes.push_back(node);
    ++entry;
  }
  std::ranges::sort(found.nodes);
  found.extrapolation = matrix_of(weights, dofs);
  return found;
}

void take_mass_off(const SparseMatrix& extrapolation, SparseMatrix& mass) {
  mass = SparseMatrix(extrapolation.transpose() * mass * extrapolation);
}

} // namespace rubato::model
