// SPDX-License-Identifier: LGPL-3.0-or-later
/// Modeling F without contact against a finite-element program of its own: bilinear quadrangles in plane
/// stress, dense matrices, HHT written for accelerations (T. J. R. Hughes, The Finite Element Method, ch. 9).
/// It shares nothing with rubato but the nodes and cells of the mesh.
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verification/sdnl140.hpp"
#include <array>
#include <cmath>

namespace rubato::verification::independent_beam_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double young = 200e9;
constexpr double density = 7800;

/// Stiffness and mass of plane stress with Poisson's ratio 0 and unit thickness; clamped dofs get a unit
/// diagonal.
struct DenseBeams {
  MatrixXd k, m;
  VectorXd f;
  Index tip = -1;

  explicit DenseBeams(const mesh::Mesh& mesh)
      : k(MatrixXd::Zero(2 * mesh.node_count(), 2 * mesh.node_count())), m(k), f(VectorXd::Zero(k.rows())) {
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
      if (const auto nodes = mesh.nodes_of(cell); nodes.size() == 4)
        add_quadrangle(mesh, nodes);
    for (Index node = 0; node < mesh.node_count(); ++node) {
      const auto& x = mesh.points[static_cast<std::size_t>(node)];
      if (std::abs(x[0]) < 1e-9)
        clamp(node);
      if (std::hypot(x[0] - 1, x[1] - 0.1) < 1e-9)
        tip = 2 * node + 1;
    }
    f[tip] = -1e7;
  }

private:
  void add_quadrangle(const mesh::Mesh& mesh, std::span<const mesh::NodeIndex> nodes) {
    static constexpr std::array<double, 4> xi{-1, 1, 1, -1}, eta{-1, -1, 1, 1};
    const double gauss = 1 / std::sqrt(3.0);
    for (std::size_t point = 0; point < 4; ++point) {
      const double s = xi[point] * gauss, t = eta[point] * gauss;
      Eigen::Matrix<double, 4, 2> slope;
      Eigen::Matrix<double, 4, 2> x;
      Eigen::Matrix<double, 2, 8> n = Eigen::Matrix<double, 2, 8>::Zero();
      for (std::size_t i = 0; i < 4; ++i) {
        const auto row = static_cast<Index>(i);
        slope.row(row) << xi[i] * (1 + eta[i] * t) / 4, eta[i] * (1 + xi[i] * s) / 4;
        x.row(row) = mesh.points[static_cast<std::size_t>(nodes[i])].head<2>().transpose();
        n(0, 2 * row) = n(1, 2 * row + 1) = (1 + xi[i] * s) * (1 + eta[i] * t) / 4;
      }
      const Eigen::Matrix2d jacobian = slope.transpose() * x;
      const Eigen::Matrix<double, 4, 2> d = slope * jacobian.inverse().transpose();
      Eigen::Matrix<double, 3, 8> b = Eigen::Matrix<double, 3, 8>::Zero();
      for (Index i = 0; i < 4; ++i) {
        b(0, 2 * i) = b(2, 2 * i + 1) = d(i, 0);
        b(1, 2 * i + 1) = b(2, 2 * i) = d(i, 1);
      }
      const double area = std::abs(jacobian.determinant());
      const Eigen::Vector3d moduli(young, young, young / 2);
      const Eigen::Matrix<double, 8, 8> ke = area * b.transpose() * moduli.asDiagonal() * b;
      const Eigen::Matrix<double, 8, 8> me = area * density * n.transpose() * n;
      for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j) {
          const Index row = 2 * nodes[i / 2] + static_cast<Index>(i % 2);
          const Index column = 2 * nodes[j / 2] + static_cast<Index>(j % 2);
          k(row, column) += ke(static_cast<Index>(i), static_cast<Index>(j));
          m(row, column) += me(static_cast<Index>(i), static_cast<Index>(j));
        }
    }
  }

  void clamp(Index node) {
    for (const Index dof : {2 * node, 2 * node + 1})
      for (auto* matrix : {&k, &m}) {
        matrix->row(dof).setZero();
        matrix->col(dof).setZero();
        (*matrix)(dof, dof) = 1;
      }
  }
};

/// Deflection of the tip at 0, h, 2h, …; the first step takes the forces of its start as zero.
std::vector<double> hht(const DenseBeams& beams, double alpha, double h, int steps) {
  const double beta = (1 - alpha) * (1 - alpha) / 4, gamma = 0.5 - alpha;
  VectorXd u = VectorXd::Zero(beams.f.size()), v = u, before = u;
  VectorXd a = beams.m.ldlt().solve(beams.f);
  const Eigen::LDLT<MatrixXd> effective(beams.m + (1 + alpha) * beta * h * h * beams.k);
  std::vector<double> tip{0};
  for (int step = 0; step < steps; ++step) {
    const VectorXd predicted = u + h * v + h * h * (0.5 - beta) * a;
    const VectorXd force = (1 + alpha) * (beams.f - beams.k * predicted) + alpha * before;
    v += h * (1 - gamma) * a;
    a = effective.solve(force);
    u = predicted + h * h * beta * a;
    v += h * gamma * a;
    before = beams.k * u - beams.f;
    tip.push_back(u[beams.tip]);
  }
  return tip;
}

TEST(ModelingFWithoutContact, IsAnIndependentProgramsToTwelveDigits) {
  const auto study = sdnl140('f', MeshFrom::generator, without_contact());
  const auto run = finish(study);
  const DenseBeams beams(model::load_mesh(study.mesh));
  const auto expected = hht(beams, -0.3, 1e-3, 12);
  ASSERT_EQ(run.probes.rows.size(), expected.size());
  const auto column = static_cast<std::size_t>(run.probes.column("tip.y"));
  double peak = 0, largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    peak = std::max(peak, std::abs(expected[i]));
    largest = std::max(largest, std::abs(run.probes.rows[i][column] - expected[i]));
  }
  EXPECT_LT(largest, 1e-9 * peak);
  RecordProperty("largest_deviation_over_peak", fmt::format("{:.2e}", largest / peak));
}

} // namespace
} // namespace rubato::verification::independent_beam_test
