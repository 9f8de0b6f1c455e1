// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials that yield, stretch and creep: what their keys mean, and what is wrong with them.
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>

#include "sample_deck.hpp"

namespace rubato::deck::laws_test {
namespace {

using study::Formulation;
using study::HardeningKind;
using study::LawKind;
using study::StrainKind;
using test::faults_of;
using test::parse_one;
using test::replaced;
using test::Sentences;
using test::smallest_deck;

/// The smallest deck with a material of these words, and these lines after it.
std::string deck_with(const std::string& material, const std::string& lines = "") {
  return replaced(smallest_deck, "young: 200e9, poisson: 0.3", material) + lines;
}

const std::string steel = "law: plastic, young: 200e9, poisson: 0.3, ";
const std::string bilinear = steel + "hardening: {linear: {yield_stress: 400e6}}";

study::Material material_of(const std::string& words) {
  return parse_one(deck_with(words)).materials.at(0);
}

/// Without the place.
Sentences faults_with(const std::string& material, const std::string& lines = "") {
  Sentences sentences;
  for (const auto& sentence : faults_of(deck_with(material, lines)))
    sentences.push_back(sentence.substr(sentence.find(": ") + 2));
  return sentences;
}

TEST(PlasticMaterial, HardensLinearly) {
  const auto material = material_of(steel + "hardening: {linear: {yield_stress: 400e6, modulus: 2e9}}");
  EXPECT_EQ(material.law, LawKind::plastic);
  EXPECT_EQ(material.young, 200e9);
  EXPECT_EQ(material.plasticity.hardening, HardeningKind::linear);
  EXPECT_EQ(material.plasticity.yield_stress, 400e6);
  EXPECT_EQ(material.plasticity.modulus, 2e9);
  EXPECT_EQ(material_of(bilinear).plasticity.modulus, 0);
}

TEST(PlasticMaterial, TakesTheSlopeOfATensionTest) {
  const auto material = material_of(steel + "hardening: {linear: {yield_stress: 4, tangent_modulus: 50e9}}");
  EXPECT_DOUBLE_EQ(material.plasticity.modulus, 200e9 / 3);
}

TEST(PlasticMaterial, HardensByTables) {
  const auto table = material_of(steel + "hardening: {table: [[0, 400e6], [0.01, 450e6]]}").plasticity;
  EXPECT_EQ(table.hardening, HardeningKind::table);
  EXPECT_EQ(table.points, (std::vector<std::array<double, 2>>{{0, 400e6}, {0.01, 450e6}}));
  const auto tension =
      material_of(steel + "hardening: {tension_table: [[0.002, 400e6], [0.01, 450e6]]}").plasticity;
  EXPECT_EQ(tension.hardening, HardeningKind::tension_table);
  EXPECT_EQ(tension.points.at(1)[0], 0.01);
}

TEST(PlasticMaterial, HardensByVoceAndByJohnsonAndCook) {
  const auto voce =
      material_of(steel + "hardening: {voce: {yield_stress: 1, saturation: 2, exponent: 3, modulus: 4}}")
          .plasticity;
  EXPECT_EQ(voce.hardening, HardeningKind::voce);
  EXPECT_EQ((std::array{voce.yield_stress, voce.saturation, voce.rate, voce.modulus}),
            (std::array{1.0, 2.0, 3.0, 4.0}));
  const auto cook = material_of(steel + "hardening: {johnson_cook: {yield_stress: 1, factor: 2, exponent: "
                                        "0.5, rate_factor: 4, reference_rate: 5}}")
                        .plasticity;
  EXPECT_EQ(cook.hardening, HardeningKind::johnson_cook);
  EXPECT_EQ(
      (std::array{cook.yield_stress, cook.factor, cook.exponent, cook.rate_factor, cook.reference_rate}),
      (std::array{1.0, 2.0, 0.5, 4.0, 5.0}));
}

TEST(PlasticMaterial, HasBackStresses) {
  EXPECT_EQ(material_of(bilinear + ", kinematic: {modulus: 20e9}").plasticity.kinematic,
            (std::vector<study::BackStress>{{20e9, 0}}));
  EXPECT_EQ(
      material_of(bilinear + ", kinematic: [{modulus: 1}, {modulus: 2, recall: 3}]").plasticity.kinematic,
      (std::vector<study::BackStress>{{1, 0}, {2, 3}}));
}

TEST(HyperelasticMaterial, HasItsNumbers) {
  const auto mooney = material_of("law: hyperelastic, c10: 0.4, c01: 0.1, bulk: 100");
  EXPECT_EQ(mooney.hyperelasticity.c10, 0.4);
  EXPECT_EQ(mooney.hyperelasticity.c01, 0.1);
  EXPECT_EQ(mooney.hyperelasticity.bulk, 100);
  EXPECT_EQ(mooney.hyperelasticity.volume, study::VolumeEnergy::logarithmic);
  const auto neo = material_of("law: hyperelastic, c10: 0.4, poisson: 0.49, volumetric: quadratic");
  EXPECT_FALSE(neo.hyperelasticity.bulk);
  EXPECT_EQ(neo.poisson, 0.49);
  EXPECT_EQ(neo.hyperelasticity.volume, study::VolumeEnergy::quadratic);
  const auto yeoh = material_of("law: yeoh, c10: 1, c20: -0.1, c30: 0.01, bulk: 9").hyperelasticity;
  EXPECT_EQ((std::array{yeoh.c10, yeoh.c20, yeoh.c30}), (std::array{1.0, -0.1, 0.01}));
  const auto ogden =
      material_of("law: ogden, terms: [{shear: 2, exponent: 1.3}, {shear: -1, exponent: -2}], bulk: 9");
  EXPECT_EQ(ogden.hyperelasticity.terms, (std::vector<study::OgdenTerm>{{2, 1.3}, {-1, -2}}));
}

TEST(PronyMaterial, HasTerms) {
  EXPECT_EQ(material_of("law: prony, young: 1, poisson: 0.4, terms: [{shear: 2, time: 0.1}]").prony,
            (std::vector<study::PronyTerm>{{2, 0.1}}));
}

TEST(MaterialCells, HaveAStrainAndAFormulation) {
  const auto plain = material_of(bilinear);
  EXPECT_FALSE(plain.strain || plain.formulation);
  const auto material = material_of(bilinear + ", strain: logarithmic, formulation: full");
  EXPECT_EQ(material.strain, StrainKind::logarithmic);
  EXPECT_EQ(material.formulation, Formulation::full);
}

TEST(NonlinearBodies, HaveStepsAndATangentOfTheirOwn) {
  const auto deck =
      replaced(deck_with(bilinear), "end: 0.012", "end: 0.012, max_step: 2e-3, max_plastic_step: 0.01");
  const auto study = parse_one(deck + "newton: {tangent: kept}\n");
  EXPECT_EQ(study.time.max_step, 2e-3);
  EXPECT_EQ(study.time.max_plastic_step, 0.01);
  EXPECT_EQ(study.newton.tangent, study::TangentChoice::kept);
  EXPECT_EQ(parse_one(smallest_deck).newton.tangent, study::TangentChoice::automatic);
}

const char* const sound_materials[] = {
    "law: plastic, young: 200e9, poisson: 0.3, hardening: {linear: {yield_stress: 4e8, tangent_modulus: "
    "5e9}}",
    "law: plastic, young: 200e9, poisson: 0.3, hardening: {table: [[0, 4e8], [0.01, 4e8], [0.02, 5e8]]}, "
    "kinematic: {modulus: 3}",
    "law: plastic, young: 200e9, poisson: 0.3, hardening: {tension_table: [[0.002, 4e8], [0.01, 5e8]]}, "
    "kinematic: [{modulus: 3}, {modulus: 4, recall: 5}], strain: logarithmic",
    "law: plastic, young: 2, poisson: 0, hardening: {voce: {yield_stress: 1, saturation: 2, exponent: 3}}, "
    "formulation: enhanced, strain: small",
    "law: plastic, young: 2, poisson: 0, hardening: {johnson_cook: {yield_stress: 1, factor: 2, exponent: "
    "3}}, "
    "formulation: full, expansion: 1e-5, strain: green_lagrange",
    "law: hyperelastic, c10: 0.4, c01: -0.1, bulk: 100, volumetric: quadratic, expansion: 1e-5",
    "law: hyperelastic, c10: 0.4, poisson: 0, strain: green_lagrange",
    "law: yeoh, c10: 0.4, poisson: 0.49",
    "law: ogden, terms: [{shear: 2, exponent: 1.3}, {shear: -1, exponent: -2}], bulk: 9",
    "law: prony, young: 1, poisson: 0.4, terms: [{shear: 2, time: 0.1}, {shear: 3, time: 1}]",
    "young: 1, poisson: 0.4, strain: green_lagrange, formulation: enhanced",
    "young: 1, poisson: 0.4, strain: logarithmic, formulation: mean_dilatation"};

class SoundMaterial : public testing::TestWithParam<const char*> {};

TEST_P(SoundMaterial, ReadsBackFromItsEcho) {
  const auto study = parse_one(deck_with(GetParam()));
  EXPECT_EQ(parse_echo(study::to_json(study), "echo.json"), study);
}

INSTANTIATE_TEST_SUITE_P(Of, SoundMaterial, testing::ValuesIn(sound_materials));

TEST(StudyEcho, ReadsBackStepsAndTangentsOfNonlinearBodies) {
  const auto deck =
      replaced(deck_with(bilinear), "end: 0.012", "end: 0.012, max_step: 2e-3, max_plastic_step: 0.01");
  const auto study = parse_one(deck + "newton: {tangent: full}\n");
  EXPECT_EQ(parse_echo(study::to_json(study), "echo.json"), study);
}

/// A material with these words has one fault.
struct BadMaterial {
  std::string words;
  std::string sentence;
  std::string lines;
};

void PrintTo(const BadMaterial& bad, std::ostream* out) {
  *out << '"' << bad.words << bad.lines << '"';
}

class MaterialWith : public testing::TestWithParam<BadMaterial> {};

TEST_P(MaterialWith, OneMistakeHasOneSentence) {
  EXPECT_EQ(faults_with(GetParam().words, GetParam().lines), Sentences{GetParam().sentence});
}

const std::string softening = "where the yield stress falls with plastic strain, answers depend on the mesh";
const std::string rubber = "law: hyperelastic, c10: 0.4, bulk: 100";

const BadMaterial bad_plasticity[] = {
    {"law: plastic, young: 200e9, poisson: 0.3", "materials.steel: 'hardening' is missing", ""},
    {steel + "hardening: {}",
     "materials.steel.hardening: found no kind of hardening, expected one of linear, table, tension_table, "
     "voce, "
     "johnson_cook",
     ""},
    {steel + "hardening: {linear: {yield_stress: 1}, table: [[0, 1]]}",
     "materials.steel.hardening: found linear and table, expected one of linear, table, tension_table, voce, "
     "johnson_cook",
     ""},
    {steel + "hardening: {linea: {yield_stress: 1}}",
     "unknown key 'materials.steel.hardening.linea'; did you mean 'linear'?", ""},
    {steel + "hardening: {linear: {modulus: 1}}",
     "materials.steel.hardening.linear: 'yield_stress' is missing", ""},
    {steel + "hardening: {linear: {yield_stress: 0}}",
     "materials.steel.hardening.linear.yield_stress: found '0', expected a number > 0", ""},
    {steel + "hardening: {linear: {yield_stress: 1, modulus: -2}}",
     "materials.steel.hardening.linear.modulus: found '-2', expected a number >= 0: " + softening, ""},
    {steel + "hardening: {linear: {yield_stress: 1, modulus: 1, tangent_modulus: 1}}",
     "materials.steel.hardening.linear.modulus: 'tangent_modulus' is given already, expected one of the two",
     ""},
    {steel + "hardening: {linear: {yield_stress: 1, tangent_modulus: 200e9}}",
     "materials.steel.hardening.linear.tangent_modulus: found 200000000000, expected less than Young's "
     "modulus, "
     "200000000000",
     ""},
    {steel + "hardening: {linear: {yield_stress: 1, tangent_modulus: -1}}",
     "materials.steel.hardening.linear.tangent_modulus: found '-1', expected a number >= 0", ""},
    {steel + "hardening: {table: []}",
     "materials.steel.hardening.table: found no point, expected at least one", ""},
    {steel + "hardening: {table: [[0.1, 1]]}",
     "materials.steel.hardening.table.0.0: found 0.1, expected 0: the first point has the yield stress "
     "without "
     "plastic strain",
     ""},
    {steel + "hardening: {table: [[0, 1], [0.2, 2], [0.1, 3]]}",
     "materials.steel.hardening.table.2.0: found 0.1 after 0.2, expected numbers that ascend", ""},
    {steel + "hardening: {table: [[0, 2], [0.2, 1]]}",
     "materials.steel.hardening.table.1.1: found 1 after 2, expected stresses that do not fall: " + softening,
     ""},
    {steel + "hardening: {table: [[0, 0], [0.2, 1]]}",
     "materials.steel.hardening.table.0.1: found '0', expected a number > 0", ""},
    {steel + "hardening: {table: [[0, 1, 2]]}",
     "materials.steel.hardening.table.0: found 3 numbers, expected two", ""},
    {steel + "hardening: {tension_table: [[0.003, 400e6]]}",
     "materials.steel.hardening.tension_table.0.0: found 0.003 with the stress 400000000, expected the "
     "strain of "
     "Young's modulus there, 0.002",
     ""},
    {steel + "hardening: {tension_table: [[0.002, 400e6], [0.0025, 500e6]]}",
     "materials.steel.hardening.tension_table.1.0: found 0.0025 with the stress 500000000, whose plastic "
     "part 0 is "
     "not more than that of the point before, 0",
     ""},
    {steel + "hardening: {voce: {yield_stress: 1, saturation: -1, exponent: 2}}",
     "materials.steel.hardening.voce.saturation: found '-1', expected a number >= 0: " + softening, ""},
    {steel + "hardening: {voce: {yield_stress: 1, saturation: 1, exponent: -2}}",
     "materials.steel.hardening.voce.exponent: found '-2', expected a number >= 0", ""},
    {steel + "hardening: {johnson_cook: {yield_stress: 1, factor: 1, exponent: 0}}",
     "materials.steel.hardening.johnson_cook.exponent: found '0', expected a number > 0", ""},
    {steel + "hardening: {johnson_cook: {yield_stress: 1, factor: 1, exponent: 1, reference_rate: x}}",
     "materials.steel.hardening.johnson_cook.reference_rate: found 'x', expected a number > 0", ""},
    {bilinear + ", kinematic: {modulus: -1}",
     "materials.steel.kinematic.modulus: found '-1', expected a number >= 0", ""},
    {bilinear + ", kinematic: [{modulus: 1}, {modulus: 1, recall: -1}]",
     "materials.steel.kinematic.1.recall: found '-1', expected a number >= 0", ""},
    {bilinear + ", kinematic: [{modulus: 1}, {modulus: 1}, {modulus: 1}, {modulus: 1}]",
     "materials.steel.kinematic: found 4 back stresses, expected at most 3", ""},
    {"law: plastic, young: 1+x, poisson: 0.3, hardening: {linear: {yield_stress: 1}}",
     "materials.steel.young: depends on the place, but the law plastic has the same numbers everywhere; "
     "expected a "
     "number",
     ""},
    {"young: 1, poisson: 0.3, hardening: {linear: {yield_stress: 1}}",
     "materials.steel.hardening: the law elastic takes no hardening, plastic takes it; a run removes it by "
     "'hardening: ~'",
     ""},
    {"young: 1, poisson: 0.3, terms: []",
     "materials.steel.terms: the law elastic takes no terms, prony and ogden take it; a run removes it by "
     "'terms: "
     "~'",
     ""},
};
INSTANTIATE_TEST_SUITE_P(Plastic, MaterialWith, testing::ValuesIn(bad_plasticity));

const BadMaterial bad_rubber[] = {
    {"law: hyperelastic, c10: 0.4",
     "materials.steel: neither 'bulk' nor 'poisson' is given, expected one of them: the law hyperelastic "
     "does not "
     "hold the volume by itself",
     ""},
    {rubber + ", poisson: 0.4", "materials.steel.poisson: 'bulk' is given already, expected one of the two",
     ""},
    {"law: hyperelastic, c10: 0.4, poisson: 0.5",
     "materials.steel.poisson: found '0.5', expected a number between -1 and 0.5: write 'bulk' instead, a "
     "large "
     "multiple of the shear modulus where the volume hardly changes",
     ""},
    {"law: hyperelastic, c10: 0.4, bulk: 0", "materials.steel.bulk: found '0', expected a number > 0", ""},
    {"law: hyperelastic, c10: 0.4, c01: -0.5, bulk: 1",
     "materials.steel.c10: c10 + c01 is -0.1, expected more than 0: it is half the shear modulus at small "
     "strain",
     ""},
    {rubber + ", volumetric: aster",
     "materials.steel.volumetric: found 'aster', expected one of logarithmic, quadratic", ""},
    {"law: yeoh, c10: 0, bulk: 1", "materials.steel.c10: found '0', expected a number > 0", ""},
    {"law: yeoh, c10: 1, c30: -1, bulk: 1", "materials.steel.c30: found '-1', expected a number >= 0", ""},
    {"law: ogden, bulk: 1", "materials.steel: 'terms' is missing", ""},
    {"law: ogden, bulk: 1, terms: []", "materials.steel.terms: found no term, expected at least one", ""},
    {"law: ogden, bulk: 1, terms: [{shear: 1, exponent: 2}, {shear: -3, exponent: 1}]",
     "materials.steel.terms: the sum of 'shear' is -2, expected more than 0: it is the shear modulus at "
     "small "
     "strain",
     ""},
    {"law: ogden, bulk: 1, terms: [{shear: 1, exponent: 0}]",
     "materials.steel.terms.0.exponent: found 0, whose term has no stress", ""},
    {"law: ogden, bulk: 1, terms: [{shear: 1, exponent: 2, time: 1}]",
     "materials.steel.terms.0.time: the law ogden takes no time, expected shear and exponent", ""},
    {"law: prony, young: 1, poisson: 0.3, terms: [{shear: 1}]", "materials.steel.terms.0: 'time' is missing",
     ""},
    {"law: prony, young: 1, poisson: 0.3, terms: [{shear: 0, time: 1}]",
     "materials.steel.terms.0.shear: found '0', expected a number > 0", ""},
    {"law: prony, young: 1, poisson: 0.3, terms: [{shear: 1, time: 1}, {shear: 1, time: 0}]",
     "materials.steel.terms.1.time: found '0', expected a number > 0", ""},
    {rubber + ", expansion: [1e-5, 2e-5, 1e-5]",
     "materials.steel.expansion: found different coefficients, but hyperelastic materials expand alike in "
     "all "
     "directions; expected one number, or the law orthotropic",
     ""},
};
INSTANTIATE_TEST_SUITE_P(Rubber, MaterialWith, testing::ValuesIn(bad_rubber));

const std::string wood =
    "law: orthotropic, young_x: 9, young_y: 4, young_z: 1, poisson_xy: 0.3, poisson_yz: 0.2, "
    "poisson_xz: 0.1, shear_xy: 3, shear_yz: 2, shear_xz: 1";
const std::string elastic = "young: 1, poisson: 0.3";

const BadMaterial bad_cells[] = {
    {rubber + ", strain: small",
     "materials.steel.strain: the law hyperelastic takes no small strain, expected green_lagrange", ""},
    {"law: prony, young: 1, poisson: 0.4, terms: [{shear: 2, time: 1}], strain: green_lagrange",
     "materials.steel.strain: the law prony takes no green_lagrange strain, expected small or logarithmic",
     ""},
    {wood + ", strain: logarithmic",
     "materials.steel.strain: the law orthotropic takes no logarithmic strain, expected small or "
     "green_lagrange",
     ""},
    {elastic + ", strain: large",
     "materials.steel.strain: found 'large', expected one of small, green_lagrange, logarithmic", ""},
    {elastic + ", formulation: enhance",
     "materials.steel.formulation: found 'enhance', expected one of full, mean_dilatation, enhanced, "
     "reduced; did you mean 'enhanced'?",
     ""},
    {"young: 1+x, poisson: 0.3, formulation: reduced",
     "materials.steel.young: depends on the place, which reduced cells cannot; expected a number", ""},
    {rubber + ", formulation: enhanced",
     "materials.steel.formulation: enhanced cells grow hourglasses under large compression with the law "
     "hyperelastic, expected mean_dilatation",
     ""},
    {bilinear + ", formulation: enhanced, strain: logarithmic",
     "materials.steel.formulation: enhanced cells grow hourglasses under large compression with logarithmic "
     "strain, expected mean_dilatation",
     ""},
    {wood + ", strain: green_lagrange, axes: {cylindrical: {point: [0, 0, 0], direction: [0, 0, 1]}}",
     "materials.steel.axes: axes that turn with the place do not go with green_lagrange strain, expected "
     "angles "
     "alone",
     ""},
    {"young: 1+x, poisson: 0.3, strain: logarithmic",
     "materials.steel.young: depends on the place, which logarithmic strain cannot; expected a number", ""},
    {"young: 1+x, poisson: 0.3, formulation: enhanced",
     "materials.steel.young: depends on the place, which enhanced cells cannot; expected a number", ""},
    {elastic,
     "newton.tangent: has no effect, as every material is linear and its matrix is factored once; expected "
     "auto",
     "newton: {tangent: kept}\n"},
    {bilinear, "newton.tangent: found 'old', expected one of auto, full, kept", "newton: {tangent: old}\n"},
};
INSTANTIATE_TEST_SUITE_P(Cells, MaterialWith, testing::ValuesIn(bad_cells));

TEST(NonlinearMaterials, LetDensityDependOnThePlace) {
  EXPECT_EQ(faults_of(replaced(deck_with(bilinear), "7800", "7800+x")), Sentences{});
}

TEST(PlaneStress, HasNoMeanDilatation) {
  const auto deck = replaced(deck_with(bilinear + ", formulation: mean_dilatation"), "solid", "plane_stress");
  EXPECT_EQ(faults_of(deck).size(), 1U);
  EXPECT_NE(faults_of(deck).at(0).find("materials.steel.formulation: plane_stress has no mean_dilatation"),
            std::string::npos);
}

/// Of the smallest deck with this material and these words of time after its end.
Sentences faults_of_steps(const std::string& material, const std::string& words) {
  Sentences sentences;
  for (const auto& sentence : faults_of(replaced(deck_with(material), "end: 0.012", "end: 0.012, " + words)))
    sentences.push_back(sentence.substr(sentence.find(": ") + 2));
  return sentences;
}

TEST(StepsOfNonlinearBodies, AreJudged) {
  EXPECT_EQ(faults_of_steps(bilinear, "max_step: 0"),
            (Sentences{"time.max_step: found '0', expected a number > 0"}));
  EXPECT_EQ(faults_of_steps(bilinear, "max_step: 1e-4"),
            (Sentences{"time.max_step: found 0.0001, expected at least the step, 0.001"}));
  EXPECT_EQ(faults_of_steps(bilinear, "max_plastic_step: -1"),
            (Sentences{"time.max_plastic_step: found '-1', expected a number > 0"}));
  EXPECT_EQ(
      faults_of_steps(elastic, "max_step: 0.01"),
      (Sentences{"time.max_step: has no effect, as every material is linear; steps grow with nonlinear ones "
                 "only"}));
  EXPECT_EQ(
      faults_of_steps(rubber, "max_plastic_step: 0.01"),
      (Sentences{"time.max_plastic_step: has no effect, as no material is plastic; expected the law plastic "
                 "in a material"}));
}

TEST(EnergyMomentum, IsForLawsThatDissipateNothing) {
  const auto with = [](const std::string& material, const std::string& more = "") {
    Sentences sentences;
    for (const auto& sentence :
         faults_of(replaced(deck_with(material), "scheme: newmark", "scheme: energy_momentum" + more)))
      sentences.push_back(sentence.substr(sentence.find(": ") + 2));
    return sentences;
  };
  for (const auto& material : {elastic, elastic + ", strain: logarithmic", rubber,
                               elastic + ", strain: green_lagrange, formulation: enhanced"})
    EXPECT_EQ(with(material), Sentences{}) << material;
  EXPECT_EQ(with(elastic, ", max_step: 2e-3"),
            (Sentences{"time.max_step: has no effect, as every material is linear; steps grow with nonlinear "
                       "ones only"}));
  EXPECT_EQ(with(bilinear),
            (Sentences{"materials.steel.law: the scheme energy_momentum is for bodies that store all that is "
                       "done to them, and the law plastic dissipates; expected moreau_jean, whose error in "
                       "finite strain energy.csv tells as bulk_scheme"}));
  EXPECT_EQ(with(elastic, ", theta: 0.7"),
            (Sentences{"time.theta: the scheme energy_momentum takes no theta, moreau_jean takes it; a run "
                       "removes it by 'theta: ~'"}));
  EXPECT_EQ(with(elastic, ", mass_scaling: {step: 1}"),
            (Sentences{"time.mass_scaling: the scheme energy_momentum has no step that is too long for a "
                       "cell; central_difference takes it"}));
}

TEST(ExplicitRuns, HaveNeitherTangentNorStepControl) {
  const auto with = [](const std::string& material, const std::string& time, const std::string& lines) {
    Sentences sentences;
    const auto deck = replaced(deck_with(material, lines), "newmark, step: 1e-3, end: 0.012",
                               "central_difference, step: auto, end: 0.012, " + time);
    for (const auto& sentence : faults_of(deck))
      sentences.push_back(sentence.substr(sentence.find(": ") + 2));
    return sentences;
  };
  EXPECT_EQ(with(bilinear, "record: 1e-3", ""), Sentences{});
  EXPECT_EQ(with(elastic + ", formulation: enhanced", "record: 1e-3", ""), Sentences{});
  EXPECT_EQ(with(bilinear, "max_step: 1e-3", ""),
            (Sentences{"time.max_step: the scheme central_difference chooses its steps by what is stable"}));
  EXPECT_EQ(with(bilinear, "record: 1e-3", "newton: {tangent: full}\n"),
            (Sentences{"newton.tangent: the scheme central_difference solves no system, expected auto"}));
  EXPECT_EQ(
      with(bilinear + ", formulation: enhanced", "record: 1e-3", ""),
      (Sentences{"materials.steel.formulation: the scheme central_difference takes enhanced cells of linear "
                 "materials at small strain only, expected mean_dilatation"}));
}

} // namespace
} // namespace rubato::deck::laws_test
