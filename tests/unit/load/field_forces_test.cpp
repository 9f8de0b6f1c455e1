// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/field_forces.hpp"
#include "rubato/load/nodal_forces.hpp"

#include <gtest/gtest.h>

#include "distorted_body.hpp"
#include <functional>
#include <string>

namespace rubato::load::field_forces_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;

class EveryBodyUnderAField : public DistortedBody {
protected:
  std::vector<Face> faces() const {
    std::vector<Face> faces;
    for (const auto& side : sides_)
      faces.push_back({side.type, side.nodes});
    return faces;
  }
  VectorXd none() const { return VectorXd::Zero(dofs_.dof_count); }
  VectorXd forces(const std::string& text, double t,
                  const std::function<void(const VisitPlace&)>& visit_places) const {
    FieldForce load{{.expression = Expression(text), .function = {}}, {}};
    visit_places([&](const LoadedPlace& at) { load.places.push_back(at); });
    VectorXd force = none();
    add_field_force(load, t, force);
    return force;
  }
};

TEST_P(EveryBodyUnderAField, HasTheForcesOfTheNumberWhereTheFieldIsUniform) {
  VectorXd pressed = none(), pulled = none(), heavy = none();
  add_pressure(mesh_, dofs_, section_, faces(), 3, pressed);
  add_surface_force(mesh_, dofs_, section_, faces(), 3 * Vector3d::UnitY(), pulled);
  add_gravity(mesh_, dofs_, bulk_, 3 * Vector3d::UnitX(), heavy);
  const auto pressure =
      forces("1+t", 2, [&](const auto& visit) { visit_pressure(mesh_, dofs_, section_, faces(), visit); });
  const auto pull = forces(
      "1+t", 2, [&](const auto& visit) { visit_surface_force(mesh_, dofs_, section_, faces(), 1, visit); });
  const auto weight =
      forces("1+t", 2, [&](const auto& visit) { visit_gravity(mesh_, dofs_, bulk_, 0, visit); });
  EXPECT_LE((pressure - pressed).norm(), 1e-14 * pressed.norm());
  EXPECT_LE((pull - pulled).norm(), 1e-14 * pulled.norm());
  EXPECT_LE((weight - heavy).norm(), 1e-14 * heavy.norm());
}

/// ∫ x dV over the unit body from x = 1 to 2 is 3/2 of its volume, and the cells interpolate x exactly.
TEST_P(EveryBodyUnderAField, HasTheIntegralOfABodyForceThatIsLinear) {
  if (physics_ == Physics::axisymmetric)
    return;
  const auto weight =
      forces("x*t", 2, [&](const auto& visit) { visit_gravity(mesh_, dofs_, bulk_, 1, visit); });
  const double volume = d_ == 3 ? 1 : thickness;
  EXPECT_NEAR(weight.sum(), law.density * 2 * 1.5 * volume, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Cells, EveryBodyUnderAField, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

} // namespace
} // namespace rubato::load::field_forces_test
