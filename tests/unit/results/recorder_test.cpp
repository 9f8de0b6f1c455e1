// SPDX-License-Identifier: LGPL-3.0-or-later
// What a small run leaves in its folder.
#include "rubato/constraint/reduction.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/recorder.hpp"
#include "rubato/results/stored_run.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace rubato::results::recorder_test {
namespace {

using test::two_blocks;
using test::with;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

double last(const Table& table, const std::string& column) {
  return table.rows.back().at(static_cast<std::size_t>(table.column(column)));
}

class RunFolder : public testing::Test {
protected:
  run::RunResult run(const std::string& deck, const run::Watch& watch = {}) const {
    return run::run_study(deck::parse_deck(deck, "deck.yaml").runs.front(), folder_.path(), watch);
  }

  Table table(const std::string& file) const { return read_csv(folder_ / file); }
  nlohmann::json summary() const { return nlohmann::json::parse(text_of(folder_ / "run.json")); }

  test::ScratchFolder folder_;
};

TEST_F(RunFolder, HoldsHistoriesStepsAndASummary) {
  const auto result = run(two_blocks + "checks: [{probe: end.y, at: 2e-4, reference: 1, tolerance: 0.1}]\n");
  EXPECT_EQ(names_in(folder_.path()),
            (std::vector<std::string>{"checkpoint.h5", "contact_interface.csv", "energy.csv", "probes.csv",
                                      "resultants_interface.csv", "run.json", "steps.jsonl"}));
  const auto probes = table("probes.csv");
  EXPECT_EQ(probes.columns, (std::vector<std::string>{"t", "end.x", "end.y"}));
  ASSERT_EQ(probes.rows.size(), 5U);
  EXPECT_EQ(probes.rows.front(), (std::vector<double>{0, 0, 0}));
  EXPECT_DOUBLE_EQ(probes.rows.back()[0], 4e-4);
  EXPECT_EQ(table("resultants_interface.csv").columns,
            (std::vector<std::string>{"t", "in_contact", "sticking", "force.x", "force.y", "normal",
                                      "friction", "largest_pressure", "smallest_gap"}));
  const auto steps = text_of(folder_ / "steps.jsonl");
  EXPECT_EQ(std::ranges::count(steps, '\n'), 4);
  EXPECT_TRUE(nlohmann::json::parse(steps.substr(0, steps.find('\n'))).at("accepted"));

  const auto json = summary();
  EXPECT_EQ(json.at("status"), "complete");
  EXPECT_EQ(json.at("steps"), result.steps);
  EXPECT_EQ(json.at("iterations"), result.iterations);
  EXPECT_EQ(json.at("unknowns"), 48);
  EXPECT_EQ(json.at("checks").at(0).at("holds"), false);
  EXPECT_EQ(json.at("study").at("thickness"), 1.0);
}

TEST_F(RunFolder, KeepsTheWarningsOfTheRunThroughAResumeToo) {
  std::vector<std::string> warned;
  run::Watch watch;
  watch.warn = [&](const std::string& text) { warned.push_back(text); };
  auto deck = with(two_blocks, "{scheme: hht, alpha: -0.1", "{scheme: newmark");
  run(deck, watch);
  ASSERT_FALSE(warned.empty()) << "newmark gains energy in contact";
  EXPECT_EQ(summary().at("warnings"), nlohmann::json(warned));

  const auto study = deck::parse_deck(with(deck, "end: 4e-4", "end: 6e-4"), "deck.yaml").runs.front();
  run::run_study(study, folder_.path(), {}, nullptr, run::Begin::resumed);
  EXPECT_EQ(summary().at("steps"), 6);
  EXPECT_EQ(stored_warnings(folder_.path()).front(), warned.front());
}

/// Programs that knew linear bodies only began tables with fewer columns.
TEST_F(RunFolder, GoesOnWithTheEnergiesThatItsTableHas) {
  const test::BuiltModel model(deck::parse_deck(two_blocks, "deck.yaml").runs.front());
  auto position = Recorder(model, folder_.path()).position();
  const step::EnergyLedger ledger{.kinetic = 3, .strain = 4, .impact = 6, .start = 13};
  const std::string old = "t,kinetic,strain,impact,balance\n0,1,2,-3,0\n";
  std::ofstream(folder_ / "energy.csv") << old;
  position.energy = old.size();
  Recorder(model, folder_.path(), position).energy(1, ledger);
  EXPECT_EQ(table("energy.csv").rows, (std::vector<std::vector<double>>{{0, 1, 2, -3, 0}, {1, 3, 4, 6, 0}}));

  const std::string other = "t,kinetic,magic\n";
  std::ofstream(folder_ / "energy.csv") << other;
  position.energy = other.size();
  EXPECT_EQ(test::fault_of([&] { Recorder(model, folder_.path(), position); }),
            "energy.csv: found the column 'magic', expected energies that this program knows");
}

TEST_F(RunFolder, HasTheWholeLedger) {
  ASSERT_EQ(run(two_blocks).status, RunStatus::complete);
  const auto energy = table("energy.csv");
  EXPECT_EQ(energy.columns, (std::vector<std::string>{
                                "t", "kinetic", "strain", "external_work", "support_work", "overlap_work",
                                "heat", "damping", "contact", "friction", "plastic", "back_stress", "viscous",
                                "hourglass", "impact", "numerical", "bulk_scheme", "unbalanced", "balance"}));
  EXPECT_GT(last(energy, "strain"), 0);
  for (const auto* none : {"plastic", "back_stress", "viscous", "hourglass", "bulk_scheme"})
    EXPECT_EQ(last(energy, none), 0) << none;
}

/// Whatever makes the steps.
TEST_F(RunFolder, HasFieldsAtEveryInstantThatIsNamed) {
  const std::string wanted = "fields: {formats: [vtu], at: [1.25e-4, 2e-4, 3.1e-4], last: false}\n";
  const std::string hht = "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}";
  for (const auto& time : {hht, std::string("{scheme: static, step: 1e-4, end: 4e-4}"),
                           std::string("{scheme: hht, alpha: -0.1, instants: [1e-4, 4e-4]}"),
                           std::string("{scheme: central_difference, end: 4e-4, record: 1e-4}")}) {
    auto deck = with(two_blocks, hht, time) + wanted;
    if (time.find("central") != std::string::npos)
      deck = with(deck, "friction: 0.2", "friction: 0.2, method: penalty");
    std::vector<double> reached;
    run::Watch watch;
    watch.progress = [&](const run::Progress& progress) { reached.push_back(progress.t); };
    ASSERT_EQ(run(deck, watch).status, RunStatus::complete) << time;
    EXPECT_TRUE(std::ranges::is_sorted(reached));
    EXPECT_EQ(reached.back(), 4e-4);
    const auto series = text_of(folder_ / "fields.pvd");
    EXPECT_EQ(std::ranges::count(series, '\n'), 3 + 3 + 2) << time << series;
    for (const auto* instant : {"\"0.000125\"", "\"0.0002\"", "\"0.00031\""})
      EXPECT_NE(series.find(instant), std::string::npos) << time << series;
  }
}

TEST_F(RunFolder, HoldsWhatIsTakenOfTheNodesOfAGroup) {
  const auto probes = R"(  end: {node: tip}
  a: {point: [0, -0.2], field: reaction}
  b: {point: [0, -0.1], field: reaction}
  sum: {on: held, take: sum, field: reaction}
  mean: {on: roof, take: mean}
  least: {on: roof, take: min}
  most: {on: roof, take: max}
)";
  const auto checks = "checks: [{probe: least.y, at: 2e-4, reference: -1e-9, tolerance: 1}]\n";
  const auto result = run(with(two_blocks, "  end: {node: tip}\n", probes) + checks);
  ASSERT_EQ(result.status, RunStatus::complete);
  const auto history = table("probes.csv");
  EXPECT_EQ(history.column("mean.y"), history.column("mean.x") + 1);
  EXPECT_LT(last(history, "least.y"), last(history, "mean.y"));
  EXPECT_LT(last(history, "mean.y"), last(history, "most.y"));
  EXPECT_GE(last(history, "most.y"), 0) << "its corner is held";
  EXPECT_LE(last(history, "least.y"), last(history, "end.y"));
  const test::BuiltModel model(deck::parse_deck(two_blocks, "deck.yaml").runs.front());
  double sum = 0;
  for (const auto& support : model.reduction.prescribed())
    if (support.dof % 2 == 1)
      sum += result.end.reaction[support.dof];
  EXPECT_NEAR(last(history, "sum.y"), sum, 1e-12 * std::abs(sum));
  EXPECT_NE(sum, 0);
  ASSERT_EQ(result.checks.size(), 1U);
  EXPECT_EQ(result.checks[0].value,
            history.rows.at(2).at(static_cast<std::size_t>(history.column("least.y"))));
}

TEST_F(RunFolder, WarnsOfAPointThatSeveralNodesAreEquallyNearTo) {
  std::vector<std::string> warnings;
  run::Watch watch;
  watch.warn = [&](const std::string& text) { warnings.push_back(text); };
  run(with(two_blocks, "  end: {node: tip}", "  mid: {point: [0.5, 0]}\n  end: {point: [1, 0.2]}"), watch);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(
      warnings[0],
      "run: probe 'mid': 2 nodes are equally near to its point, N3 (0.5, 0), N28 (0.5, 0); N3 is taken, "
      "'node: N3' instead of the point, or another one of them, says which is meant");
}

TEST_F(RunFolder, IsReadBackAsTheStudyAndItsHistory) {
  const auto deck = two_blocks + "checks: [{probe: end.y, at: 2e-4, reference: 1, tolerance: 0.1}]\n";
  const auto result = run(deck);
  const auto stored = read_stored_run(folder_.path());
  EXPECT_EQ(stored.status, RunStatus::complete);
  const auto study = deck::parse_deck(deck, "deck.yaml").runs.front();
  EXPECT_EQ(deck::parse_echo(stored.study, "run.json"), study);
  const auto again = evaluate_checks(study.checks, stored.probes);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].value, result.checks[0].value);
  EXPECT_EQ(again[0].deviation, result.checks[0].deviation);
}

/// The other runs are in folders beside it.
TEST_F(RunFolder, IsComparedWithTheFoldersBesideIt) {
  const auto deck = deck::parse_deck(two_blocks + R"(fields: {formats: [med], at: [2e-4]}
runs:
  rough: {}
  smooth:
    contact: {interface: {friction: 0}}
    checks:
      - {probe: end.y, at: 2e-4, run: rough, tolerance: 1, note: hardly}
      - {field: displacement.x, on: lower_face, at: 2e-4, run: rough, tolerance: 1e-30, kind: absolute}
)",
                                     "deck.yaml");
  std::vector<CheckResult> checks;
  for (const auto& study : deck.runs)
    checks = run::run_study(study, folder_ / study.name, {}).checks;
  ASSERT_EQ(checks.size(), 2U);
  const auto y = [&](const std::string& name) {
    return read_csv(folder_ / name / "probes.csv").rows.at(2).at(2);
  };
  EXPECT_EQ(checks[0].value, y("smooth") - y("rough"));
  EXPECT_DOUBLE_EQ(checks[0].deviation, std::abs(y("smooth") - y("rough")) / std::abs(y("rough")));
  EXPECT_TRUE(checks[0].holds);
  EXPECT_EQ(checks[1].quantity, "displacement.x on lower_face");
  EXPECT_GT(std::abs(checks[1].value.value()), 1e-12);
  EXPECT_EQ(checks[1].deviation, std::abs(*checks[1].value));
  EXPECT_FALSE(checks[1].holds);

  const auto json = nlohmann::json::parse(text_of(folder_ / "smooth/run.json")).at("checks").at(1);
  EXPECT_EQ(json.at("run"), "rough");
  EXPECT_TRUE(json.at("where").get<std::string>().starts_with("N")) << json;
  const auto stored = read_stored_run(folder_ / "smooth");
  EXPECT_EQ(stored.name, deck.runs[1].name);
  EXPECT_EQ(nlohmann::json::parse(stored.study), nlohmann::json::parse(study::to_json(deck.runs[1])));
  const auto again = evaluate_checks(deck.runs[1].checks, stored.probes, folder_ / "smooth");
  EXPECT_EQ(again[0].value, checks[0].value);
  EXPECT_EQ(again[1].value, checks[1].value);

  std::filesystem::remove_all(folder_ / "rough");
  const auto alone = evaluate_checks(deck.runs[1].checks, stored.probes, folder_ / "smooth");
  EXPECT_FALSE(alone[0].holds);
  EXPECT_NE(to_text(alone).find("(run rough has no folder beside this one)"), std::string::npos);
}

TEST_F(RunFolder, RecordsEveryKindOfProbe) {
  const std::string probes = "  v: {node: tip, field: velocity}\n  a: {node: tip, field: acceleration}\n"
                             "  r: {point: [0, 0.2], field: reaction}\n";
  run(two_blocks + probes);
  const auto history = table("probes.csv");
  EXPECT_EQ(history.columns.size(), 9U);
  EXPECT_LT(last(history, "v.y"), 0);
  EXPECT_NE(last(history, "a.y"), 0);
  EXPECT_NE(last(history, "r.y"), 0);
}

/// At rest the supports carry what the load and the other body push with.
TEST_F(RunFolder, BalancesContactWithLoadsAndReactions) {
  auto deck = with(two_blocks, "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}",
                   "{scheme: static, step: 1, end: 1}");
  deck = with(deck, "nodal_force: {on: tip, y: -1e7}", "surface_force: {on: roof, x: 1e5, y: -1e6}");
  std::string probes;
  for (const auto* y : {"-0.2", "-0.1", "0"})
    probes += std::string("  at") + std::to_string(probes.size()) + ": {node: N" +
              (y == std::string("-0.2")   ? "16"
               : y == std::string("-0.1") ? "21"
                                          : "26") +
              ", field: reaction}\n";
  run(deck + probes);
  const auto contact = table("resultants_interface.csv");
  const auto history = table("probes.csv");
  for (const auto* axis : {"x", "y"}) {
    double reaction = 0;
    for (std::size_t c = 0; c < history.columns.size(); ++c)
      if (history.columns[c].starts_with("at") && history.columns[c].ends_with(axis))
        reaction += history.rows.back()[c];
    EXPECT_NEAR(last(contact, std::string("force.") + axis), -reaction, 1e-7 * 1e6) << axis;
  }
  EXPECT_LT(last(contact, "force.y"), -1e5) << "the upper body presses on the lower one, the slave";
  EXPECT_NEAR(last(contact, "normal"), std::abs(last(contact, "force.y")), 0.05 * last(contact, "normal"));
  EXPECT_LE(last(contact, "friction"), 0.2 * last(contact, "normal") * (1 + 1e-12));
}

TEST_F(RunFolder, HoldsFieldsAtTheChosenInstantsInBothFormats) {
  run(with(two_blocks, "end: 4e-4", "end: 7e-4") + "fields: {formats: [vtu, med], at: [1e-4], every: 3}\n");
  EXPECT_EQ(names_in(folder_ / "fields"),
            (std::vector<std::string>{"000000.vtu", "000001.vtu", "000003.vtu", "000006.vtu", "000007.vtu"}));
  const auto series = text_of(folder_ / "fields.pvd");
  EXPECT_NE(series.find("timestep=\"0.0007\" part=\"0\" file=\"fields/000007.vtu\""), std::string::npos)
      << series;

  auto fields = med_fields(folder_ / "fields.med");
  std::vector<std::string> names;
  std::ranges::transform(fields, std::back_inserter(names), &MedField::name);
  std::ranges::sort(names);
  EXPECT_EQ(names,
            (std::vector<std::string>{"acceleration", "contact_cumulated_slip", "contact_friction_work",
                                      "contact_gap", "contact_pressure", "contact_slip", "contact_status",
                                      "displacement", "stress", "velocity", "von_mises"}));
  std::vector<int> numbers;
  std::ranges::transform(fields.front().instants, std::back_inserter(numbers), &Instant::number);
  EXPECT_EQ(numbers, (std::vector<int>{0, 1, 3, 6, 7}));

  const auto u = read_med_field(folder_ / "fields.med", "displacement", 7);
  EXPECT_EQ(u.at(2 * 14 + 1), last(table("probes.csv"), "end.y")) << "N15 is the tip";
}

TEST_F(RunFolder, HoldsOnlyTheLastInstantUnlessMoreIsAsked) {
  run(two_blocks + "fields: {}\n");
  EXPECT_EQ(names_in(folder_ / "fields"), std::vector<std::string>{"000004.vtu"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fields.med"));
}

TEST_F(RunFolder, OfAnInterruptedRunHoldsWhatWasReached) {
  int steps = 0;
  run::Watch watch;
  watch.progress = [&](const run::Progress& progress) { steps += progress.accepted ? 1 : 0; };
  watch.stop = [&] { return steps == 2; };
  const auto result = run(two_blocks + "fields: {}\n", watch);
  EXPECT_EQ(result.status, run::Status::interrupted);
  EXPECT_EQ(result.message, "interrupted at t = 0.0002");
  EXPECT_EQ(table("probes.csv").rows.size(), 3U);
  EXPECT_EQ(names_in(folder_ / "fields"), std::vector<std::string>{"000002.vtu"});
  EXPECT_EQ(summary().at("status"), "interrupted");
  EXPECT_EQ(summary().at("reason"), "interrupted at t = 0.0002");
}

TEST_F(RunFolder, SaysFromTheStartThatTheRunIsNotAtItsEnd) {
  std::string status;
  run::Watch watch;
  watch.stop = [&] {
    status = summary().at("status");
    return false;
  };
  run(two_blocks, watch);
  EXPECT_EQ(status, "running");
  EXPECT_EQ(summary().at("status"), "complete");
}

TEST_F(RunFolder, NamesTheNodeWhereAStepFailed) {
  const auto result = run(two_blocks + "newton: {residual: 1e-300, max_iterations: 1}\n");
  EXPECT_EQ(result.status, run::Status::not_converged);
  EXPECT_EQ(summary().at("reason"), result.message);
  const auto steps = text_of(folder_ / "steps.jsonl");
  EXPECT_EQ(std::ranges::count(steps, '\n'), 13) << "the whole step and twelve cuts";
  const auto first = nlohmann::json::parse(steps.substr(0, steps.find('\n')));
  EXPECT_EQ(first.at("accepted"), false);
  EXPECT_EQ(first.at("outcome"), "too many iterations");
  EXPECT_TRUE(first.at("worst_node").get<std::string>().starts_with("N"));
}

TEST_F(RunFolder, HoldsTheFailureAsData) {
  const auto result = run(two_blocks + "newton: {residual: 1e-300, max_iterations: 1}\n");
  const auto failure = summary().at("failure");
  EXPECT_EQ(failure.at("begin"), 0);
  EXPECT_EQ(failure.at("end"), 1e-4 / 4096);
  EXPECT_EQ(failure.at("cut_level"), 12);
  EXPECT_EQ(failure.at("level"), "newton");
  EXPECT_EQ(failure.at("outcome"), "too many iterations");
  EXPECT_EQ(failure.at("tolerance"), 1e-300);
  const auto& worst = failure.at("worst_nodes");
  ASSERT_FALSE(worst.empty());
  EXPECT_LE(worst.size(), 5U);
  EXPECT_TRUE(worst.at(0).at("node").get<std::string>().starts_with("N"));
  EXPECT_GT(worst.at(0).at("residual"), 0);
  EXPECT_GE(worst.at(0).at("residual"), worst.back().at("residual"));
  const auto& unmet = failure.at("unmet").at(0);
  EXPECT_EQ(unmet.at("criterion"), "residual");
  EXPECT_EQ(unmet.at("node"), worst.at(0).at("node"));
  EXPECT_EQ(unmet.at("value"), failure.at("residual"));
  EXPECT_EQ(unmet.at("allowed"), 1e-300);
  EXPECT_EQ(failure.at("status_changes"), failure.at("changed_status").size());
  EXPECT_FALSE(failure.at("advice").empty());
  EXPECT_NE(result.message.find("what may help: "), std::string::npos) << result.message;
}

TEST_F(RunFolder, HoldsNoFailureWhenThereWasNone) {
  run(two_blocks);
  EXPECT_FALSE(summary().contains("failure"));
}

TEST_F(RunFolder, SaysWhereAValueIsNotFinite) {
  const auto deck = with(two_blocks, "{on: tip, y: -1e7}", "{on: tip, y: -1e300, function: burst}");
  const auto result = run(deck + "functions: {burst: {times: [0, 1e-4, 2e-4], values: [0, 0, 1e300]}}\n");
  EXPECT_EQ(result.status, run::Status::not_converged);
  const auto failure = summary().at("failure");
  EXPECT_EQ(failure.at("outcome"), "a value is not finite");
  EXPECT_TRUE(failure.at("not_finite").get<std::string>().starts_with("the load on node N"))
      << failure.dump();
  EXPECT_NE(result.message.find("; the first that is not finite: the load on node N"), std::string::npos)
      << result.message;
  EXPECT_TRUE(failure.at("worst_nodes").at(0).at("residual").is_null());
  EXPECT_NE(failure.at("worst_nodes").at(0).at("node").get<std::string>().find("(1, 0.2)"), std::string::npos)
      << failure.dump();
}

TEST_F(RunFolder, IsNotTakenForOneWithoutASoundSummary) {
  const auto fault = [&](const std::string& text) {
    std::ofstream(folder_ / "run.json") << text;
    return test::fault_of([&] { read_stored_run(folder_.path()); });
  };
  const auto path = (folder_ / "run.json").string();
  EXPECT_NE(fault("{").find(path + ": found no valid JSON"), std::string::npos);
  EXPECT_NE(fault("{}").find(path + ": not the summary of a run"), std::string::npos);
  EXPECT_EQ(fault(R"({"status": "lost", "reason": ""})"),
            path + ": found the status 'lost', which no run has");
}

} // namespace
} // namespace rubato::results::recorder_test
