// SPDX-License-Identifier: LGPL-3.0-or-later
// Small structures of nonlinear cells: patches, Cook's membrane (R. D. Cook, J. Struct. Div. ASCE 100 (1974)
// 1851–1863), a cantilever, a tube under pressure, the elastica (K. Mattiasson, Int. J. Numer. Meth. Eng. 17
// (1981) 145–153). Numbers without a closed form are those of an independent implementation of the same
// formulas in another language.
#include "rubato/element/nonlinear.hpp"

#include <gtest/gtest.h>

#include "point_test_laws.hpp"
#include "support/bulk_cells.hpp"
#include "support/dense.hpp"
#include <array>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace rubato::element::nonlinear_assembly_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;
using test::ElasticLaw;
using test::NeoHookeanLaw;
using Map = std::function<Vector3d(const Vector3d&)>;

/// n[0] × n[1] (× n[2]) boxes of the unit square or cube at map(point); prisms: two a box.
class Grid {
public:
  Grid(const CellKind& of_kind, std::array<int, 3> n, const Map& map)
      : kind(of_kind), d(component_count(kind.section.physics)), n_(n) {
    if (d == 2)
      n_[2] = 0;
    for (int k = 0; k <= n_[2]; ++k)
      for (int j = 0; j <= n_[1]; ++j)
        for (int i = 0; i <= n_[0]; ++i) {
          place.emplace_back(double(i) / n[0], double(j) / n[1], d == 3 ? double(k) / n[2] : 0.);
          points.push_back(map(place.back()));
        }
    for (int k = 0; k < std::max(1, n_[2]); ++k)
      for (int j = 0; j < n_[1]; ++j)
        for (int i = 0; i < n_[0]; ++i)
          add_box(i, j, k);
  }

  int node(int i, int j, int k = 0) const { return i + (n_[0] + 1) * (j + (n_[1] + 1) * k); }
  /// The node whose place in the unit square or cube is x.
  int node_at(const Vector3d& x) const {
    for (std::size_t i = 0; i < place.size(); ++i)
      if ((place[i] - x).norm() < 1e-9)
        return static_cast<int>(i);
    return -1;
  }
  Eigen::Index dofs() const { return static_cast<Eigen::Index>(points.size()) * d; }

  CellKind kind;
  int d;
  std::vector<Vector3d> place, points;
  std::vector<std::vector<int>> cells;

private:
  void add_box(int i, int j, int k) {
    std::vector<int> box{node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)};
    if (d == 3)
      for (int c = 0; c < 4; ++c)
        box.push_back(box[static_cast<std::size_t>(c)] + node(0, 0, 1));
    if (kind.type != CellType::penta6)
      return cells.push_back(box);
    cells.push_back({box[0], box[1], box[2], box[4], box[5], box[6]});
    cells.push_back({box[0], box[2], box[3], box[4], box[6], box[7]});
  }

  std::array<int, 3> n_;
};

/// Newton's method for K u = load of a grid with held displacements; no contact, no steps but those of
/// `solve`.
class Structure {
public:
  Structure(const Grid& of_grid, const PointLaws& laws)
      : u(VectorXd::Zero(of_grid.dofs())), load(u), grid_(of_grid), laws_(laws),
        size_(static_cast<std::size_t>(state_size_of_cell(grid_.kind, laws_.state_size()))),
        old_(grid_.cells.size() * size_), now_(old_), is_held_(static_cast<std::size_t>(grid_.dofs())) {}

  void hold(int node, int component, double value = 0) {
    is_held_[static_cast<std::size_t>(node * grid_.d + component)] = true;
    u[node * grid_.d + component] = value;
  }

  /// Iterations until the residual is 1e-10 of the forces; −1: no end.
  int solve(const VectorXd& loads, int most = 40) {
    for (int i = 0; i < most; ++i) {
      if (!assemble())
        return -1;
      VectorXd residual = loads - force_;
      const double size = std::max(force_.cwiseAbs().maxCoeff(), loads.cwiseAbs().maxCoeff());
      for (Eigen::Index dof = 0; dof < residual.size(); ++dof)
        if (is_held_[static_cast<std::size_t>(dof)])
          residual[dof] = 0;
      if (i > 0 && residual.cwiseAbs().maxCoeff() <= 1e-10 * size) {
        old_ = now_;
        return i;
      }
      u += test::sparse_solution(matrix_, residual);
    }
    return -1;
  }

  double at(int node, int component) const { return u[node * grid_.d + component]; }

  VectorXd u, load;

private:
  bool assemble() {
    std::vector<Eigen::Triplet<double>> entries;
    force_ = VectorXd::Zero(u.size());
    for (std::size_t cell = 0; cell < grid_.cells.size(); ++cell)
      if (!add_cell(cell, entries))
        return false;
    matrix_.resize(u.size(), u.size());
    matrix_.setFromTriplets(entries.begin(), entries.end());
    return true;
  }

  bool add_cell(std::size_t cell, std::vector<Eigen::Triplet<double>>& entries) {
    std::vector<Vector3d> points;
    std::vector<int> dofs;
    for (const int node : grid_.cells[cell]) {
      points.push_back(grid_.points[static_cast<std::size_t>(node)]);
      for (int a = 0; a < grid_.d; ++a)
        dofs.push_back(node * grid_.d + a);
    }
    const auto count = dofs.size();
    std::vector<double> here(count), force(count), tangent(count * count);
    for (std::size_t i = 0; i < count; ++i)
      here[i] = u[dofs[i]];
    const std::span before(old_), after(now_);
    if (!evaluate(grid_.kind, laws_, {points, here, before.subspan(cell * size_, size_)},
                  {after.subspan(cell * size_, size_), force, tangent}))
      return false;
    for (std::size_t j = 0; j < count; ++j) {
      force_[dofs[j]] += force[j];
      for (std::size_t i = 0; i < count; ++i)
        put(dofs[i], dofs[j], tangent[i + count * j], entries);
    }
    return true;
  }

  void put(int row, int column, double value, std::vector<Eigen::Triplet<double>>& entries) const {
    if (!is_held_[static_cast<std::size_t>(row)] && !is_held_[static_cast<std::size_t>(column)])
      entries.emplace_back(row, column, value);
    else if (row == column)
      entries.emplace_back(row, column, std::abs(value));
  }

  const Grid& grid_;
  PointLaws laws_;
  std::size_t size_;
  std::vector<double> old_, now_;
  std::vector<char> is_held_;
  VectorXd force_;
  Eigen::SparseMatrix<double> matrix_;
};

// --- patches

struct PatchCase {
  CellType type;
  Physics physics;
  Formulation formulation;
  StrainKind strain = StrainKind::small;
};

Map shaken(int n) {
  return [=](const Vector3d& x) -> Vector3d {
    std::seed_seq seed{static_cast<int>(x[0] * 100), static_cast<int>(x[1] * 100),
                       static_cast<int>(x[2] * 100)};
    std::mt19937 engine(seed);
    Vector3d moved = x;
    for (int a = 0; a < 3; ++a)
      if (x[a] > 0.01 && x[a] < 0.99)
        moved[a] += 0.25 / n * (2. * static_cast<double>(engine() % 1000) / 999. - 1.);
    return moved + Vector3d(1, 0, 0);
  };
}

TEST(NonlinearAssembly, PassesPatchTestsOfDistortedCells) {
  constexpr int n = 3;
  using enum Formulation;
  for (const auto& [type, physics, formulation, strain] :
       {PatchCase{CellType::quad4, Physics::plane_strain, mean_dilatation},
        PatchCase{CellType::quad4, Physics::plane_strain, enhanced},
        PatchCase{CellType::quad4, Physics::plane_stress, enhanced},
        PatchCase{CellType::quad4, Physics::axisymmetric, mean_dilatation},
        PatchCase{CellType::quad4, Physics::axisymmetric, enhanced},
        PatchCase{CellType::hexa8, Physics::solid, mean_dilatation},
        PatchCase{CellType::hexa8, Physics::solid, enhanced},
        PatchCase{CellType::penta6, Physics::solid, mean_dilatation},
        PatchCase{CellType::quad4, Physics::plane_strain, reduced},
        PatchCase{CellType::quad4, Physics::plane_stress, reduced},
        PatchCase{CellType::quad4, Physics::axisymmetric, reduced},
        PatchCase{CellType::hexa8, Physics::solid, reduced},
        PatchCase{CellType::hexa8, Physics::solid, reduced, StrainKind::green_lagrange},
        PatchCase{CellType::hexa8, Physics::solid, reduced, StrainKind::logarithmic},
        PatchCase{CellType::quad4, Physics::plane_strain, enhanced, StrainKind::green_lagrange},
        PatchCase{CellType::hexa8, Physics::solid, enhanced, StrainKind::green_lagrange},
        PatchCase{CellType::hexa8, Physics::solid, mean_dilatation, StrainKind::logarithmic}})
    for (const double poisson : {0.3, 0.4999}) {
      const ElasticLaw law{1., poisson};
      const Grid grid({type, {physics, 1}, strain, formulation, {law.shear()}}, {n, n, n}, shaken(n));
      const test::PlaneStressLaw<ElasticLaw> flat{law};
      Structure structure(grid, physics == Physics::plane_stress ? PointLaws(flat) : PointLaws(law));
      Eigen::Matrix3d h;
      h << 1e-3, 2e-3, -1e-3, -3e-3, 2e-3, 1e-3, 2e-3, 0, -2e-3;
      if (physics == Physics::axisymmetric)
        h(0, 1) = h(1, 0) = 0;
      VectorXd exact(grid.dofs());
      for (int i = 0; i < static_cast<int>(grid.points.size()); ++i)
        exact.segment(i * grid.d, grid.d) = (h * grid.points[static_cast<std::size_t>(i)]).head(grid.d);
      for (int i = 0; i < static_cast<int>(grid.points.size()); ++i) {
        const Vector3d& x = grid.place[static_cast<std::size_t>(i)];
        if ((x.head(grid.d).array() < 0.01 || x.head(grid.d).array() > 0.99).any())
          for (int a = 0; a < grid.d; ++a)
            structure.hold(i, a, exact[i * grid.d + a]);
      }
      ASSERT_GT(structure.solve(structure.load), 0);
      EXPECT_LT((structure.u - exact).norm(), (formulation == reduced ? 1e-12 : 1e-10) * exact.norm())
          << cell::topology(type).name << ' ' << test::name_of(physics) << ' '
          << static_cast<int>(formulation);
    }
}

// --- Cook's membrane

Map cook() {
  return [](const Vector3d& x) -> Vector3d {
    return {48 * x[0], (1 - x[0]) * 44 * x[1] + x[0] * (44 + 16 * x[1]), 0};
  };
}

Structure cook_structure(const Grid& grid, const PointLaws& laws, int n) {
  Structure structure(grid, laws);
  for (int j = 0; j <= n; ++j)
    for (int a = 0; a < 2; ++a)
      structure.hold(grid.node(0, j), a);
  for (int j = 0; j < n; ++j)
    for (const int end : {j, j + 1})
      structure.load[2 * grid.node(n, end) + 1] += 100. / n / 2;
  return structure;
}

TEST(NonlinearAssembly, BendsCooksMembraneInSmallStrain) {
  constexpr int n = 16;
  const ElasticLaw law{250., 0.4999};
  for (const auto& [formulation, corner] :
       {std::pair{Formulation::full, 2.31}, std::pair{Formulation::mean_dilatation, 7.591},
        std::pair{Formulation::enhanced, 7.605}}) {
    const Grid grid({CellType::quad4, {Physics::plane_strain, 1}, StrainKind::small, formulation}, {n, n, 1},
                    cook());
    auto structure = cook_structure(grid, PointLaws(law), n);
    ASSERT_GT(structure.solve(structure.load), 0);
    EXPECT_NEAR(structure.at(grid.node(n, n), 1), corner, formulation == Formulation::full ? 5e-3 : 5e-4);
  }
}

TEST(NonlinearAssembly, BendsCooksMembraneOfRubber) {
  constexpr int steps = 5;
  const NeoHookeanLaw law{80.1938, 400889.8};
  for (const auto& [n, corner] : {std::pair{4, 6.020}, std::pair{8, 6.619}, std::pair{16, 6.814}}) {
    const Grid grid({CellType::quad4,
                     {Physics::plane_strain, 1},
                     StrainKind::green_lagrange,
                     Formulation::mean_dilatation},
                    {n, n, 1}, cook());
    auto structure = cook_structure(grid, PointLaws(law), n);
    for (int step = 1; step <= steps; ++step)
      ASSERT_GT(structure.solve(step * structure.load / steps), 0);
    EXPECT_NEAR(structure.at(grid.node(n, n), 1), corner, 5e-4) << n;
  }
}

// --- cantilever and tube

TEST(NonlinearAssembly, BendsACantilever) {
  const ElasticLaw law{1., 0.3};
  for (const auto& [formulation, tip] :
       {std::pair{Formulation::full, 1752.}, std::pair{Formulation::mean_dilatation, 1967.},
        std::pair{Formulation::enhanced, 1989.}}) {
    const Grid grid({CellType::hexa8, {Physics::solid, 1}, StrainKind::small, formulation}, {20, 2, 2},
                    [](const Vector3d& x) -> Vector3d {
                      return {20 * x[0], 2 * x[1], 2 * x[2]};
                    });
    Structure structure(grid, PointLaws(law));
    for (int k = 0; k <= 2; ++k)
      for (int j = 0; j <= 2; ++j) {
        for (int a = 0; a < 3; ++a)
          structure.hold(grid.node(0, j, k), a);
        structure.load[3 * grid.node(20, j, k) + 2] = (j == 1 ? 0.5 : 0.25) * (k == 1 ? 0.5 : 0.25);
      }
    ASSERT_GT(structure.solve(structure.load), 0);
    EXPECT_NEAR(structure.at(grid.node(20, 1, 1), 2), tip, 1.5);
  }
}

TEST(NonlinearAssembly, WidensATube) {
  constexpr int n = 8;
  const ElasticLaw law{10., 0.4999};
  for (const auto& [formulation, widening] :
       {std::pair{Formulation::full, 0.79}, std::pair{Formulation::mean_dilatation, 3.996},
        std::pair{Formulation::enhanced, 3.987}}) {
    const Grid grid({CellType::quad4, {Physics::axisymmetric, 1}, StrainKind::small, formulation}, {n, 1, 1},
                    [](const Vector3d& x) -> Vector3d {
                      return {20 + 20 * x[0], 2.5 * x[1], 0};
                    });
    Structure structure(grid, PointLaws(law));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= 1; ++j)
        structure.hold(grid.node(i, j), 1);
    for (int j = 0; j <= 1; ++j)
      structure.load[2 * grid.node(0, j)] = 2 * std::numbers::pi * 20 * 2.5 / 2;
    ASSERT_GT(structure.solve(structure.load), 0);
    EXPECT_NEAR(structure.at(grid.node(0, 0), 0), widening, formulation == Formulation::full ? 5e-3 : 5e-4);
  }
}

// --- elastica

TEST(NonlinearAssembly, BendsTheElastica) {
  constexpr int n = 50, steps = 10;
  const ElasticLaw law{12e6, 0.}; // EI = 1 with height 0.01, width 1, length 1
  const Grid grid(
      {CellType::quad4, {Physics::plane_strain, 1}, StrainKind::green_lagrange, Formulation::enhanced},
      {n, 1, 1}, [](const Vector3d& x) -> Vector3d {
        return {x[0], 0.01 * x[1], 0};
      });
  Structure structure(grid, PointLaws(law));
  for (int j = 0; j <= 1; ++j)
    for (int a = 0; a < 2; ++a)
      structure.hold(grid.node(0, j), a);
  for (int j = 0; j <= 1; ++j)
    structure.load[2 * grid.node(n, j) + 1] = 0.5;
  const std::array<std::array<double, 3>, 3> tips{
      {{1, 0.30171, 0.05643}, {2, 0.49344, 0.16064}, {5, 0.71378, 0.38762}}};
  double before = 0;
  for (const auto& [load, down, back] : tips) {
    for (int step = 1; step <= steps; ++step)
      ASSERT_GT(structure.solve((before + (load - before) * step / steps) * structure.load), 0) << load;
    before = load;
    const auto mean = [&](int a) {
      return 0.5 * (structure.at(grid.node(n, 0), a) + structure.at(grid.node(n, 1), a));
    };
    EXPECT_NEAR(mean(1), down, 3e-5);
    EXPECT_NEAR(-mean(0), back, 3e-5);
  }
}

} // namespace
} // namespace rubato::element::nonlinear_assembly_test
