// SPDX-License-Identifier: LGPL-3.0-or-later
// Two small runs, with and without friction, side by side.
#include "rubato/deck/read.hpp"
#include "rubato/results/compare.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/stored_run.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/study/stored_fields.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <array>
#include <cmath>

namespace rubato::results::compare_test {
namespace {

using test::fault_of;

const std::string stored = "fields: {formats: [med], at: [1e-4, 2e-4]}\n";

class TwoRuns : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::ScratchFolder>();
    run("rough", {});
    run("smooth", {{"contact.interface.friction", "0"}});
    run("fine", {{"mesh.refine", "2"}});
    run("silent", {{"fields", "~"}});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void run(const std::string& name, const std::vector<deck::Setting>& settings) {
    const auto deck = deck::parse_deck(test::two_blocks + stored, "deck.yaml", settings);
    run::run_study(deck.runs.front(), *folder_ / name, {});
  }
  static std::filesystem::path of(const std::string& name) { return *folder_ / name; }
  static FieldComparison compared(const std::string& field = "displacement", double at = 2e-4) {
    return compare_fields(of("rough"), of("smooth"), field, at);
  }
  static std::string fault(const std::string& a, const std::string& b, const std::string& field, double at) {
    return fault_of([&] { compare_fields(of(a), of(b), field, at); });
  }

  static inline std::unique_ptr<test::ScratchFolder> folder_;
};

TEST_F(TwoRuns, DifferByWhatTheirStoredFieldsDifferBy) {
  const auto fields = compared();
  const auto a = read_med_field(of("rough") / "fields.med", "displacement", 2);
  const auto b = read_med_field(of("smooth") / "fields.med", "displacement", 2);
  EXPECT_EQ(fields.components, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(fields.mesh.node_count(), 30);
  ASSERT_EQ(fields.difference.size(), 60U);
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(fields.difference[i], a[i] - b[i]);
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  EXPECT_GT(largest, 0);
}

TEST_F(TwoRuns, DifferMostWhereTheirLargestDifferenceIs) {
  const auto fields = compared();
  const auto parts = extents(fields, all_nodes(fields.mesh));
  ASSERT_EQ(parts.size(), 2U);
  for (std::size_t c = 0; c < 2; ++c) {
    double largest = 0, squares = 0, largest_a = 0;
    for (std::size_t node = 0; node < 30; ++node) {
      const double d = fields.difference[2 * node + c];
      largest = std::max(largest, std::abs(d));
      squares += d * d;
      largest_a = std::max(largest_a, std::abs(fields.a[2 * node + c]));
    }
    EXPECT_EQ(std::abs(parts[c].difference), largest);
    EXPECT_EQ(parts[c].difference, fields.difference[2 * static_cast<std::size_t>(parts[c].node) + c]);
    EXPECT_DOUBLE_EQ(parts[c].rms, std::sqrt(squares / 30));
    EXPECT_EQ(parts[c].largest_a, largest_a);
  }
}

TEST_F(TwoRuns, AreComparedOverAGroupOrAtANode) {
  const auto fields = compared();
  for (const auto& part : extents(fields, nodes_of(fields.mesh, "held"))) {
    EXPECT_EQ(part.difference, 0);
    EXPECT_EQ(part.largest_b, 0);
  }
  const auto tip = nodes_of(fields.mesh, "tip");
  ASSERT_EQ(tip.size(), 1U);
  EXPECT_EQ(tip, nodes_of(fields.mesh, "N15"));
  const auto parts = extents(fields, tip);
  EXPECT_EQ(parts[1].difference, fields.difference[2 * 14 + 1]);
  EXPECT_EQ(parts[1].rms, std::abs(parts[1].difference));
}

TEST_F(TwoRuns, CompareScalarFieldsWithoutANameOfTheirComponent) {
  const auto fields = compared("contact_pressure");
  EXPECT_EQ(fields.components, std::vector<std::string>{""});
  EXPECT_GT(extents(fields, all_nodes(fields.mesh)).at(0).largest_a, 0);
}

TEST_F(TwoRuns, AreNotDifferentFromThemselves) {
  const auto fields = compare_fields(of("rough"), of("rough"), "stress", 1e-4);
  for (const auto& part : extents(fields, all_nodes(fields.mesh)))
    EXPECT_EQ(part.difference, 0) << part.component;
}

TEST_F(TwoRuns, AreWrittenForParaView) {
  const auto file = of("difference.vtu");
  write_vtu(file, compared());
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (const auto* name : {"displacement_difference", "displacement_A", "displacement_B"})
    EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

TEST_F(TwoRuns, AreRefusedWithOneSentence) {
  const auto rough = of("rough").string();
  EXPECT_EQ(fault("none", "rough", "displacement", 2e-4),
            of("none").string() + ": found no run.json, expected the folder of a run");
  EXPECT_EQ(fault("rough", "smooth", "displacment", 2e-4),
            rough + ": no field is called 'displacment'; did you mean 'displacement'?");
  EXPECT_EQ(fault("rough", "smooth", "displacement", 1.5e-4),
            rough + ": holds no displacement at t = 0.00015; the nearest stored are 0.0001 and 0.0002");
  EXPECT_EQ(fault("rough", "smooth", "displacement", 1),
            rough + ": holds no displacement at t = 1; the nearest stored is 0.0004");
  EXPECT_EQ(fault("rough", "silent", "displacement", 2e-4),
            of("silent").string() + ": holds no fields that can be read back, expected a run with 'fields: "
                                    "{formats: [med], at: [0.0002]}'");
  EXPECT_EQ(fault("rough", "fine", "displacement", 2e-4),
            rough + " and " + of("fine").string() +
                " have different meshes: 30 nodes and 32 cells against 90 and 96");
  const auto mesh = compared().mesh;
  EXPECT_NE(fault_of([&] { nodes_of(mesh, "hold"); }).find("did you mean 'held'?"), std::string::npos);
}

TEST_F(TwoRuns, StoreTheFieldsThatDecksMayName) {
  const auto fields = med_fields(of("rough") / "fields.med");
  auto usual = study::stored_fields(2);
  std::erase_if(usual, [](const study::StoredField& field) {
    // Those are of runs with temperatures, and with bodies that yield.
    return !field.usual || field.name == "temperature" || field.name == "cumulated_plastic_strain";
  });
  for (const auto& known : usual) {
    const auto found = std::ranges::find(fields, known.name, &MedField::name);
    ASSERT_NE(found, fields.end()) << known.name;
    EXPECT_EQ(found->component_names,
              known.components.empty() ? std::vector<std::string>{"1"} : known.components)
        << known.name;
  }
  EXPECT_EQ(fields.size(), usual.size());
}

// ---- histories

const Table coarse{{"t", "tip.x", "tip.y"}, {{0, 0, 0}, {0.2, 0, -2}, {0.4, 0, -5}}};
const Table dense{{"t", "tip.x", "tip.y"},
                  {{0, 0, 0}, {0.1, 0, -1}, {0.1 + 0.1, 0, -2.5}, {0.3, 0, -3}, {0.4, 1, -5.2}}};

TEST(Histories, AreComparedAtTheInstantsThatBothHave) {
  const auto found = compare_histories(coarse, dense, "tip");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].quantity, "tip.x");
  EXPECT_EQ(found[0].difference(), -1);
  EXPECT_EQ(found[0].at, 0.4);
  EXPECT_EQ(found[1].instants, 3);
  EXPECT_EQ(found[1].at, 0.2);
  EXPECT_EQ(found[1].difference(), 0.5);
  EXPECT_EQ(found[1].largest_a, 5);
}

TEST(Histories, AreComparedAtOneInstantBetweenRowsToo) {
  const auto found = compare_histories(coarse, dense, "tip.y", 0.3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].difference(), -3.5 + 3, 1e-14);
}

TEST(Histories, AreRefusedWithoutTheProbeOrTheInstant) {
  const Table other{{"t", "end.y"}, {{0, 1}}};
  const Table elsewhere{{"t", "tip.y"}, {{0.05, 1}}};
  EXPECT_EQ(fault_of([&] { compare_histories(coarse, dense, "tp"); }),
            "run A: no probe is called 'tp'; did you mean 'tip'?");
  EXPECT_EQ(fault_of([&] { compare_histories(coarse, other, "tip"); }),
            "run B: no probe is called 'tip'; there are end");
  EXPECT_EQ(fault_of([&] { compare_histories(coarse, dense, "tip", 0.5); }),
            "run A: goes from t = 0 to 0.4, which does not reach 0.5");
  EXPECT_EQ(fault_of([&] { compare_histories(coarse, elsewhere, "tip"); }),
            "the two runs have no instant in common, expected one where both are compared");
  EXPECT_EQ(fault_of([&] { compare_histories({{"t"}, {{0.0}}}, dense, "tip"); }), "run A: found no probes");
}

} // namespace
} // namespace rubato::results::compare_test
