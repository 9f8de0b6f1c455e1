// SPDX-License-Identifier: LGPL-3.0-or-later
// What steps become beside their answers: names, times, results, notes.
#include "rubato/inp/read.hpp"

#include <gtest/gtest.h>

#include "computed.hpp"
#include "small_files.hpp"
#include <algorithm>

namespace rubato::steps_test {
namespace {

using test::with_step;

inp::Input parsed(const std::string& text) {
  return inp::parse_input(text, "a.inp");
}

TEST(StepsOfFiles, AreRunsThatStartFromOneAnother) {
  const auto input = inp::read_input(test::inp_file("two_steps"));
  ASSERT_EQ(input.runs.size(), 3U);
  EXPECT_EQ(input.runs[0].name, "Load");
  EXPECT_EQ(input.runs[2].name, "Off");
  EXPECT_EQ(input.runs[1].time.start_run, "Load");
  EXPECT_EQ(input.runs[1].time.begin, 1);
  EXPECT_EQ(input.runs[1].time.end, 5);
  EXPECT_EQ(input.runs[2].time.begin, 5);
  EXPECT_EQ(input.title,
            "Loads go on from step to step: 1e6 N at the end of the first, 3e6 N at that of the second");
  // Requests of results go on, too.
  for (const auto& study : input.runs)
    ASSERT_EQ(study.probes.size(), 1U);
  EXPECT_EQ(input.runs[2].probes[0].name, "CORNER_U");
  EXPECT_TRUE(std::ranges::any_of(input.notes, [](const std::string& note) {
    return note.find("OP=NEW takes away in a static step fall to 0") != std::string::npos;
  }));
}

TEST(StepsOfFiles, HaveTheirRequestsAsProbesAndFields) {
  const auto study = parsed(with_step(R"(*STATIC, DIRECT
 0.1, 1.
*NODE PRINT, NSET=ALL, TOTALS=ONLY
 RF
*NODE PRINT, NSET=ONE
 U, V
*NODE FILE, FREQUENCY=3
 U
*EL PRINT, ELSET=E
 S
)"))
                         .runs.front();
  ASSERT_EQ(study.probes.size(), 3U);
  EXPECT_EQ(study.probes[0].take, study::ProbeTake::sum);
  EXPECT_EQ(study.probes[0].field, study::ProbeField::reaction);
  EXPECT_EQ(study.probes[1].name, "ONE_U");
  EXPECT_EQ(study.probes[1].node, "ONE");
  EXPECT_TRUE(study.fields.vtu);
  EXPECT_TRUE(study.fields.frd);
  EXPECT_FALSE(study.fields.frd_binary);
  EXPECT_EQ(study.fields.every, 3);
  const auto& tables = study.fields.tables;
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[0].totals, study::TableTotals::only);
  EXPECT_EQ(tables[1].quantities, (std::vector<std::string>{"U", "V"}));
  EXPECT_EQ(tables[2].of, study::TableOf::cells);
  EXPECT_EQ(tables[2].label, "E");
}

TEST(StepsOfFiles, ReplaceRequestsOfTheSameKind) {
  const auto first = std::string("*STATIC\n*NODE PRINT, NSET=ONE\n U\n*EL PRINT, ELSET=E\n S\n");
  const auto runs =
      parsed(with_step(first) + "*STEP\n*STATIC\n*NODE PRINT, NSET=ONE, FREQUENCY=0\n U\n*END STEP\n"
                                "*STEP\n*STATIC\n*EL PRINT, ELSET=E, TOTALS=YES\n EVOL\n*END STEP\n")
          .runs;
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].fields.tables.size(), 2U);
  ASSERT_EQ(runs[1].fields.tables.size(), 1U); // of cells, as before
  EXPECT_EQ(runs[1].fields.tables[0].quantities.front(), "S");
  ASSERT_EQ(runs[2].fields.tables.size(), 1U);
  EXPECT_EQ(runs[2].fields.tables[0].totals, study::TableTotals::also);
  EXPECT_EQ(runs[2].fields.step, 3);
}

TEST(StepsOfFiles, StopAtTimePointsOfRequests) {
  const auto runs = parsed("*TIME POINTS, NAME=T1, GENERATE\n 0., 1., 0.25\n" +
                           with_step("*STATIC\n*NODE FILE, TIME POINTS=t1\n U\n") +
                           "*TIME POINTS, NAME=T2, TIME=TOTAL TIME\n 0.5, 1.5,\n 1.75,\n"
                           "*STEP\n*STATIC\n*NODE PRINT, NSET=ONE, TIMEPOINTS=T2\n U\n*END STEP\n")
                        .runs;
  EXPECT_EQ(runs[0].fields.at, (std::vector<double>{0.25, 0.5, 0.75}));
  EXPECT_EQ(runs[0].fields.every, 0);
  EXPECT_EQ(runs[1].fields.at, (std::vector<double>{1.25, 1.5, 1.75})); // times of the step
  EXPECT_EQ(runs[1].time.stops, (std::vector<double>{1.25, 1.5, 1.75}));
}

TEST(StepsOfFiles, TellHistoriesFromFieldsByTheirOutput) {
  const auto study =
      parsed(with_step("*STATIC\n*OUTPUT, HISTORY, FREQUENCY=2\n*NODE OUTPUT, NSET=ONE\n U1, RF3\n"
                       "*ELEMENT OUTPUT, ELSET=E\n S11, MISES\n*OUTPUT, FIELD\n*ELEMENT OUTPUT\n S, E\n"))
          .runs.front();
  ASSERT_EQ(study.fields.tables.size(), 2U);
  EXPECT_EQ(study.fields.tables[0].every, 2);
  EXPECT_EQ(study.fields.tables[0].quantities, (std::vector<std::string>{"U", "RF"}));
  EXPECT_EQ(study.fields.also, std::vector<std::string>{"strain"});
  EXPECT_TRUE(parsed(with_step("*STATIC\n*NODE OUTPUT\n U\n")).runs.front().fields.frd_binary);
}

TEST(StepsOfFiles, HaveFieldsAtIntervals) {
  const auto study = parsed(with_step("*STATIC\n*OUTPUT, FIELD, NUMBER INTERVAL=4\n")).runs.front();
  EXPECT_EQ(study.fields.at, (std::vector<double>{0.25, 0.5, 0.75}));
  EXPECT_EQ(study.time.stops, study.fields.at);
}

TEST(StepsOfFiles, SayWhatWasLeftOutAndWhatDiffers) {
  const auto notes =
      parsed("*PREPRINT, ECHO=NO\n" + with_step("*STATIC\n 0.1, 1.\n*EL PRINT\n S, SDV\n*MONITOR, NODE=1\n"))
          .notes;
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_NE(notes[0].find("increments are 0.1 throughout"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("C3D8R has forces of rubato's own against hourglasses"), std::string::npos)
      << notes[1];
  EXPECT_EQ(
      notes[2],
      "a.inp: left out, without effect on the answer: 'SDV' in *EL PRINT (line 29), *MONITOR (line 30), "
      "*PREPRINT (line 1)");
}

TEST(StepsOfFiles, TakeTheirSchemeFromAlpha) {
  const auto dynamic = parsed(with_step("*DYNAMIC\n 0.1, 1.\n"));
  EXPECT_EQ(dynamic.runs[0].time.scheme, study::SchemeKind::hht);
  EXPECT_EQ(dynamic.runs[0].time.alpha, -0.05);
  EXPECT_EQ(dynamic.runs[0].time.contact_mass, study::ContactMass::consistent);
  EXPECT_EQ(parsed(with_step("*DYNAMIC, ALPHA=-0.2\n 0.1, 1.\n")).runs[0].time.alpha, -0.2);
}

TEST(LoadsOfSteps, RampInStaticStepsAndAreThereAtOnceInDynamicOnes) {
  const std::string load = "*CLOAD\n ONE, 1, 5.\n";
  const auto ramped = parsed(with_step("*STATIC\n" + load)).runs[0];
  ASSERT_EQ(ramped.loads.size(), 1U);
  EXPECT_EQ(value_at(ramped.functions.at(ramped.loads[0].function), 0.25), 0.25);
  EXPECT_EQ(*ramped.loads[0].components[0].number(), 5);
  EXPECT_EQ(parsed(with_step("*DYNAMIC, ALPHA=0.\n 0.1, 1.\n" + load)).runs[0].loads[0].function, "");
  EXPECT_EQ(parsed(with_step("*STATIC\n" + load, "*STEP, AMPLITUDE=STEP")).runs[0].loads[0].function, "");
  // Lines of one step add up.
  EXPECT_EQ(*parsed(with_step("*STATIC\n" + load + load)).runs[0].loads[0].components[0].number(), 10);
}

TEST(LoadsOfSteps, InSeveralDirectionsAreSeveral) {
  const auto study =
      parsed(with_step("*STATIC\n*DLOAD\n E, GRAV, 2., 1., 0., 0.\n E, GRAV, 3., 0., 1., 0.\n")).runs[0];
  ASSERT_EQ(study.loads.size(), 2U);
  EXPECT_EQ(*study.loads[0].components[0].number(), 2);
  EXPECT_EQ(*study.loads[1].components[1].number(), 3);
  EXPECT_EQ(*study.loads[1].components[0].number(), 0);
}

TEST(LoadsOfSteps, AreReplacedByThoseOfTheSameSetAndTakenAwayByOpNew) {
  const auto second = [](const std::string& first, const std::string& next) {
    return parsed(with_step("*STATIC\n" + first + "*END STEP\n*STEP\n*STATIC\n" + next)).runs.at(1);
  };
  const auto value = [](const study::Study& study, std::size_t load, double t) {
    const auto& function = study.loads.at(load).function;
    return *study.loads.at(load).components[0].number() *
           (function.empty() ? 1 : value_at(study.functions.at(function), t));
  };
  // Kept, replaced, taken away, and given to another set.
  const auto kept = second("*CLOAD\n ONE, 1, 5.\n", "");
  EXPECT_EQ(value(kept, 0, 1), 5);
  EXPECT_EQ(value(kept, 0, 2), 5);
  const auto replaced = second("*CLOAD\n ONE, 1, 5.\n", "*CLOAD\n ONE, 1, 8.\n");
  EXPECT_EQ(replaced.loads.size(), 1U);
  EXPECT_EQ(value(replaced, 0, 1), 5);
  EXPECT_EQ(value(replaced, 0, 2), 8);
  const auto gone = second("*CLOAD\n ONE, 1, 5.\n", "*CLOAD, OP=NEW\n");
  EXPECT_EQ(value(gone, 0, 1), 5);
  EXPECT_EQ(value(gone, 0, 2), 0);
  const auto other = second("*CLOAD\n ONE, 1, 5.\n", "*CLOAD, OP=NEW\n ALL, 1, 2.\n");
  ASSERT_EQ(other.loads.size(), 2U);
  EXPECT_EQ(value(other, 0, 2), 0);
  EXPECT_EQ(value(other, 1, 1), 0);
  EXPECT_EQ(value(other, 1, 2), 2);
}

TEST(AmplitudesOfSteps, HaveTheirForms) {
  const auto at = [](const std::string& amplitude, double t) {
    const auto study = parsed(with_step("*STATIC, DIRECT\n 1., 4.\n*AMPLITUDE, NAME=A" + amplitude +
                                        "\n*CLOAD, AMPLITUDE=A\n ONE, 1, 1.\n"))
                           .runs[0];
    return value_at(study.functions.at(study.loads.at(0).function), t);
  };
  EXPECT_EQ(at("\n 0., 1., 2., 5.\n", 1), 3);
  EXPECT_EQ(at("\n 0., 1., 2., 5.\n", 4), 5);
  EXPECT_EQ(at(", SHIFTX=1., SHIFTY=10.\n 0., 1., 2., 5.\n", 2), 13);
  EXPECT_EQ(at(", DEFINITION=EQUALLY SPACED, FIXED INTERVAL=0.5, BEGIN=1.\n 1., 3.\n", 1.25), 2);
  EXPECT_DOUBLE_EQ(at(", DEFINITION=SMOOTH STEP\n 1., 2., 3., 4.\n", 0), 2);
  EXPECT_DOUBLE_EQ(at(", DEFINITION=SMOOTH STEP\n 1., 2., 3., 4.\n", 2), 3);
  EXPECT_NEAR(at(", DEFINITION=SMOOTH STEP\n 1., 2., 3., 4.\n", 1.5),
              2 + 2 * (10 / 64. - 15 / 256. + 6 / 1024.), 1e-14);
  EXPECT_NEAR(at(", DEFINITION=PERIODIC\n 2, 3., 0.5, 7.\n 1., 2., 3., 4.\n", 2),
              7 + std::cos(4.5) + 2 * std::sin(4.5) + 3 * std::cos(9) + 4 * std::sin(9), 1e-14);
  EXPECT_NEAR(at(", DEFINITION=DECAY\n 1., 2., 0.5, 3.\n", 2), 1 + 2 * std::exp(-0.5), 1e-14);
  EXPECT_EQ(at(", DEFINITION=DECAY\n 1., 2., 0.5, 3.\n", 0.25), 1);
  EXPECT_NEAR(at(", DEFINITION=MODULATED\n 1., 2., 0.5, 3., 4.\n", 2), 1 + 2 * std::sin(4.5) * std::sin(6),
              1e-14);
}

} // namespace
} // namespace rubato::steps_test
