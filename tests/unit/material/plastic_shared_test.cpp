// SPDX-License-Identifier: LGPL-3.0-or-later
/// Code_Aster's material points (SIMU_POINT_MAT), which stand beside the project on some machines only.
#include "rubato/material/plastic.hpp"
#include "rubato/material/voigt.hpp"

#include <gtest/gtest.h>

#include "support/csv_file.hpp"
#include "support/point_path.hpp"
#include "support/shared_files.hpp"
#include <string>

namespace rubato::material::plastic_shared_test {
namespace {

using test::PointPath;

using Numbers = std::vector<double>;

// In the columns of the files: the instant, four strains (tensor), four stresses, von Mises, and what
// history() says.
constexpr std::array<Eigen::Index, 4> components{0, 1, 2, 3};
constexpr std::size_t first_strain = 1, first_stress = 5, place_of_mises = 9, place_of_history = 10;

/// What the last column of the files has: p, or X_xx where C of a back stress is given.
double history(const PointPath& path, double modulus) {
  return modulus > 0 ? 2.0 / 3 * modulus * plastic_strain(path.law(), path.state())[0] : path.p();
}

/// Largest differences of stresses and of the history, each by its largest value.
struct Differences {
  double stress = 0;
  double history = 0;
};

Differences differences(const Plastic& law, const std::vector<Numbers>& rows, double modulus) {
  PointPath path(law);
  Differences off;
  Differences largest;
  for (const auto& row : rows) {
    Strain6 strain = Strain6::Zero();
    for (const auto i : components)
      strain[i] = (i == 3 ? 2 : 1) * row[first_strain + static_cast<std::size_t>(i)];
    EXPECT_TRUE(path.to_strain(strain, 0.1));
    const auto& stress = path.response().stress;
    for (const auto i : components) {
      const double expected = row[first_stress + static_cast<std::size_t>(i)];
      off.stress = std::max(off.stress, std::abs(stress[i] - expected));
      largest.stress = std::max(largest.stress, std::abs(expected));
    }
    off.stress = std::max(off.stress, std::abs(von_mises(stress) - row[place_of_mises]));
    off.history = std::max(off.history, std::abs(history(path, modulus) - row[place_of_history]));
    largest.history = std::max(largest.history, std::abs(row[place_of_history]));
  }
  return {off.stress / largest.stress, off.history / largest.history};
}

struct Point {
  std::string name;
  Plastic law;
  double back_modulus = 0; ///< where the history is X_xx
};

constexpr double young = 200e9, tangent_modulus = 2e9, yield_stress = 400e6;

Plastic of_numbers(Hardening hardening, BackStresses back = {}) {
  return {young, 0.3, std::move(hardening), back};
}

std::vector<Point> points() {
  const double modulus = hardening_modulus(young, tangent_modulus);
  const double prager = 1.5 * 1e9;
  const std::array<TableHardening::Point, 4> curve{
      {{0.002, 400e6}, {0.004, 430e6}, {0.008, 460e6}, {0.03, 500e6}}};
  return {
      {"isot_line", of_numbers(LinearHardening{yield_stress, modulus})},
      {"isot_trac", of_numbers(hardening_of_tension(young, curve))},
      {"cine_line", of_numbers(LinearHardening{yield_stress, 0}, {{BackStress{modulus, 0}}, 1}), modulus},
      {"ecmi_line",
       of_numbers(LinearHardening{yield_stress, modulus - prager}, {{BackStress{prager, 0}}, 1})},
      {"cin1_chab", of_numbers(VoceHardening{300e6, 100e6, 20, 0}, {{BackStress{40e9, 200}}, 1})},
  };
}

class PlasticPoints : public testing::TestWithParam<Point> {};

TEST_P(PlasticPoints, FollowCodeAster) {
  const auto rows = test::csv_rows(test::shared_file("oracle/point_" + GetParam().name + ".csv"));
  if (rows.empty())
    GTEST_SKIP() << "no shared files";
  const auto off = differences(GetParam().law, rows, GetParam().back_modulus);
  EXPECT_LT(off.stress, 2e-12);
  EXPECT_LT(off.history, 2e-12);
}

INSTANTIATE_TEST_SUITE_P(Each, PlasticPoints, testing::ValuesIn(points()),
                         [](const auto& given) { return given.param.name; });

} // namespace
} // namespace rubato::material::plastic_shared_test
