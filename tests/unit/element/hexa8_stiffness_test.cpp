// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"
#include "rubato/element/element.hpp"
#include "rubato/element/hexa8_stiffness.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rubato::element::hexa8_stiffness_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Section space{study::Physics::solid, 1};

struct RandomHexa8 {
  std::vector<Vector3d> points;
  material::Law law;
};

/// Distorted, up to a hundred times as long as thick, turned and moved.
class RandomHexa8s {
public:
  RandomHexa8 next() {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(any(), any(), any(), any()).normalized().toRotationMatrix();
    const Vector3d size(1, std::pow(10, any() - 1), std::pow(10, any() - 1));
    const Vector3d move(any(), any(), any());
    RandomHexa8 cell{{}, material::LinearElastic{200, poisson(), 1}};
    for (const auto& corner : cell::reference_cell(CellType::hexa8).nodes) {
      const Vector3d shaken = corner + 0.3 * Vector3d(any(), any(), any());
      cell.points.push_back(move + turn * size.cwiseProduct(shaken));
    }
    return cell;
  }

private:
  double any() { return between_(random_); }
  double poisson() {
    constexpr std::array values{0., 0.3, 0.45, 0.499};
    return values[count_++ % values.size()];
  }

  std::mt19937 random_{11};
  std::uniform_real_distribution<double> between_{-1, 1};
  std::size_t count_ = 0;
};

MatrixXd stiffness_of(const RandomHexa8& cell) {
  MatrixXd k(24, 24);
  stiffness(CellType::hexa8, cell.points, cell.law, space, k);
  return k;
}

/// By the kernel for any D.
MatrixXd general_stiffness(const RandomHexa8& cell) {
  MatrixXd k(24, 24);
  stiffness(CellType::hexa8, cell.points, material::tangent(cell.law, space.physics), space, k);
  return k;
}

material::Lame lame_of(const RandomHexa8& cell) {
  return *material::isotropic(cell.law, space.physics);
}

double largest(const MatrixXd& k) {
  return k.cwiseAbs().maxCoeff();
}

/// The last node beyond the face across.
RandomHexa8 inverted(RandomHexa8 cell) {
  cell.points[6] = 4 * cell.points[0] - 3 * cell.points[6];
  return cell;
}

TEST(Hexa8Stiffness, IsThatOfTheKernelForAnyLaw) {
  RandomHexa8s cells;
  for (int n = 0; n < 400; ++n) {
    const auto cell = cells.next();
    const MatrixXd expected = general_stiffness(cell);
    EXPECT_LT(largest(stiffness_of(cell) - expected), 1e-13 * largest(expected)) << n;
  }
}

TEST(Hexa8Stiffness, IsSymmetricToTheLastDigit) {
  RandomHexa8s cells;
  for (int n = 0; n < 100; ++n) {
    const auto k = stiffness_of(cells.next());
    EXPECT_EQ(k, k.transpose());
  }
}

TEST(Hexa8Stiffness, DoesNotResistRigidMotions) {
  RandomHexa8s cells;
  for (int n = 0; n < 100; ++n) {
    const auto cell = cells.next();
    const auto k = stiffness_of(cell);
    for (int motion = 0; motion < 6; ++motion) {
      VectorXd u(24);
      for (int i = 0; i < 8; ++i)
        u.segment<3>(3 * i) =
            motion < 3
                ? Vector3d::Unit(motion)
                : Vector3d::Unit(motion - 3).cross(cell.points[static_cast<std::size_t>(i)] - cell.points[0]);
      EXPECT_LT((k * u).norm(), 1e-13 * k.norm() * u.norm()) << n;
    }
  }
}

TEST(Hexa8Stiffness, OfTwoCellsIsThatOfEach) {
  RandomHexa8s cells;
  for (int n = 0; n < 20; ++n) {
    const auto first = cells.next(), second = cells.next();
    MatrixXd k, other;
    set_hexa8_stiffness({Hexa8Stiffness{first.points, lame_of(first), k},
                         Hexa8Stiffness{second.points, lame_of(second), other}});
    EXPECT_EQ(k, stiffness_of(first));
    EXPECT_EQ(other, stiffness_of(second));
  }
}

TEST(Hexa8Stiffness, OfAnInvertedCellHasNegativeVolumes) {
  RandomHexa8s cells;
  for (int n = 0; n < 20; ++n) {
    const auto cell = inverted(cells.next());
    ASSERT_LT(worst_jacobian(CellType::hexa8, cell.points), 0);
    VectorXd volume(8);
    point_volumes(CellType::hexa8, cell.points, space, volume);
    VectorXd u = VectorXd::Random(24);
    MatrixXd strain(6, 8);
    strains(CellType::hexa8, cell.points, space.physics, {u.data(), 24}, strain);
    double energy = 0, size = 0;
    for (Eigen::Index q = 0; q < 8; ++q) {
      const double of_point = volume[q] * material::energy(cell.law, space.physics, strain.col(q));
      energy += of_point;
      size += std::abs(of_point);
    }
    EXPECT_NEAR(0.5 * u.dot(stiffness_of(cell) * u), energy, 1e-11 * size);
  }
}

TEST(Hexa8Stiffness, OfAFlatCellIsNotFinite) {
  RandomHexa8s cells;
  auto cell = cells.next();
  for (auto& point : cell.points)
    point[2] = 0;
  EXPECT_FALSE(stiffness_of(cell).allFinite());
}

} // namespace
} // namespace rubato::element::hexa8_stiffness_test
