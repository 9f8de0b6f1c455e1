// SPDX-License-Identifier: LGPL-3.0-or-later
// What each key means and what stands when it is not given.
#include <gtest/gtest.h>

#include "sample_deck.hpp"
#include <filesystem>
#include <fstream>
#include <iterator>

namespace rubato::deck::keys_test {
namespace {

using test::full_deck;
using test::parse;
using test::parse_one;
using test::replaced;
using test::smallest_deck;

TEST(DeckDefaults, AreThoseOfTheStudy) {
  const auto deck = parse(smallest_deck);
  ASSERT_EQ(deck.runs.size(), 1U);
  EXPECT_EQ(deck.title, "");

  study::Study expected;
  expected.name = "run";
  expected.mesh.file = "beams.med";
  study::Material steel;
  steel.name = "steel";
  steel.young = 200e9;
  steel.poisson = 0.3;
  steel.density = 7800;
  expected.materials = {steel};
  expected.time.scheme = study::SchemeKind::newmark;
  expected.time.contact_mass = study::ContactMass::consistent;
  expected.time.step = 1e-3;
  expected.time.end = 0.012;
  EXPECT_EQ(deck.runs[0], expected);
}

TEST(DeckDefaults, OfTheStudyAreTheDocumentedOnes) {
  const auto study = parse_one(smallest_deck);
  EXPECT_EQ(study.units, "SI");
  EXPECT_EQ(study.thickness, 1);
  EXPECT_EQ(study.mesh.convert, study::MeshConversion::none);
  EXPECT_EQ(study.mesh.refine, 1);
  EXPECT_TRUE(study.materials[0].everywhere);
  EXPECT_EQ(study.time.begin, 0);
  EXPECT_EQ(study.time.start, study::StartKind::consistent);
  EXPECT_EQ(study.time.spectral_radius, 0.5);
  EXPECT_EQ(study.time.cut_parts, 2);
  EXPECT_EQ(study.time.cut_levels, 12);
  EXPECT_EQ(study.newton.max_iterations, 40);
  EXPECT_EQ(study.newton.residual, 1e-8);
  EXPECT_FALSE(study.fields.vtu || study.fields.med);
}

TEST(DeckKeys, TitleUnitsAndPhysics) {
  const auto study = parse_one(full_deck);
  EXPECT_EQ(parse(full_deck).title, "two beams");
  EXPECT_EQ(study.title, "two beams");
  EXPECT_EQ(study.units, "mm, N, s");
  EXPECT_EQ(study.physics, study::Physics::plane_stress);
  EXPECT_EQ(study.thickness, 0.5);
}

TEST(DeckKeys, GeneratedMesh) {
  const auto mesh = parse_one(full_deck).mesh;
  ASSERT_EQ(mesh.bodies.size(), 2U);
  EXPECT_EQ(mesh.file, "");
  EXPECT_EQ(mesh.convert, study::MeshConversion::full_quadratic);
  EXPECT_EQ(mesh.refine, 2);
  const auto& upper = mesh.bodies[0];
  EXPECT_EQ(upper.name, "upper");
  EXPECT_EQ(upper.dimension, 2);
  EXPECT_EQ(upper.from, (std::array{0.0, 0.1, 0.0}));
  EXPECT_EQ(upper.to, (std::array{1.0, 0.2, 0.0}));
  EXPECT_EQ(upper.divisions, (std::array{20, 2, 1}));
  EXPECT_EQ(upper.cells, CellType::quad8);
  EXPECT_EQ(upper.sides.size(), 4U);
  EXPECT_EQ(upper.sides.at("bottom"), "Below");
  EXPECT_EQ(upper.points.at("right_top"), "Force");
  EXPECT_EQ(mesh.bodies[1].cells, CellType::quad4);
}

TEST(DeckKeys, GeneratedBoxNamesSidesEdgesAndPoints) {
  const auto deck = replaced(smallest_deck, "{file: beams.med}", R"({generate: [{name: b,
    box: {from: [0, 0, 0], to: [1, 2, 3]}, divisions: [4, 5, 6], cells: penta15,
    sides: {back: A, front: B}, edges: {right_top: C, top_back: D}, points: {right_top_back: E, left_bottom_front: F}}]})");
  const auto body = parse_one(deck).mesh.bodies.at(0);
  EXPECT_EQ(body.dimension, 3);
  EXPECT_EQ(body.to, (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ(body.divisions, (std::array{4, 5, 6}));
  EXPECT_EQ(body.cells, CellType::penta15);
  EXPECT_EQ(body.sides.at("front"), "B");
  EXPECT_EQ(body.edges.at("top_back"), "D");
  EXPECT_EQ(body.points.at("left_bottom_front"), "F");
  EXPECT_EQ(parse_one(replaced(deck, "cells: penta15,", "")).mesh.bodies.at(0).cells, CellType::hexa8);
}

TEST(DeckKeys, MeshFileStandsBesideTheDeck) {
  const auto deck = replaced(smallest_deck, "beams.med}", "meshes/beams.med, name: Mesh_1}");
  const auto mesh = parse_deck(deck, "cases/a/a.yaml").runs.at(0).mesh;
  EXPECT_EQ(mesh.file, "cases/a/meshes/beams.med");
  EXPECT_EQ(mesh.file_mesh, "Mesh_1");
  EXPECT_TRUE(mesh.bodies.empty());
  const auto absolute = parse_deck(replaced(deck, "meshes/", "/meshes/"), "cases/a/a.yaml").runs.at(0).mesh;
  EXPECT_EQ(absolute.file, "/meshes/beams.med");
}

TEST(DeckKeys, Materials) {
  const auto material = parse_one(full_deck).materials.at(0);
  EXPECT_EQ(material.name, "steel");
  EXPECT_EQ(material.young, 200e9);
  EXPECT_EQ(material.poisson, 0.25);
  EXPECT_EQ(material.density, 7800);
  EXPECT_EQ(material.rayleigh_stiffness, 1e-5);
  EXPECT_EQ(material.rayleigh_mass, 2);
  EXPECT_FALSE(material.everywhere);
  ASSERT_EQ(material.cells.size(), 2U);
  EXPECT_EQ(material.cells[1], "lower");
  const auto one_group = parse_one(replaced(full_deck, "[upper, lower]", "upper")).materials.at(0);
  ASSERT_EQ(one_group.cells.size(), 1U);
  EXPECT_TRUE(parse_one(replaced(full_deck, "[upper, lower]", "all")).materials.at(0).everywhere);
}

TEST(DeckKeys, TheLawOfAMaterialIsElasticUnlessSaid) {
  EXPECT_EQ(parse_one(full_deck).materials.at(0).law, study::LawKind::elastic);
  const auto said = replaced(full_deck, "young: 200e9", "law: elastic\n    young: 200e9");
  EXPECT_EQ(parse_one(said), parse_one(full_deck));
}

TEST(DeckKeys, MaterialsKeepTheOrderOfTheFile) {
  const auto deck = replaced(smallest_deck, "density: 7800}",
                             "density: 7800, cells: a}, brass: {young: 1e11, "
                             "poisson: 0, density: 8500, cells: b}");
  const auto materials = parse_one(deck).materials;
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials[0].name, "steel");
  EXPECT_EQ(materials[1].name, "brass");
}

TEST(DeckKeys, Springs) {
  const auto springs = parse_one(full_deck).springs;
  ASSERT_EQ(springs.size(), 1U);
  EXPECT_EQ(springs[0].on, "End");
  EXPECT_EQ(springs[0].stiffness, (std::array{1e4, 2e4, 0.0}));
}

TEST(DeckKeys, InitialMotion) {
  const auto initial = parse_one(full_deck).initial;
  ASSERT_EQ(initial.size(), 2U);
  EXPECT_EQ(initial[0].on, "lower");
  EXPECT_FALSE(initial[0].displacement[0] || initial[0].velocity[2]);
  EXPECT_EQ(initial[0].velocity[0], -10);
  EXPECT_EQ(initial[1].displacement[1], 1e-3);
  EXPECT_EQ(initial[1].velocity[1], 2);
}

TEST(DeckKeys, Supports) {
  const auto supports = parse_one(full_deck).supports;
  ASSERT_EQ(supports.size(), 2U);
  EXPECT_EQ(supports[0].on, "Clamped");
  EXPECT_EQ(supports[0].components[0], study::Amplitude{});
  EXPECT_EQ(supports[0].components[1], study::Amplitude{});
  EXPECT_FALSE(supports[0].components[2]);
  EXPECT_EQ(supports[1].components[0], (study::Amplitude{0.1, {}}));
  EXPECT_EQ(supports[1].components[1], (study::Amplitude{0.2, "ramp"}));
}

TEST(DeckKeys, Loads) {
  const auto loads = parse_one(full_deck).loads;
  ASSERT_EQ(loads.size(), 5U);
  const auto is = [&](std::size_t i, study::LoadKind kind, const std::string& on,
                      const std::array<study::FieldValue, 3>& components, const std::string& function) {
    EXPECT_EQ(loads[i], (study::Load{kind, on, components, function})) << i;
  };
  is(0, study::LoadKind::nodal_force, "Force", {0, -1e7, 0}, "ramp");
  is(1, study::LoadKind::line_force, "Above", {1, 0, 0}, "");
  is(2, study::LoadKind::surface_force, "Above", {2, 3, 0}, "");
  is(3, study::LoadKind::pressure, "Above", {4, 0, 0}, "hold");
  is(4, study::LoadKind::gravity, "upper", {0, -9.81, 0}, "");
}

TEST(DeckKeys, Functions) {
  const auto functions = parse_one(full_deck).functions;
  ASSERT_EQ(functions.size(), 2U);
  EXPECT_EQ(functions.at("ramp"), (Function{{0, 1, 2}, {0, 1, 0.5}, Function::Outside::linear}));
  EXPECT_EQ(functions.at("hold").table()->outside, Function::Outside::zero);
}

TEST(DeckKeys, Contact) {
  const auto zones = parse_one(full_deck).contact;
  ASSERT_EQ(zones.size(), 1U);
  const auto& zone = zones[0];
  EXPECT_EQ(zone.name, "interface");
  EXPECT_EQ(zone.master, "Below");
  EXPECT_EQ(zone.slave, "Beneath");
  EXPECT_EQ(zone.friction, 0.2);
  EXPECT_EQ(zone.method, study::ContactMethod::augmented_lagrangian);
  EXPECT_EQ(zone.normal, study::ContactNormal::average);
  EXPECT_EQ(zone.clamped_normal, study::ClampedNormal::code_aster);
  EXPECT_EQ(zone.integration, (study::ContactRule{study::ContactIntegration::gauss, 3}));
  ASSERT_EQ(zone.exclude_nodes.size(), 2U);
  EXPECT_EQ(zone.exclude_nodes[1], "N6");
  EXPECT_EQ(zone.initially_active, false);
  EXPECT_EQ(zone.normal_coefficient, 1e9);
  EXPECT_EQ(zone.tangential_coefficient, 1e7);
  EXPECT_EQ(zone.friction_method, study::FrictionMethod::penalty);
  EXPECT_EQ(zone.geometry, (study::Level{study::Iteration::fixed_point, 2e-3, 7}));
  EXPECT_EQ(zone.threshold, (study::Level{study::Iteration::newton, 1e-4, 10}));
  EXPECT_EQ(zone.status, (study::Level{study::Iteration::fixed_point, 0, 30}));
  EXPECT_FALSE(zone.history_force);
}

TEST(DeckKeys, ContactOnlyNeedsItsTwoSurfaces) {
  const auto zone =
      parse_one(smallest_deck + "contact: {a: {master: M, slave: S, integration: nodes}}").contact.at(0);
  study::ContactZone expected;
  expected.name = "a";
  expected.master = "M";
  expected.slave = "S";
  EXPECT_EQ(zone, expected);
}

TEST(DeckKeys, ContactMayLeaveItsSidesToTheModel) {
  const auto zone_of = [](const std::string& zone) {
    return parse_one(smallest_deck + "contact: {a: {" + zone + "}}").contact.at(0);
  };
  EXPECT_EQ(zone_of("between: [M, S]").between, (std::vector<std::string>{"M", "S"}));
  EXPECT_TRUE(zone_of("all: true").all);
  EXPECT_EQ(zone_of("self: skin").self, "skin");
}

TEST(DeckKeys, ContactIsByMortarUnlessItCannotBe) {
  using enum study::ContactIntegration;
  const auto integration = [](const std::string& zone, const std::string& deck = smallest_deck) {
    return parse_one(deck + "contact: {a: {" + zone + "}}").contact.at(0).integration.by;
  };
  const auto explicit_deck = replaced(smallest_deck, "newmark", "central_difference");
  const std::string pair = "master: M, slave: S";
  EXPECT_EQ(integration(pair), mortar);
  EXPECT_EQ(integration("between: [M, S], friction: 0.3"), mortar);
  EXPECT_EQ(integration("self: skin"), mortar);
  EXPECT_EQ(integration(pair + ", tie: true"), mortar);
  EXPECT_EQ(integration("slave: S, obstacle: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}"), nodes);
  EXPECT_EQ(integration(pair + ", method: penalty"), mortar);
  EXPECT_EQ(integration(pair + ", integration: nodes"), nodes);
  EXPECT_EQ(integration(pair + ", method: nodal_lagrange"), nodes);
  EXPECT_EQ(integration("self: skin, method: nodal_lagrange"), nodes);
  EXPECT_EQ(integration(pair + ", normal: average"), nodes);
  EXPECT_EQ(integration(pair + ", clamped_normal: code_aster"), nodes);
  EXPECT_EQ(integration(pair + ", method: penalty", explicit_deck), nodes);
}

TEST(DeckKeys, AContactMethodBringsItsFrictionAndItsGeometryLoop) {
  const auto zone_of = [](const std::string& method) {
    return parse_one(smallest_deck + "contact: {a: {master: M, slave: S, method: " + method + "}}")
        .contact.at(0);
  };
  EXPECT_EQ(zone_of("augmented_lagrangian").friction_method, study::FrictionMethod::augmented_lagrangian);
  EXPECT_EQ(zone_of("penalty").friction_method, study::FrictionMethod::penalty);
  EXPECT_EQ(zone_of("penalty").geometry.by, study::Iteration::newton);
  for (const std::string nodal : {"nodal_lagrange", "nodal_penalty", "nodal_pcg"}) {
    EXPECT_EQ(zone_of(nodal).friction_method, study::FrictionMethod::nodal_penalty) << nodal;
    EXPECT_EQ(zone_of(nodal).geometry.by, study::Iteration::fixed_point) << nodal;
  }
}

TEST(DeckKeys, AnExponentialPressureHasItsOwnCoefficients) {
  const auto zone = parse_one(smallest_deck + "contact: {a: {master: M, slave: S, method: exponential, "
                                              "coefficients: {pressure: 2e6, clearance: 1e-5}}}")
                        .contact.at(0);
  EXPECT_EQ(zone.method, study::ContactMethod::exponential);
  EXPECT_EQ(zone.pressure, 2e6);
  EXPECT_EQ(zone.clearance, 1e-5);
  EXPECT_EQ(zone.friction_method, study::FrictionMethod::penalty);
}

TEST(DeckKeys, TimeSteps) {
  const auto time = parse_one(full_deck).time;
  EXPECT_EQ(time.scheme, study::SchemeKind::hht);
  EXPECT_EQ(time.alpha, -0.3);
  EXPECT_EQ(time.begin, 0.001);
  EXPECT_EQ(time.step, 1e-3);
  EXPECT_EQ(time.end, 0.013);
  EXPECT_EQ(time.start, study::StartKind::consistent);
  EXPECT_EQ(parse_one(replaced(smallest_deck, "newmark", "newmark, start: at_rest_unloaded")).time.start,
            study::StartKind::at_rest_unloaded);
  EXPECT_EQ(time.cut_parts, 4);
  EXPECT_EQ(time.cut_levels, 6);
}

TEST(DeckKeys, ADeckThatNamesNoSchemeHasTheOneThatContactGivesNoEnergy) {
  const auto time = parse_one(replaced(smallest_deck, "scheme: newmark, ", "")).time;
  EXPECT_EQ(time.scheme, study::SchemeKind::moreau_jean);
  EXPECT_EQ(time.contact_mass, study::ContactMass::redistributed);
  EXPECT_EQ(parse_one(smallest_deck).time.contact_mass, study::ContactMass::consistent);
  for (const auto* scheme : {"moreau_jean", "energy_momentum"})
    EXPECT_EQ(parse_one(replaced(smallest_deck, "newmark", scheme)).time.contact_mass,
              study::ContactMass::redistributed);
  EXPECT_EQ(
      parse_one(replaced(smallest_deck, "scheme: newmark", "contact_mass: consistent")).time.contact_mass,
      study::ContactMass::consistent);
}

TEST(DeckKeys, EverySchemeWithItsOwnNumbers) {
  const auto time = [](const std::string& scheme) {
    return parse_one(replaced(smallest_deck, "scheme: newmark", "scheme: " + scheme)).time;
  };
  const auto newmark = time("newmark, beta: 0.3025, gamma: 0.6");
  EXPECT_EQ(newmark.beta, 0.3025);
  EXPECT_EQ(newmark.gamma, 0.6);
  EXPECT_FALSE(time("newmark").beta.has_value());
  EXPECT_EQ(time("hht, alpha: 0").alpha, 0);
  EXPECT_EQ(time("modified_average_acceleration, alpha: -0.5").alpha, -0.5);
  EXPECT_EQ(time("generalized_alpha, spectral_radius: 0.5").spectral_radius, 0.5);
  EXPECT_EQ(time("moreau_jean").theta, 0.5);
  EXPECT_EQ(time("moreau_jean, theta: 0.75").theta, 0.75);
  EXPECT_EQ(time("energy_momentum").scheme, study::SchemeKind::energy_momentum);
  EXPECT_EQ(time("static").scheme, study::SchemeKind::static_steps);
  EXPECT_EQ(time("central_difference, safety: 0.5").safety, 0.5);
  EXPECT_EQ(time("central_difference").safety, 0.9);
  EXPECT_EQ(time("central_difference, mass_scaling: {step: 1e-6}").mass_scaling, 1e-6);
  EXPECT_EQ(time("central_difference").mass_scaling, std::nullopt);
  EXPECT_EQ(time("central_difference").step, 1e-3);
  EXPECT_DOUBLE_EQ(time("central_difference").record, 0.012 / 1000);
  EXPECT_EQ(time("central_difference, record: 1e-4").record, 1e-4);
}

TEST(DeckKeys, InstantsInsteadOfStepAndEnd) {
  const auto time =
      parse_one(replaced(smallest_deck, "step: 1e-3, end: 0.012", "instants: [0.5, 1, 3]")).time;
  EXPECT_EQ(time.instants, (std::vector{0.5, 1.0, 3.0}));
  EXPECT_EQ(time.end, 3);
  EXPECT_EQ(time.step, 0);
}

TEST(DeckKeys, StaticRunsNeedNoDensity) {
  auto deck = replaced(smallest_deck, ", density: 7800", "");
  deck = replaced(deck, "newmark", "static");
  EXPECT_FALSE(parse_one(deck).materials.at(0).density.has_value());
}

TEST(DeckKeys, NewtonProbesFieldsAndChecks) {
  const auto study = parse_one(full_deck);
  EXPECT_EQ(study.newton, (study::NewtonSettings{25, 1e-9}));
  ASSERT_EQ(study.probes.size(), 2U);
  EXPECT_EQ(study.probes[0].name, "tip");
  EXPECT_EQ(study.probes[0].node, "Force");
  EXPECT_EQ(study.probes[0].field, study::ProbeField::velocity);
  EXPECT_EQ(study.probes[1].point, (std::array{0.5, 0.15, 0.0}));
  EXPECT_EQ(study.probes[1].field, study::ProbeField::reaction);
  EXPECT_TRUE(study.fields.vtu && study.fields.med && !study.fields.vtkhdf);
  EXPECT_EQ(study.fields.at, (std::vector<double>{0.001, 0.006}));
  EXPECT_EQ(study.fields.every, 10);
  EXPECT_FALSE(study.fields.last);
  EXPECT_EQ(study.checkpoint, (study::CheckpointOutput{{0.002}, 20, false}));
  ASSERT_EQ(study.checks.size(), 1U);
  study::Check expected;
  expected.probe = "tip";
  expected.component = "y";
  expected.at = 0.012;
  expected.reference = -0.0132;
  expected.tolerance = 1e-3;
  expected.relative = false;
  expected.source = study::CheckSource::other_code;
  expected.note = "table 3";
  EXPECT_EQ(study.checks[0], expected);
}

TEST(DeckKeys, WithoutACheckpointTheEndIsKept) {
  EXPECT_EQ(parse_one(smallest_deck).checkpoint, (study::CheckpointOutput{{}, 0, true}));
  EXPECT_EQ(parse_one(smallest_deck + "checkpoint: {every: 3}").checkpoint,
            (study::CheckpointOutput{{}, 3, true}));
}

TEST(DeckKeys, FieldsAloneAreWrittenForParaView) {
  const auto fields = parse_one(smallest_deck + "fields: {}").fields;
  study::FieldOutput expected;
  expected.vtu = true;
  EXPECT_EQ(fields, expected);
  EXPECT_EQ(fields.digits, 9);
}

TEST(DeckKeys, FieldsAreChosenByTheirNames) {
  const auto fields =
      parse_one(smallest_deck + "fields: {formats: [vtkhdf], only: [displacement, stress_elga], digits: 17}")
          .fields;
  EXPECT_TRUE(fields.vtkhdf && !fields.vtu && !fields.med);
  EXPECT_EQ(fields.only, (std::vector<std::string>{"displacement", "stress_elga"}));
  EXPECT_EQ(fields.digits, 17);
  EXPECT_EQ(parse_one(smallest_deck + "fields: {also: strain}").fields.also,
            std::vector<std::string>{"strain"});
}

TEST(DeckKeys, ProbesAreInCellsAndAtTheirGaussPoints) {
  const auto study = parse_one(smallest_deck + R"(
probes:
  most: {on: all, take: max, field: cumulated_plastic_strain, place: gauss_points}
  near: {point: [0.5, 0, 0], field: principal_stress, place: cells}
  node: {node: N1, field: tresca}
checks:
  - {probe: most, at: 0.012, reference: 1, tolerance: 1}
  - {probe: near.3, at: 0.012, reference: 1, tolerance: 1}
)");
  EXPECT_EQ(study.probes[0].place, study::ProbePlace::gauss_points);
  EXPECT_EQ(study.probes[0].field, study::ProbeField::cumulated_plastic_strain);
  EXPECT_EQ(study.probes[1].place, study::ProbePlace::cells);
  EXPECT_EQ(study.probes[2].place, study::ProbePlace::nodes);
  EXPECT_EQ(study.checks[1].component, "3");
}

TEST(DeckKeys, ProbesAreInCutsAndDifferencesToo) {
  const auto study = parse_one(smallest_deck + R"(
probes:
  held: {on: clamped, field: reaction}
  least: {on: clamped, take: min, field: reaction}
  a: {node: N1}
  b: {node: N2}
  middle: {section: {point: [0.5, 0, 0], normal: [1, 0, 0], cells: beam}}
  end: {section: {on: clamped, point: [0, 0, 0], normal: [-1, 0, 0]}}
  stretch: {minus: [b, a]}
)");
  ASSERT_EQ(study.probes.size(), 7U);
  EXPECT_EQ(study.probes[0].take, study::ProbeTake::sum) << "the force of the support";
  EXPECT_EQ(study.probes[1].take, study::ProbeTake::least);
  EXPECT_EQ(study.probes[4].section, (study::Cut{{0.5, 0, 0}, {1, 0, 0}, "", "beam"}));
  EXPECT_EQ(study.probes[5].section->on, "clamped");
  EXPECT_EQ(study.probes[6].minus, (std::vector<std::string>{"b", "a"}));
}

TEST(DeckKeys, NamesAndPartsKeepTheirPlaces) {
  const auto places = parse_deck(full_deck, "study.yaml").places.at(0);
  const auto place = [&](const char* path) { return to_string(places.of(path)); };
  EXPECT_EQ(place("supports.0.on"), test::place_of(full_deck, "Clamped, fix"));
  EXPECT_EQ(place("materials.steel"), test::place_of(full_deck, "steel"));
  EXPECT_EQ(place("contact.interface.slave"), test::place_of(full_deck, "Beneath\n"));
  EXPECT_EQ(place("probes.tip"), test::place_of(full_deck, "tip"));
  EXPECT_EQ(place("checks.0"), test::place_of(full_deck, "{probe"));
}

TEST(DeckKeys, WhatIsNotWrittenIsWhereWhatIsAroundItIs) {
  const auto places = parse_deck(full_deck, "study.yaml").places.at(0);
  EXPECT_EQ(to_string(places.of("supports.0.on.2")), to_string(places.of("supports.0.on")));
  EXPECT_EQ(to_string(places.of("materials.steel.nothing.here")), to_string(places.of("materials.steel")));
  EXPECT_EQ(to_string(places.of("nowhere")), "study.yaml:1:1");
}

TEST(DeckNumbers, AreReadStrictlyButInEveryUsualForm) {
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
           {"1e-3", 1e-3}, {"1.5E+2", 150}, {"+2", 2}, {".5", .5}, {"3.", 3}, {"0012", 12}, {"200e9", 200e9}})
    EXPECT_EQ(parse_one(replaced(smallest_deck, "200e9", text)).materials.at(0).young, value) << text;
}

TEST(ReadDeck, ReadsAFile) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "rubato_deck_test";
  std::filesystem::create_directories(folder);
  const auto file = folder / "small.yaml";
  std::ofstream(file) << smallest_deck;
  EXPECT_EQ(read_deck(file).runs.at(0).mesh.file, (folder / "beams.med").string());
  EXPECT_THROW(read_deck(folder / "absent.yaml"), InputError);
  EXPECT_THROW(read_deck(folder), InputError);
  std::filesystem::remove_all(folder);
}

TEST(DeckGuide, ShowsADeckThatIsRead) {
  std::ifstream page(RUBATO_SOURCE_DIR "/docs/guide/deck.md");
  ASSERT_TRUE(page.good());
  const std::string text(std::istreambuf_iterator<char>(page), {});
  const std::string opening = "```yaml\n";
  const auto begin = text.find(opening) + opening.size();
  const auto deck = parse(text.substr(begin, text.find("```", begin) - begin));
  ASSERT_EQ(deck.runs.size(), 2U);
  EXPECT_EQ(deck.runs[0].contact.at(0).friction, 0.2);
  EXPECT_EQ(deck.runs[1].contact.at(0).friction, 0);
}

} // namespace
} // namespace rubato::deck::keys_test
