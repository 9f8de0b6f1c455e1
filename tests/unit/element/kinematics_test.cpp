// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/kinematics.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "point_test_laws.hpp"
#include <cmath>

namespace rubato::element::kinematics_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const test::PlasticLaw law{{210., 0.3}, 0.05, 5.};

struct Answer {
  Matrix3d piola;
  Moduli moduli;
};

Answer answer_of(StrainKind kind, const Matrix3d& h) {
  Deformation deformation{h, {}};
  material::Response response;
  std::array<double, 7> old{}, now{};
  respond(law, strain_of(kind, deformation), old, now, {1}, material::Want::tangent, response);
  Answer answer{first_piola(kind, deformation, response.stress), {}};
  first_moduli(kind, deformation, response, answer.moduli);
  return answer;
}

double error_of_moduli(StrainKind kind, const Matrix3d& h) {
  constexpr double step = 1e-4;
  const Moduli a = answer_of(kind, h).moduli;
  double error = 0;
  for (int j = 0; j < 9; ++j) {
    const auto at = [&](double part) {
      Matrix3d moved = h;
      moved(j % 3, j / 3) += part;
      return as_vector(answer_of(kind, moved).piola);
    };
    const Vector9 near = at(step) - at(-step), far = at(2 * step) - at(-2 * step);
    error = std::max(error, ((8 * near - far) / (12 * step) - a.col(j)).cwiseAbs().maxCoeff());
  }
  return error / a.cwiseAbs().maxCoeff();
}

/// H = R U − 1 of stretches in turned axes.
Matrix3d motion(const Vector3d& stretches) {
  const Matrix3d axes = Eigen::Quaterniond(0.9, 0.3, -0.2, 0.1).normalized().toRotationMatrix();
  const Matrix3d turn = Eigen::Quaterniond(0.5, -0.4, 0.3, 0.7).normalized().toRotationMatrix();
  return turn * axes * stretches.asDiagonal() * axes.transpose() - Matrix3d::Identity();
}

TEST(Kinematics, HasTheDerivativeOfPWhateverTheStretches) {
  for (const Vector3d& stretches :
       {Vector3d(1.05, 0.93, 1.2), Vector3d(1.05, 1.05, 0.9), Vector3d(1.1, 1.1 + 1e-9, 0.95),
        Vector3d(1.05, 1.0501, 1.02), Vector3d(1.3, 1.3, 1.3 + 1e-5), Vector3d(0.5, 1.7, 1.1)})
    for (const auto kind : {StrainKind::small, StrainKind::green_lagrange, StrainKind::logarithmic})
      EXPECT_LT(error_of_moduli(kind, motion(stretches)), 1e-8) << stretches.transpose();
}

/// P of F → R F is R P, also after steps in which the point yields.
TEST(Kinematics, TurnsTheStressesOfABodyThatYields) {
  const Matrix3d turn = Eigen::Quaterniond(0.2, 0.8, -0.4, 0.3).normalized().toRotationMatrix();
  for (const auto kind : {StrainKind::green_lagrange, StrainKind::logarithmic}) {
    std::array<double, 7> state{};
    for (const double size : {0.02, 0.05}) {
      const Matrix3d h = motion(Vector3d(1 + size, 1 - size / 2, 1 + size / 4));
      const Matrix3d turned = turn * gradient_of(h) - Matrix3d::Identity();
      std::array<double, 7> now{}, of_turned{};
      Deformation plain{h, {}}, rotated{turned, {}};
      material::Response response, response_of_turned;
      respond(law, strain_of(kind, plain), state, now, {1}, material::Want::stress, response);
      respond(law, strain_of(kind, rotated), state, of_turned, {1}, material::Want::stress,
              response_of_turned);
      const Matrix3d piola = first_piola(kind, plain, response.stress);
      EXPECT_GT(now[6], state[6]);
      EXPECT_NEAR(of_turned[6], now[6], 1e-15);
      EXPECT_LT((first_piola(kind, rotated, response_of_turned.stress) - turn * piola).norm(),
                1e-12 * piola.norm());
      state = now;
    }
  }
}

TEST(Kinematics, KeepsTheDigitsOfSmallStrains) {
  const Vector3d small(1e-9, -2e-9, 3e-9);
  for (const auto kind : {StrainKind::small, StrainKind::green_lagrange, StrainKind::logarithmic}) {
    Deformation deformation{small.asDiagonal(), {}};
    const auto strain = strain_of(kind, deformation);
    EXPECT_LT((strain.head<3>() - small).norm(), 1e-17);
  }
  EXPECT_NEAR(volume_change(small.asDiagonal()), 2e-9, 1e-17);
}

TEST(Logarithm, HasTheStrainsOfTheStretches) {
  Deformation deformation{Vector3d(0.5, -0.5, 2).asDiagonal(), {}};
  const auto strain = strain_of(StrainKind::logarithmic, deformation);
  EXPECT_NEAR(strain[0], std::log(1.5), 1e-15);
  EXPECT_NEAR(strain[1], std::log(0.5), 1e-15);
  EXPECT_NEAR(strain[2], std::log(3.), 1e-15);
}

/// ½ ln in long double; distances so large that differences of differences keep 12 digits.
long double plain_difference(long double a, long double b) {
  return (log1pl(a) - log1pl(b)) / (a - b) / 2;
}

TEST(Logarithm, HasDividedDifferencesOnBothSidesOfTheSeries) {
  for (const double distance : {0.02, 0.049, 0.051, 0.3})
    for (const double a : {-0.4, 0., 1.5}) {
      const double b = a + 0.4 * distance * (1 + a), c = a + distance * (1 + a);
      const long double first = plain_difference(a, b);
      EXPECT_NEAR(first_difference(a, b), static_cast<double>(first), 1e-14 * static_cast<double>(first));
      const auto second =
          static_cast<double>((first - plain_difference(b, c)) / (static_cast<long double>(a) - c));
      EXPECT_NEAR(second_difference(a, b, c), second, 3e-13 * std::abs(second));
      EXPECT_NEAR(second_difference(c, a, b), second, 3e-13 * std::abs(second));
    }
}

TEST(Logarithm, HasDerivativesWhereNumbersAreEqual) {
  EXPECT_NEAR(first_difference(0.6, 0.6), 0.5 / 1.6, 1e-16);
  EXPECT_NEAR(second_difference(0.6, 0.6, 0.6), -0.25 / (1.6 * 1.6), 1e-16);
}

} // namespace
} // namespace rubato::element::kinematics_test
