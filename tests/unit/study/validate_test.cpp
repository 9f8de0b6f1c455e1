// SPDX-License-Identifier: LGPL-3.0-or-later
// Studies that a program builds meet the rules that a deck meets.
#include "rubato/core/error.hpp"
#include "rubato/study/validate.hpp"

#include <gtest/gtest.h>

#include "sound_study.hpp"
#include <functional>
#include <limits>
#include <numeric>
#include <ostream>
#include <string>

namespace rubato::study::validate_test {
namespace {

TEST(SoundStudy, KeepsEveryRuleWithAnOrthotropicMaterial) {
  auto study = sound_study();
  make_timber(study.materials[0]);
  EXPECT_TRUE(broken_rules(study).empty());
  study.physics = Physics::plane_stress;
  for (auto* number : {&study.materials[0].orthotropy.young_z, &study.materials[0].orthotropy.poisson_yz,
                       &study.materials[0].orthotropy.poisson_xz, &study.materials[0].orthotropy.shear_yz})
    number->reset();
  EXPECT_TRUE(broken_rules(study).empty());
}

TEST(SoundStudy, KeepsEveryRuleWithNonlinearMaterials) {
  auto study = sound_study();
  make_plastic(study.materials[0]).kinematic = {{1e9, 10}};
  study.time.max_step = 0.5;
  study.time.max_plastic_step = 0.01;
  EXPECT_TRUE(broken_rules(study).empty());
  study.time.max_plastic_step.reset();
  make_rubber(study.materials[0]);
  EXPECT_TRUE(broken_rules(study).empty());
}

TEST(SoundStudy, KeepsEveryRule) {
  const auto broken = broken_rules(sound_study());
  EXPECT_TRUE(broken.empty()) << broken.front().paths.front() << ": " << broken.front().text;
  EXPECT_NO_THROW(validate(sound_study()));
}

struct Bad {
  std::string path; ///< where the rule is told
  std::string text; ///< part of the sentence
  std::function<void(Study&)> make;
};

std::ostream& operator<<(std::ostream& out, const Bad& bad) {
  return out << bad.path;
}

class BadStudy : public testing::TestWithParam<Bad> {};

TEST_P(BadStudy, IsToldAtItsPath) {
  auto study = sound_study();
  GetParam().make(study);
  const auto broken = broken_rules(study);
  ASSERT_FALSE(broken.empty());
  EXPECT_EQ(broken.front().paths.front(), GetParam().path);
  EXPECT_NE(broken.front().text.find(GetParam().text), std::string::npos) << broken.front().text;
  try {
    validate(study);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().front().path, GetParam().path);
    EXPECT_TRUE(std::string(error.what()).starts_with(GetParam().path + ": ")) << error.what();
  }
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void explicitly(Study& study) {
  study.time.scheme = SchemeKind::central_difference;
  study.time.contact_mass = ContactMass::consistent;
  study.time.step = 0;
  study.time.record = 0.1;
}

INSTANTIATE_TEST_SUITE_P(
    Of, BadStudy,
    testing::Values(
        Bad{"thickness", "> 0", [](Study& s) { s.thickness = 0; }},
        Bad{"mesh", "is missing", [](Study& s) { s.mesh.bodies.clear(); }},
        Bad{"mesh", "both 'file' and 'generate'", [](Study& s) { s.mesh.file = "a.med"; }},
        Bad{"mesh.generate.1.rectangle.to.1", "expected more than the 1 of 'from'",
            [](Study& s) { s.mesh.bodies[1].to[1] = 1; }},
        Bad{"mesh.generate.0.rectangle", "found a rectangle in solid",
            [](Study& s) {
              s.physics = Physics::solid;
              s.mesh.bodies.pop_back();
            }},
        Bad{"mesh.generate.1", "second body named 'lower'",
            [](Study& s) { s.mesh.bodies[1].name = "lower"; }},
        Bad{"mesh.refine", "from 1 to 1000", [](Study& s) { s.mesh.refine = 0; }},
        Bad{"mesh.generate", "cells (divisions and refine)",
            [](Study& s) {
              s.mesh.bodies[0].divisions = {100000, 1000, 1};
              s.mesh.refine = 2;
            }},
        Bad{"materials", "no material", [](Study& s) { s.materials.clear(); }},
        Bad{"materials.steel.young", "found '-1', expected a number > 0",
            [](Study& s) { s.materials[0].young = -1; }},
        Bad{"materials.steel.young", "expected a number > 0", [](Study& s) { s.materials[0].young = nan; }},
        Bad{"materials.steel.poisson", "between -1 and 0.5", [](Study& s) { s.materials[0].poisson = 0.5; }},
        Bad{"materials.steel.young_x", "expected a number > 0",
            [](Study& s) { s.materials[0].law = LawKind::orthotropic; }},
        Bad{"materials.steel", "'young_z' is missing: the law orthotropic needs it in plane_strain",
            [](Study& s) { make_timber(s.materials[0]).young_z.reset(); }},
        Bad{"materials.steel", "'shear_yz' is missing: the law orthotropic needs it in solid",
            [](Study& s) {
              s.physics = Physics::solid;
              s.mesh = {};
              s.mesh.file = "beams.med";
              make_timber(s.materials[0]).shear_yz.reset();
            }},
        Bad{"materials.steel.poisson_yz", "the roots of young_y/young_z",
            [](Study& s) { make_timber(s.materials[0]).poisson_yz = -2.1; }},
        Bad{"materials.steel.poisson_xz", "the roots of young_x/young_z",
            [](Study& s) { make_timber(s.materials[0]).poisson_xz = 3.1; }},
        Bad{"materials.steel.poisson_xy", "1 - nu_xy nu_yx",
            [](Study& s) {
              auto& o = make_timber(s.materials[0]);
              o.poisson_xy = 1, o.poisson_yz = 1, o.poisson_xz = 1.5;
            }},
        Bad{"materials.steel.angle_x", "axes turn in the plane only in plane_strain",
            [](Study& s) { make_timber(s.materials[0]).angle_x = 5; }},
        Bad{"materials.steel.angle_z", "expected a number",
            [](Study& s) { make_timber(s.materials[0]).angle_z = nan; }},
        Bad{"materials.steel.young", "found t in 't', a number of a material depends on the place only",
            [](Study& s) { s.materials[0].in_place["young"] = Formula{"t"}; }},
        Bad{"materials.steel.young", "plane_strain has x and y only",
            [](Study& s) { s.materials[0].in_place["young"] = Formula{"z"}; }},
        Bad{"materials.steel.poisson", "found '0.7', expected a number between -1 and 0.5",
            [](Study& s) { s.materials[0].in_place["poisson"] = 0.7; }},
        Bad{"materials.steel.shear_xy", "the law elastic takes no shear_xy",
            [](Study& s) { s.materials[0].in_place["shear_xy"] = Formula{"x"}; }},
        Bad{"materials.steel.angle_x", "found a turn, but axes turn in the plane only",
            [](Study& s) {
              make_timber(s.materials[0]);
              s.materials[0].in_place["angle_x"] = Formula{"x"};
            }},
        Bad{"materials.steel.axes", "the law elastic takes no axes",
            [](Study& s) { s.materials[0].orthotropy.cylindrical = CylindricalAxes{}; }},
        Bad{"materials.steel.axes.cylindrical.direction", "a direction without length",
            [](Study& s) { make_timber(s.materials[0]).cylindrical = CylindricalAxes{{}, {0, 0, 0}}; }},
        Bad{"materials.steel.axes.cylindrical.direction", "in plane_strain the axes turn about z",
            [](Study& s) { make_timber(s.materials[0]).cylindrical = CylindricalAxes{{}, {0, 1, 1}}; }},
        Bad{"materials.steel.axes.cylindrical.point.1", "expected a number",
            [](Study& s) { make_timber(s.materials[0]).cylindrical = CylindricalAxes{{0, nan, 0}}; }},
        Bad{"materials.steel.hardening.linear.yield_stress", "expected a number > 0",
            [](Study& s) { s.materials[0].law = LawKind::plastic; }},
        Bad{"materials.steel.hardening.table", "found no point",
            [](Study& s) { make_plastic(s.materials[0]).hardening = HardeningKind::table; }},
        Bad{"materials.steel.hardening.table.1.1", "expected a number > 0",
            [](Study& s) {
              auto& plasticity = make_plastic(s.materials[0]);
              plasticity.hardening = HardeningKind::table;
              plasticity.points = {{0, 1}, {1, nan}};
            }},
        Bad{"materials.steel.kinematic", "found 4 back stresses, expected at most 3",
            [](Study& s) { make_plastic(s.materials[0]).kinematic.resize(4); }},
        Bad{"materials.steel.terms", "found no term", [](Study& s) { s.materials[0].law = LawKind::prony; }},
        Bad{"materials.steel.terms", "found no term",
            [](Study& s) { make_rubber(s.materials[0]), s.materials[0].law = LawKind::ogden; }},
        Bad{"materials.steel.poisson", "found 'poisson' beside 'bulk'",
            [](Study& s) { make_rubber(s.materials[0]), s.materials[0].poisson = 0.3; }},
        Bad{"materials.steel.c10", "depends on the place, but the law hyperelastic",
            [](Study& s) { make_rubber(s.materials[0]), s.materials[0].in_place["c10"] = Formula{"x"}; }},
        Bad{"materials.steel.strain", "takes no logarithmic strain",
            [](Study& s) { make_rubber(s.materials[0]), s.materials[0].strain = StrainKind::logarithmic; }},
        Bad{"time.max_step", "chooses its steps",
            [](Study& s) { make_plastic(s.materials[0]), explicitly(s), s.contact.clear(), s.time.max_step = 1; }},
        Bad{"time.arc_length", "follows the motion past limit loads by itself",
            [](Study& s) { make_plastic(s.materials[0]), s.time.arc_length = {1, "all"}; }},
        Bad{"time.arc_length", "as every material is linear",
            [](Study& s) { statically(s), s.time.arc_length = {1, "all"}; }},
        Bad{"time.arc_length", "has no load to multiply",
            [](Study& s) {
              make_plastic(s.materials[0]), statically(s);
              s.loads.clear(), s.time.arc_length = {1, "all"};
            }},
        Bad{"time.arc_length.length", "expected a number > 0",
            [](Study& s) {
              make_plastic(s.materials[0]), statically(s);
              s.time.arc_length = {0, "all"};
            }},
        Bad{"materials.steel.law", "the law plastic dissipates; expected moreau_jean",
            [](Study& s) { make_plastic(s.materials[0]), s.time.scheme = SchemeKind::energy_momentum; }},
        Bad{"materials.steel.expansion", "takes no nonlinear bodies that expand",
            [](Study& s) {
              s.materials[0].strain = StrainKind::green_lagrange, s.materials[0].expansion.emplace();
              s.temperatures.emplace_back().on = "all";
              s.time.scheme = SchemeKind::energy_momentum;
            }},
        Bad{"time.mass_scaling.step", "expected a number > 0",
            [](Study& s) { explicitly(s), s.contact.clear(), s.time.mass_scaling = 0; }},
        Bad{"time.mass_scaling", "has no step that is too long for a cell",
            [](Study& s) { s.time.mass_scaling = 1e-6; }},
        Bad{"time.max_plastic_step", "chooses its steps",
            [](Study& s) { make_plastic(s.materials[0]), explicitly(s), s.contact.clear(), s.time.max_plastic_step = 1; }},
        Bad{"materials.steel", "'density' is missing", [](Study& s) { s.materials[0].density.reset(); }},
        Bad{"materials.steel", "second entry", [](Study& s) { s.materials.push_back(s.materials[0]); }},
        Bad{"materials.st/eel", "letters, digits", [](Study& s) { s.materials[0].name = "st/eel"; }},
        Bad{"materials.steel.cells", "empty list", [](Study& s) { s.materials[0].everywhere = false; }},
        Bad{"functions.ramp.times.1", "ascend",
            [](Study& s) {
              s.functions["ramp"] = {{1, 1}, {0, 1}};
            }},
        Bad{"functions.ramp.values", "3 values for 2 times",
            [](Study& s) {
              s.functions["ramp"] = {{0, 1}, {0, 1, 2}};
            }},
        Bad{"functions.ramp.ramp", "expected a later instant",
            [](Study& s) { s.functions["ramp"] = Function(Ramp{1, 1, 0, 1}); }},
        Bad{"functions.ramp.ramp.to", "expected a number",
            [](Study& s) { s.functions["ramp"] = Function(Ramp{0, 1, 0, nan}); }},
        Bad{"functions.ramp.sine.frequency", "> 0",
            [](Study& s) { s.functions["ramp"] = Function(Sine{1, -1, 0, 0}); }},
        Bad{"functions.ramp.expression", "has t only",
            [](Study& s) { s.functions["ramp"] = Function(Expression("y")); }},
        Bad{"functions.ramp.product", "0 factors", [](Study& s) { s.functions["ramp"] = Function(Product{}); }},
        Bad{"functions.ramp.product.0.times", "empty list",
            [](Study& s) { s.functions["ramp"] = Function(Product{{Function()}}); }},
        Bad{"functions.ramp.product.0", "a product in a product",
            [](Study& s) { s.functions["ramp"] = Function(Product{{Function(Product{{Function(Ramp())}})}}); }},
        Bad{"functions", "at most 80000",
            [](Study& s) {
              std::vector<double> many(80'001);
              std::iota(many.begin(), many.end(), 0);
              s.functions["many"] = {many, many};
            }},
        Bad{"contact.joint.friction", "beside a friction that depends on the place",
            [](Study& s) {
              s.contact[0].friction = 0.5;
              s.contact[0].friction_in_place = Formula{"x"};
            }},
        Bad{"contact.joint.friction", "depends on the place only",
            [](Study& s) {
              s.contact[0].friction = 1;
              s.contact[0].friction_in_place = Formula{"t"};
            }},
        Bad{"mesh.groups.a.sphere.radius", "> 0", [](Study& s) { add_group(s, GroupKind::sphere); }},
        Bad{"mesh.groups.a.sphere.point.2", "plane_strain has no z",
            [](Study& s) { add_group(s, GroupKind::sphere).point = {0, 0, 1}; }},
        Bad{"mesh.groups.a.skin", "found 0 groups, expected one",
            [](Study& s) { add_group(s, GroupKind::skin); }},
        Bad{"mesh.groups.a.plane.normal", "length 0", [](Study& s) { add_group(s, GroupKind::plane); }},
        Bad{"mesh.groups.a.within", ">= 0",
            [](Study& s) {
              auto& group = add_group(s, GroupKind::plane);
              group.direction = {0, 1, 0};
              group.within = -1;
            }},
        Bad{"mesh.groups.a", "second entry",
            [](Study& s) {
              add_group(s, GroupKind::skin).of = {"lower"};
              add_group(s, GroupKind::skin).of = {"lower"};
            }},
        Bad{"mesh.groups.a b", "letters, digits",
            [](Study& s) {
              auto& group = add_group(s, GroupKind::skin);
              group.name = "a b";
              group.of = {"lower"};
            }},
        Bad{"mesh.groups", "at most 1000", [](Study& s) { s.mesh.groups.resize(1001); }},
        Bad{"supports.0", "holds nothing", [](Study& s) { s.supports[0].components = {}; }},
        Bad{"supports.0.z", "plane_strain has no z",
            [](Study& s) { s.supports[0].components[2] = Amplitude{}; }},
        Bad{"supports.0.x.function", "did you mean 'ramp'",
            [](Study& s) {
              s.supports[0].components[0] = Amplitude{1, "rampe"};
            }},
        Bad{"supports.0.x.name", "no name",
            [](Study& s) { s.supports[0].components[0] = Field(FileField{"a.med", "", "", {}}); }},
        Bad{"supports.0.x.value.at", "expected a number",
            [](Study& s) { s.supports[0].components[0] = Field(FileField{"a.med", "T", "", nan}, "ramp"); }},
        Bad{"springs.0.x", ">= 0", [](Study& s) { s.springs[0].stiffness[0] = -1; }},
        Bad{"loads.0.pressure.on", "no name", [](Study& s) { s.loads[0].on.clear(); }},
        Bad{"loads.0.pressure.function", "no function is called",
            [](Study& s) { s.loads[0].function = "other"; }},
        Bad{"initial.0", "says nothing",
            [](Study& s) {
              s.initial = {{"lower", {}, {}}};
            }},
        Bad{"initial", "the scheme static",
            [](Study& s) {
              s.time.scheme = SchemeKind::static_steps;
              s.time.contact_mass = ContactMass::consistent;
              s.initial = {{"lower", {}, {1.0, std::nullopt, std::nullopt}}};
            }},
        Bad{"contact.joint", "'master' or 'obstacle' is missing",
            [](Study& s) { s.contact[0].master.clear(); }},
        Bad{"contact.joint.slave", "expected two surfaces", [](Study& s) { s.contact[0].slave = "roof"; }},
        Bad{"contact.joint.friction", ">= 0", [](Study& s) { s.contact[0].friction = -0.1; }},
        Bad{"contact.joint.friction_method", "expected nodal_penalty",
            [](Study& s) {
              s.contact[0].method = ContactMethod::nodal_lagrange;
              s.contact[0].geometry.by = Iteration::fixed_point;
            }},
        Bad{"contact.joint.iterate.geometry", "expected fixed_point",
            [](Study& s) {
              s.contact[0].method = ContactMethod::nodal_lagrange;
              s.contact[0].friction_method = FrictionMethod::nodal_penalty;
            }},
        Bad{"contact.joint.integration.gauss", "from 1 to 7",
            [](Study& s) {
              s.contact[0].integration = {ContactIntegration::gauss, 8};
            }},
        Bad{"contact.joint.coefficients.normal", "> 0",
            [](Study& s) { s.contact[0].normal_coefficient = 0; }},
        Bad{"contact.joint", "stops bodies by impulses",
            [](Study& s) {
              s.contact[0].method = ContactMethod::penalty;
              s.contact[0].friction_method = FrictionMethod::penalty;
            }},
        // Multipliers asked for where only forces are computed.
        Bad{"contact.joint", "the scheme central_difference has forces only",
            [](Study& s) { explicitly(s); }},
        Bad{"time.record", "> 0",
            [](Study& s) {
              explicitly(s);
              s.contact.clear();
              s.time.record = 0;
            }},
        Bad{"time.contact_mass", "static has no masses",
            [](Study& s) { s.time.scheme = SchemeKind::static_steps; }},
        Bad{"time.theta", "from 0.5 to 1", [](Study& s) { s.time.theta = 0.3; }},
        Bad{"time.end", "expected more than the begin", [](Study& s) { s.time.end = 0; }},
        Bad{"time.step", "at most the length of the run", [](Study& s) { s.time.step = 2; }},
        Bad{"time.instants.0", "after the begin",
            [](Study& s) {
              s.time.instants = {0, 1};
            }},
        Bad{"time.start.from", "no name", [](Study& s) { s.time.start = StartKind::from_run; }},
        Bad{"time.on_failure.cut", "from 2 to 1000", [](Study& s) { s.time.cut_parts = 1; }},
        Bad{"newton.residual", "between 0 and 1", [](Study& s) { s.newton.residual = 0; }},
        Bad{"probes.tip", "is missing", [](Study& s) { s.probes[0].node.clear(); }},
        Bad{"fields.at.0", "an instant of the run, 0 to 1", [](Study& s) { s.fields.at = {2}; }},
        Bad{"checks.0.probe", "did you mean 'tip'", [](Study& s) { s.checks[0].probe = "tipp"; }},
        Bad{"checks.0.probe", "component 'z'", [](Study& s) { s.checks[0].component = "z"; }},
        Bad{"checks.0.probe", "as in tip.y", [](Study& s) { s.checks[0].component.clear(); }},
        Bad{"checks.0.probe", "von_mises has none", [](Study& s) { s.probes[0].field = ProbeField::von_mises; }},
        Bad{"probes.tip.field", "the study has no contact",
            [](Study& s) {
              s.probes[0].field = ProbeField::contact_pressure;
              s.checks[0].component.clear();
              s.contact.clear();
            }},
        Bad{"probes.tip.field", "expected 'place: nodes'",
            [](Study& s) {
              s.probes[0].place = ProbePlace::gauss_points;
              s.probes[0].take = ProbeTake::largest;
            }},
        Bad{"probes.tip.place", "goes with 'point', or with 'on' and 'take'",
            [](Study& s) {
              s.probes[0].place = ProbePlace::cells;
              s.probes[0].field = ProbeField::mean_stress;
              s.checks[0].component.clear();
            }},
        Bad{"probes.tip.take", "expected mean, min or max",
            [](Study& s) {
              s.probes[0].place = ProbePlace::cells;
              s.probes[0].field = ProbeField::mean_stress;
              s.probes[0].take = ProbeTake::sum;
              s.checks[0].component.clear();
            }},
        Bad{"checks.0", "is missing", [](Study& s) { s.checks[0].probe.clear(); }},
        Bad{"checks.0", "found several of", [](Study& s) { s.checks[0].energy = "friction"; }},
        Bad{"checks.0.energy", "did you mean 'friction'",
            [](Study& s) {
              s.checks[0].probe.clear();
              s.checks[0].energy = "frictoin";
            }},
        Bad{"checks.0.resultant", "did you mean 'joint'",
            [](Study& s) {
              s.checks[0].probe.clear();
              s.checks[0].resultant = {"jiont", "normal"};
            }},
        Bad{"checks.0.resultant", "did you mean 'force.y'",
            [](Study& s) {
              s.checks[0].probe.clear();
              s.checks[0].resultant = {"joint", "force.yy"};
            }},
        Bad{"loads.0.gravity.follower", "expected 'pressure'",
            [](Study& s) {
              s.loads[0].kind = LoadKind::gravity;
              s.loads[0].follower = true;
            }},
        Bad{"loads.0.pressure.follower", "expected a material with strain: green_lagrange or logarithmic",
            [](Study& s) { s.loads[0].follower = true; }},
        Bad{"supports.0.rotate.axis", "found a direction in the plane, plane_strain turns about z only",
            [](Study& s) { s.supports[0].rotate = Rotation{{}, {1, 0, 1}, {}}; }},
        Bad{"supports.0.rotate.about.2", "plane_strain has no z",
            [](Study& s) { s.supports[0].rotate = Rotation{{0, 0, 1}, {0, 0, 1}, {}}; }},
        Bad{"supports.0.rotate.angle", "depends on the place",
            [](Study& s) {
              s.supports[0].rotate = Rotation{{}, {0, 0, 1}, Profile{0, {{0, 1}, {0, 1}, {}}}};
            }},
        Bad{"probes.tip.about", "goes with the sum of a reaction",
            [](Study& s) {
              s.probes[0].take = ProbeTake::sum;
              s.probes[0].about = {0, 0, 0};
            }},
        Bad{"probes.tip.about.2", "plane_strain has no z",
            [](Study& s) {
              s.probes[0].field = ProbeField::reaction;
              s.probes[0].take = ProbeTake::sum;
              s.probes[0].about = {0, 0, 1};
              s.checks.clear();
            }},
        Bad{"checks.0.over", "goes without 'run'",
            [](Study& s) {
              s.checks[0].when = CheckedTime::largest;
              s.checks[0].run = "before";
              s.checks[0].source = CheckSource::other_run;
            }},
        Bad{"checks.0.at", "an instant of the run", [](Study& s) { s.checks[0].at = 3; }},
        Bad{"checks.0.tolerance", "> 0", [](Study& s) { s.checks[0].tolerance = 0; }},
        Bad{"checks.0.reference", "nothing can be relative", [](Study& s) { s.checks[0].reference = 0; }}));

TEST(BrokenRules, AreAllToldAtOnce) {
  auto study = sound_study();
  study.materials[0].young = 0;
  study.time.theta = 2;
  study.contact[0].friction = -1;
  try {
    validate(study);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 3U) << error.what();
  }
}

} // namespace
} // namespace rubato::study::validate_test
