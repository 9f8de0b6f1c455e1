// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/checkpoint.hpp"
#include "rubato/results/hdf5_file.hpp"
#include "rubato/results/seal.hpp"
#include "rubato/results/study_difference.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <cmath>
#include <fstream>
#include <limits>
#include <variant>

namespace rubato::results::checkpoint_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double tiny = std::numeric_limits<double>::denorm_min();

Checkpoint sample() {
  Checkpoint c;
  c.study = "{\"title\": \"ß\"}";
  c.mesh = 0xdeadbeef;
  c.start = 7;
  c.setup_seconds = 0.1;
  c.loop_seconds = 1.0 / 3;
  c.memento.counters = {.steps = 5, .iterations = 17, .cuts = 2};
  auto& state = c.memento.state;
  state.t = 0.3;
  state.step = 1e-4;
  state.motion = {VectorXd::Constant(3, -0.0), VectorXd::Constant(3, tiny), VectorXd::LinSpaced(3, 1, 2)};
  state.residual_force = VectorXd::Constant(3, 0.1);
  state.force_scale = 12;
  state.zones.resize(2);
  state.zones[1].multipliers = VectorXd::Constant(2, 1e300);
  state.zones[1].status = {contact::Status::open, contact::Status::slip};
  state.zones[1].outcomes = {{.gap = INFINITY}, {-1e-9, {1, 2}, 3, Vector3d(4, 5, 6), Vector3d(7, 8, 9)}};
  simulation::ImplicitProgress progress{{0.3, {{0.4, 1}, {0.35, 2}}, false}, {}, {{}, {0.5, 0}}};
  progress.energy.numerical = -4;
  progress.energy.overlap_work = 6;
  c.memento.progress = progress;
  c.record.gained_at = 0.2;
  c.recorder.resultants = {10, 20};
  c.recorder.contact = {30, 40};
  c.recorder.field_times = {0.1};
  c.recorder.field_files = {"fields/000001.vtu"};
  c.recorder.unwritten = true;
  return c;
}

TEST(CheckpointFile, GivesBackWhatWasWritten) {
  const test::ScratchFolder folder;
  const auto written = sample();
  write_checkpoint(folder / "a.h5", written);
  const auto read = read_checkpoint(folder / "a.h5");
  EXPECT_EQ(read.study, written.study);
  EXPECT_EQ(read.mesh, written.mesh);
  EXPECT_EQ(read.memento.counters, written.memento.counters);
  EXPECT_EQ(read.loop_seconds, 1.0 / 3);
  EXPECT_EQ(read.memento.state.motion.u, written.memento.state.motion.u);
  EXPECT_TRUE(std::signbit(read.memento.state.motion.u[0]));
  EXPECT_EQ(read.memento.state.motion.v, written.memento.state.motion.v);
  EXPECT_EQ(read.memento.state.step, 1e-4);
  EXPECT_EQ(read.memento.state.contact_force.size(), 0);
  EXPECT_EQ(read.memento.state.zones, written.memento.state.zones);
  const auto& progress = std::get<simulation::ImplicitProgress>(read.memento.progress);
  const auto& expected = std::get<simulation::ImplicitProgress>(written.memento.progress);
  EXPECT_EQ(progress.place.ends, expected.place.ends);
  EXPECT_FALSE(progress.place.finished);
  EXPECT_EQ(progress.energy.numerical, -4);
  EXPECT_EQ(progress.energy.overlap_work, 6);
  EXPECT_EQ(progress.overlaps, expected.overlaps);
  EXPECT_EQ(read.record.gained_at, 0.2);
  EXPECT_EQ(read.recorder.resultants, written.recorder.resultants);
  EXPECT_EQ(read.recorder.contact, written.recorder.contact);
  EXPECT_EQ(read.recorder.field_files, written.recorder.field_files);
  EXPECT_EQ(read.recorder.med_copy, "");
  EXPECT_EQ(read.recorder.vtkhdf_copy, "");
  EXPECT_TRUE(read.recorder.unwritten);
}

TEST(CheckpointFile, HoldsWhatMaterialsRemember) {
  const test::ScratchFolder folder;
  auto written = sample();
  written.memento.state.bulk_points.values = {0.1, -0.0, tiny, 1e300};
  simulation::ExplicitProgress progress;
  progress.motion.bulk_points.values = {1.0 / 3, 2};
  written.memento.progress = progress;
  write_checkpoint(folder / "a.h5", written);
  const auto read = read_checkpoint(folder / "a.h5").memento;
  EXPECT_EQ(read.state.bulk_points, written.memento.state.bulk_points);
  EXPECT_TRUE(std::signbit(read.state.bulk_points.values[1]));
  EXPECT_EQ(std::get<simulation::ExplicitProgress>(read.progress).motion.bulk_points,
            progress.motion.bulk_points);
}

/// Programs that knew linear bodies only wrote files without these energies.
TEST(CheckpointFile, HasEnergiesOfMaterialsWhereThereAreSome) {
  const test::ScratchFolder folder;
  auto written = sample();
  write_checkpoint(folder / "a.h5", written);
  EXPECT_FALSE(Hdf5File(folder / "a.h5", Hdf5File::Access::read).has("energy/plastic"));
  auto& energy = std::get<simulation::ImplicitProgress>(written.memento.progress).energy;
  energy = {.back_stress = 1, .hourglass = 2, .plastic = 3, .viscous = 4, .bulk_scheme = -5};
  written.record.by_bulk_scheme = 6;
  write_checkpoint(folder / "a.h5", written);
  const auto read = read_checkpoint(folder / "a.h5");
  const auto& found = std::get<simulation::ImplicitProgress>(read.memento.progress).energy;
  EXPECT_EQ(found.back_stress, 1);
  EXPECT_EQ(found.hourglass, 2);
  EXPECT_EQ(found.plastic, 3);
  EXPECT_EQ(found.viscous, 4);
  EXPECT_EQ(found.bulk_scheme, -5);
  EXPECT_EQ(found.balance(), energy.balance());
  EXPECT_EQ(read.record.by_bulk_scheme, 6);
}

/// Programs that knew no states wrote files without them.
TEST(CheckpointFile, HasNoStatesWhereMaterialsRememberNothing) {
  const test::ScratchFolder folder;
  write_checkpoint(folder / "a.h5", sample());
  EXPECT_FALSE(Hdf5File(folder / "a.h5", Hdf5File::Access::read).has("state/bulk_points"));
  EXPECT_TRUE(Hdf5File(folder / "a.h5", Hdf5File::Access::read).has("state/u"));
  EXPECT_TRUE(read_checkpoint(folder / "a.h5").memento.state.bulk_points.values.empty());
}

TEST(CheckpointFile, HoldsTheSpringsOfExplicitRuns) {
  const test::ScratchFolder folder;
  auto written = sample();
  simulation::ExplicitProgress progress;
  progress.limit = 1e-6;
  progress.motion.steps = 1'000'000'000'000;
  progress.motion.zones.resize(1);
  progress.motion.zones[0].springs = {{contact::Status::stick,
                                       false,
                                       -1,
                                       2,
                                       3,
                                       4,
                                       Vector3d(5, 6, 7),
                                       Vector3d(8, 9, 10),
                                       Vector3d(0, 1, 0),
                                       {11, 12}}};
  written.memento.progress = progress;
  write_checkpoint(folder / "a.h5", written);
  const auto read = read_checkpoint(folder / "a.h5");
  const auto& motion = std::get<simulation::ExplicitProgress>(read.memento.progress).motion;
  EXPECT_EQ(motion.steps, 1'000'000'000'000);
  const auto& spring = motion.zones.at(0).springs.at(0);
  EXPECT_EQ(spring.status, contact::Status::stick);
  EXPECT_FALSE(spring.paired);
  EXPECT_EQ(spring.tangential_stiffness, 4);
  EXPECT_EQ(spring.traction, Vector3d(8, 9, 10));
  EXPECT_EQ(spring.slip_on_tangents, Eigen::Vector2d(11, 12));
}

TEST(CheckpointFile, HasTheSameBytesForTheSameContent) {
  const test::ScratchFolder folder;
  const auto bytes = [&](const char* name) {
    write_checkpoint(folder / name, sample());
    std::ifstream file(folder / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_TRUE(bytes("a.h5") == bytes("b.h5"));
}

TEST(CheckpointFile, StaysWhenTheNextOneCannotBeWritten) {
  const test::ScratchFolder folder;
  write_checkpoint(folder / "a.h5", sample());
  std::filesystem::create_directory(folder / "a.h5.new");
  auto next = sample();
  next.mesh = 1;
  EXPECT_THROW(write_checkpoint(folder / "a.h5", next), std::runtime_error);
  EXPECT_EQ(read_checkpoint(folder / "a.h5").mesh, sample().mesh);
}

TEST(Seal, IsACyclicRedundancyCheck) {
  EXPECT_EQ(crc("123456789", 9), 0xcbf43926); // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc("56789", 5, crc("1234", 4)), 0xcbf43926);
}

TEST(StudyDifference, IsToldByTheFirstKeyThatChanged) {
  const std::string before =
      R"({"title": "a", "time": {"step": 1, "end": 2}, "contact": {"z": {"friction": 0.2}}})";
  EXPECT_EQ(study_difference(before, before), std::nullopt);
  EXPECT_EQ(
      study_difference(
          before, R"({"title": "b", "time": {"step": 1, "end": 3}, "contact": {"z": {"friction": 0.2}}})"),
      std::nullopt)
      << "title and end may change";
  EXPECT_EQ(
      study_difference(
          before, R"({"title": "a", "time": {"step": 1, "end": 2}, "contact": {"z": {"friction": 0.3}}})"),
      "contact.z.friction was 0.2 and is 0.3 now");
  EXPECT_EQ(study_difference(before, R"({"title": "a", "time": {"step": 1, "end": 2}, "contact": {}})"),
            R"(contact.z was {"friction":0.2} and is not there now)");
}

TEST(AFingerprint, TellsStatesApartByWhatMaterialsRemember) {
  const auto state = sample().memento.state;
  auto other = state;
  EXPECT_NE(fingerprint(state), 0U);
  EXPECT_EQ(fingerprint(other), fingerprint(state));
  other.bulk_points.values = {0.5};
  EXPECT_NE(fingerprint(other), fingerprint(state));
}

} // namespace
} // namespace rubato::results::checkpoint_test
