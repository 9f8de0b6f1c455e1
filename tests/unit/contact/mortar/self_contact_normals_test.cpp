// SPDX-License-Identifier: LGPL-3.0-or-later
// Normals that belong to both of two faces of a surface that meets itself.
#include "rubato/contact/mortar/self_contact_normals.hpp"

#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <cmath>
#include <numbers>
#include <vector>

namespace rubato::self_contact_normals_test {
namespace {

using namespace contact::mortar;
using test::GridOptions;
using test::Map;
using test::Vector3d;

/// Two sheets as one surface: the first `lower` faces look up, the others down on them.
struct Sheets {
  mesh::Mesh mesh;
  contact::Surface surface;
  int lower = 0;

  Sheets(const GridOptions& below, const Map& low, GridOptions above, const Map& high) {
    above.downwards = true;
    auto faces = test::add_grid(mesh, below, low);
    lower = static_cast<int>(faces.size());
    for (const auto& face : test::add_grid(mesh, above, high))
      faces.push_back(face);
    surface = contact::make_surface(mesh, faces);
  }
  bool is_lower(int face) const { return face < lower; }
  bool is_lower_node(std::size_t position) const { return is_lower(surface.faces_of_node[position].front()); }

  std::vector<Vector3d> own_normals() const {
    std::vector<Vector3d> normals;
    nodal_normals(surface, mesh.points, {}, normals);
    return normals;
  }
  std::vector<Vector3d> normals(double reach, bool may_meet = true) const {
    Options options;
    options.reach = reach;
    options.may_pair = [this, may_meet](int one, int other) {
      return may_meet && is_lower(one) != is_lower(other);
    };
    Workspace workspace;
    std::vector<Vector3d> found;
    mean_normals(surface, make_slave_reference(surface, mesh.points, {}), mesh.points, options, workspace,
                 found);
    return found;
  }
};

int up_of(CellType type) {
  return cell::topology(type).dimension;
}

/// A bent sheet below the plane of height 0, or its mirror image; in the plane t is none.
Map bent(CellType type, double side) {
  return [=](double s, double t) {
    Vector3d x(s, t, 0);
    if (up_of(type) == 1)
      x[1] = 0;
    x[up_of(type)] = side * (0.02 + 0.25 * s + 0.1 * s * s + (up_of(type) == 2 ? 0.07 * t : 0));
    return x;
  };
}

class MeanNormals : public testing::TestWithParam<CellType> {};

/// Whatever the gap and the slope.
TEST_P(MeanNormals, OfSheetsThatAreMirroredAreTheMirrors) {
  const auto type = GetParam();
  const GridOptions grid{.type = type, .along = 3, .across = 2};
  const Sheets sheets(grid, bent(type, -1), grid, bent(type, 1));
  const auto own = sheets.own_normals(), mean = sheets.normals(2);
  double most = 0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const Vector3d expected = (sheets.is_lower_node(k) ? 1 : -1) * Vector3d::Unit(up_of(type));
    EXPECT_LE((mean[k] - expected).norm(), 1e-12) << k;
    most = std::max(most, (own[k] - expected).norm());
  }
  EXPECT_GT(most, 0.2) << "their own normals lean";
}

/// Of flat sheets the normals are the same everywhere, on both sides half of the angle between them.
TEST_P(MeanNormals, OfFlatSheetsHalveTheAngleBetweenThem) {
  const auto type = GetParam();
  constexpr double angle = 0.5;
  const auto plain = [=](double s, double t) { return Vector3d(s, up_of(type) == 1 ? 0 : t, 0); };
  const auto leaning = [=](double s, double t) {
    Vector3d x = plain(s * std::cos(angle), t);
    x[up_of(type)] = 0.05 + s * std::sin(angle);
    return x;
  };
  const Sheets sheets({.type = type, .along = 3, .across = 2}, plain, {.type = type, .along = 2, .across = 3},
                      leaning);
  const auto mean = sheets.normals(3);
  Vector3d expected = -std::sin(angle / 2) * Vector3d::UnitX();
  expected[up_of(type)] = std::cos(angle / 2);
  for (std::size_t k = 0; k < mean.size(); ++k)
    EXPECT_LE((mean[k] - (sheets.is_lower_node(k) ? 1 : -1) * expected).norm(), 1e-12) << k;
}

TEST_P(MeanNormals, AreANodesOwnWhereItMeetsNothing) {
  const auto type = GetParam();
  const GridOptions grid{.type = type, .along = 3, .across = 2};
  const Sheets sheets(grid, bent(type, -1), grid, bent(type, 1));
  EXPECT_EQ(sheets.normals(2, false), sheets.own_normals()) << "no faces are said to meet";
  EXPECT_EQ(sheets.normals(0.01), sheets.own_normals()) << "all are farther away";
}

/// The sheets are 0.04 to 0.74 apart, or 0.88 at the far corner in space.
TEST_P(MeanNormals, ReachAsFarAsTheyAreTold) {
  const auto type = GetParam();
  const GridOptions grid{.type = type, .along = 6, .across = 2};
  const Sheets sheets(grid, bent(type, -1), grid, bent(type, 1));
  const auto own = sheets.own_normals(), mean = sheets.normals(0.3);
  int changed = 0, kept = 0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const auto& x = sheets.mesh.points[k];
    const double apart = 2 * std::abs(x[up_of(type)]);
    if (apart < 0.25) {
      EXPECT_GT((mean[k] - own[k]).norm(), 0.05) << k;
      ++changed;
    } else if (apart > 0.7) {
      EXPECT_EQ(mean[k], own[k]) << k;
      ++kept;
    }
  }
  EXPECT_GT(changed, 0);
  EXPECT_GT(kept, 0);
}

INSTANTIATE_TEST_SUITE_P(Faces, MeanNormals,
                         testing::Values(CellType::seg2, CellType::seg3, CellType::tria3, CellType::quad4,
                                         CellType::quad8, CellType::quad9),
                         [](const auto& type) { return test::name_of(type.param); });

/// p ∝ m_k − m(y) with y on the line along p: a flat sheet before the inside of a round one.
TEST(TheMeanNormalOfANode, FitsTheNormalOfThePlaceItPointsAt) {
  constexpr double radius = 2;
  const auto flat = [](double s, double) { return Vector3d(0.4 * s - 0.1, 0, 0); };
  const auto round = [](double s, double) {
    const double angle = 0.7 * (s - 0.5);
    return Vector3d(radius * std::sin(angle), 0.1 + radius - radius * std::cos(angle), 0);
  };
  const Sheets sheets({.type = CellType::seg2, .along = 5}, flat, {.type = CellType::seg2, .along = 80},
                      round);
  const auto mean = sheets.normals(1);
  for (std::size_t k = 0; k < mean.size(); ++k) {
    if (!sheets.is_lower_node(k))
      continue;
    const auto& x = sheets.mesh.points[k];
    // Where the line along p meets the circle, and the normal there, out of the body around it.
    const Vector3d centre(0, 0.1 + radius, 0), from = x - centre;
    const double along = from.dot(mean[k]);
    const double way = -along - std::sqrt(along * along - from.squaredNorm() + radius * radius);
    const Vector3d normal = (x + way * mean[k] - centre).normalized();
    EXPECT_LE((mean[k] - (Vector3d::UnitY() - normal).normalized()).norm(), 1e-4) << k;
    EXPECT_GT((mean[k] - Vector3d::UnitY()).norm(), std::abs(x.x()) > 0.05 ? 5e-3 : 0.0) << k;
  }
}

} // namespace
} // namespace rubato::self_contact_normals_test
