// SPDX-License-Identifier: LGPL-3.0-or-later
/// Manufactured solutions: a smooth displacement is chosen, the load that makes it so is applied, and the
/// error must fall with the mesh size h as h^(p+1) in displacement (L2 norm) and h^p in strain energy norm, p
/// the cell's order.
///
/// The load enters in its weak form, ∫ ε(N)·σ(u) for test functions that vanish on the boundary, where u is
/// imposed: the same numbers as ∫ N·b with b = −div σ(u), without second derivatives.
#include "rubato/cell/quadrature.hpp"
#include "rubato/domain/assembly.hpp"

#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/dense.hpp"
#include "support/dirichlet.hpp"
#include "support/patch_mesh.hpp"
#include <cmath>

namespace rubato::convergence_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;

const material::LinearElastic law{2.5, 0.3, 1.};

/// u_a = sin(k_a·x + φ_a), slowly varying in every direction.
struct ExactField {
  Matrix3d wave = (Matrix3d() << 1.7, 0.9, 0.6, -0.8, 1.5, 1.1, 0.7, -1.2, 1.4).finished();
  Vector3d phase{0.3, 0.8, -0.2};

  Vector3d value(const Vector3d& x) const { return (wave * x + phase).array().sin(); }
  Matrix3d gradient(const Vector3d& x) const {
    const Vector3d slope = (wave * x + phase).array().cos();
    return slope.asDiagonal() * wave;
  }
};

/// A quadrature point in space, with the strain operator of its cell written out.
struct SpacePoint {
  Vector3d x;
  double volume;
  VectorXd n;
  MatrixXd b; ///< strain_size × nodes·d
};

class EveryCellOrder : public testing::TestWithParam<test::BulkCase> {
protected:
  struct Errors {
    double displacement;
    double energy;
  };

  Physics physics_ = GetParam().physics;
  int d_ = element::component_count(physics_);
  element::Section section_{physics_, 1.};
  ExactField exact_;

  material::Voigt strain(const Matrix3d& h, double hoop) const {
    material::Voigt result(material::strain_size(physics_));
    if (d_ == 3)
      result << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0);
    else if (physics_ == Physics::axisymmetric)
      result << h(0, 0), h(1, 1), hoop, h(0, 1) + h(1, 0);
    else
      result << h(0, 0), h(1, 1), h(0, 1) + h(1, 0);
    return result;
  }

  material::Voigt exact_strain(const Vector3d& x) const {
    return strain(exact_.gradient(x), exact_.value(x)[0] / x[0]);
  }

  std::vector<SpacePoint> space_points(const mesh::Mesh& mesh, mesh::CellIndex cell) const {
    const auto nodes = mesh.nodes_of(cell);
    const auto& reference = cell::reference_cell(mesh.type_of(cell));
    const auto count = static_cast<Index>(nodes.size());
    std::vector<SpacePoint> points;
    for (const auto& [xi, weight] : cell::rule_of_degree(reference.type, 6)) {
      VectorXd n(count);
      MatrixXd dn(d_, count);
      reference.values(xi, {n.data(), nodes.size()});
      reference.gradients(xi, {dn.data(), static_cast<std::size_t>(dn.size())});
      MatrixXd x(3, count);
      for (Index i = 0; i < count; ++i)
        x.col(i) = mesh.points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])];
      const MatrixXd jacobian = x.topRows(d_) * dn.transpose();
      const MatrixXd n_xi = test::inverse(jacobian).transpose() * dn;
      SpacePoint point{x * n, 0., n, MatrixXd(material::strain_size(physics_), d_ * count)};
      point.volume = weight * test::determinant(jacobian) * element::measure(section_, point.x[0]);
      for (Index i = 0; i < count; ++i)
        for (int a = 0; a < d_; ++a) {
          Matrix3d h = Matrix3d::Zero();
          h.row(a).head(d_) = n_xi.col(i);
          point.b.col(d_ * i + a) = strain(h, a == 0 ? n[i] / point.x[0] : 0.);
        }
      points.push_back(std::move(point));
    }
    return points;
  }

  VectorXd local(const domain::DofMap& dofs, std::span<const mesh::NodeIndex> nodes,
                 const VectorXd& u) const {
    VectorXd result(d_ * static_cast<Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      result.segment(d_ * static_cast<Index>(i), d_) = u.segment(dofs.dof(nodes[i], 0), d_);
    return result;
  }

  VectorXd load(const mesh::Mesh& mesh, const domain::Bulk& bulk, const domain::DofMap& dofs) const {
    VectorXd f = VectorXd::Zero(dofs.dof_count);
    for (const auto cell : bulk.cells) {
      const auto nodes = mesh.nodes_of(cell);
      for (const auto& point : space_points(mesh, cell)) {
        const VectorXd element =
            point.volume * point.b.transpose() * material::stress(law, physics_, exact_strain(point.x));
        for (std::size_t i = 0; i < nodes.size(); ++i)
          f.segment(dofs.dof(nodes[i], 0), d_) += element.segment(d_ * static_cast<Index>(i), d_);
      }
    }
    return f;
  }

  Errors errors(const mesh::Mesh& mesh, const domain::Bulk& bulk, const domain::DofMap& dofs,
                const VectorXd& u) const {
    Errors sum{0, 0};
    for (const auto cell : bulk.cells) {
      const VectorXd of_cell = local(dofs, mesh.nodes_of(cell), u);
      const Eigen::Map<const MatrixXd> by_node(of_cell.data(), d_, of_cell.size() / d_);
      for (const auto& point : space_points(mesh, cell)) {
        const VectorXd difference = by_node * point.n - exact_.value(point.x).head(d_);
        const VectorXd strain_difference = point.b * of_cell - exact_strain(point.x);
        sum.displacement += point.volume * difference.squaredNorm();
        sum.energy += 2 * point.volume * material::energy(law, physics_, strain_difference);
      }
    }
    return {std::sqrt(sum.displacement), std::sqrt(sum.energy)};
  }

  Errors solve(int n) const {
    const auto bend = [this](const Eigen::Vector3d& x) -> Eigen::Vector3d {
      const double z = d_ == 3 ? x[2] : 0.;
      return {0.5 + x[0] + 0.08 * std::sin(2 * x[1]) + 0.05 * z, x[1] + 0.06 * x[0] * x[0],
              d_ == 3 ? z + 0.07 * x[0] * x[1] : 0.};
    };
    const auto mesh = test::patch_mesh(GetParam().type, n, bend);
    const auto bulk = test::whole_bulk(mesh, section_, law);
    const auto dofs = domain::number_dofs(mesh, bulk.cells, d_);
    const auto outer = test::boundary_nodes(mesh);
    std::vector<bool> given(static_cast<std::size_t>(dofs.dof_count));
    VectorXd u(dofs.dof_count);
    for (const auto node : dofs.nodes)
      for (int a = 0; a < d_; ++a) {
        const auto i = static_cast<std::size_t>(node);
        u[dofs.dof(node, a)] = exact_.value(mesh.points[i])[a];
        given[static_cast<std::size_t>(dofs.dof(node, a))] = outer[i];
      }
    const auto k = domain::assemble_stiffness(mesh, bulk, domain::BlockPattern(mesh, bulk.cells, dofs));
    test::solve_with_given(k, load(mesh, bulk, dofs), given, u);
    return errors(mesh, bulk, dofs, u);
  }
};

TEST_P(EveryCellOrder, ConvergesAtTheOrderOfItsPolynomials) {
  const auto& cell = cell::topology(GetParam().type);
  const int coarse = cell.dimension == 2 ? 8 : cell.order == 1 ? 4 : 2;
  const auto before = solve(coarse);
  const auto after = solve(2 * coarse);
  // Rates measured on meshes this coarse stay within a tenth of the asymptotic order.
  EXPECT_GT(std::log2(before.displacement / after.displacement), cell.order + 1 - 0.1);
  EXPECT_GT(std::log2(before.energy / after.energy), cell.order - 0.1);
  RecordProperty("displacement_rate", std::to_string(std::log2(before.displacement / after.displacement)));
  RecordProperty("energy_rate", std::to_string(std::log2(before.energy / after.energy)));
}

INSTANTIATE_TEST_SUITE_P(Manufactured, EveryCellOrder, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

} // namespace
} // namespace rubato::convergence_test
