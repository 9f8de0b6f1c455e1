// SPDX-License-Identifier: LGPL-3.0-or-later
/// Tip histories of SDNL140 against a running Code_Aster, on its meshes and on the project's own, which are
/// the same grids.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verification/sdnl140.hpp"
#include <ostream>

namespace rubato::verification::histories_test {
namespace {

using Changes = std::vector<deck::Setting>;

const Changes newmark{{"time.scheme", "newmark"}, {"time.alpha", "~"}};

Changes both(Changes one, const Changes& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

/// A history and how closely it is reproduced: `tolerance` of its peak up to `until`, `later` after it.
struct Reference {
  std::string name;
  char letter = 'f';
  MeshFrom from = MeshFrom::file;
  Changes changes;
  double tolerance = 0;
  double until = 1e300;
  double later = 0;
};

void PrintTo(const Reference& reference, std::ostream* out) {
  *out << reference.name;
}

class History : public testing::TestWithParam<Reference> {};

TEST_P(History, IsCodeAsters) {
  const auto& wanted = GetParam();
  const auto reference = history(wanted.name);
  if (!reference)
    GTEST_SKIP() << "the reference histories are not there";
  const auto run = finish(sdnl140(wanted.letter, wanted.from, wanted.changes));
  ASSERT_EQ(run.result.status, run::Status::complete) << run.result.message;
  const auto early = deviation(run.probes, *reference, wanted.until);
  EXPECT_EQ(early.missing, 0);
  EXPECT_GT(early.instants, 1);
  EXPECT_LE(early.relative(), wanted.tolerance) << "at t = " << early.at;
  RecordProperty("largest_deviation_over_peak", fmt::format("{:.2e}", early.relative()));
  if (wanted.later > 0) {
    const auto whole = deviation(run.probes, *reference);
    EXPECT_LE(whole.relative(), wanted.later) << "at t = " << whole.at;
  }
}

std::string name_of(const testing::TestParamInfo<Reference>& info) {
  return info.param.name + (info.param.from == MeshFrom::file ? "" : "_own_mesh");
}

/// The same references on both meshes.
std::vector<Reference> on_both_meshes(std::vector<Reference> references) {
  const auto count = references.size();
  for (std::size_t i = 0; i < count; ++i) {
    references.push_back(references[i]);
    references.back().from = MeshFrom::generator;
  }
  return references;
}

constexpr double linear = 1e-10;

INSTANTIATE_TEST_SUITE_P(
    WithoutContact, History,
    testing::ValuesIn(on_both_meshes({
        {"c_nocontact", 'c', MeshFrom::file, without_contact(), linear},
        {"d_nocontact", 'd', MeshFrom::file, without_contact(), linear},
        {"f_nocontact", 'f', MeshFrom::file, without_contact(), linear},
        {"f_nocontact_newmark", 'f', MeshFrom::file, both(without_contact(), newmark), linear},
        {"f_nocontact_modified", 'f', MeshFrom::file,
         both(without_contact(), {{"time.scheme", "modified_average_acceleration"}}), linear},
    })),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    TetrahedraWithoutContact, History,
    testing::Values(Reference{"a_nocontact", 'a', MeshFrom::file, without_contact(), linear},
                    Reference{"b_nocontact", 'b', MeshFrom::file,
                              both(without_contact(), {{"time.end", "0.002"}}), linear, 0.002}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Frictionless, History,
    testing::ValuesIn(on_both_meshes({
        {"f_frictionless", 'f', MeshFrom::file, {{"contact.interface.friction", "0"}}, 1e-8},
        {"f_frictionless_newmark", 'f', MeshFrom::file, both(newmark, {{"contact.interface.friction", "0"}}),
         1e-8},
    })),
    name_of);

INSTANTIATE_TEST_SUITE_P(Rubbing, History,
                         testing::ValuesIn(on_both_meshes({
                             {"c_evol1", 'c', MeshFrom::file, {}, 1e-7},
                             {"e_evol1", 'e', MeshFrom::file, {}, 1e-7},
                             {"f_evol1", 'f', MeshFrom::file, {}, 1e-7},
                             {"f_evol1_150ms", 'f', MeshFrom::file, {{"time.end", "0.15"}}, 1e-7},
                         })),
                         name_of);

INSTANTIATE_TEST_SUITE_P(RubbingTetrahedra, History,
                         testing::Values(Reference{"a_evol1", 'a', MeshFrom::file, {}, 1e-7},
                                         Reference{"b_evol1",
                                                   'b',
                                                   MeshFrom::file,
                                                   {{"time.end", "0.002"},
                                                    {"contact.interface.coefficients",
                                                     "{normal: 1e9, tangential: 1e7}"},
                                                    {"contact.interface.clamped_normal", "code_aster"}},
                                                   1e-7}),
                         name_of);

/// At 12 ms D's statuses are nearly undecided.
INSTANTIATE_TEST_SUITE_P(
    RubbingHexahedraOf27Nodes, History,
    testing::Values(Reference{"d_evol1", 'd', MeshFrom::file, {}, 1e-7, 0.0115, 1e-3},
                    Reference{"d_evol1", 'd', MeshFrom::generator, {{"time.end", "0.002"}}, 1e-7, 0.002}),
    name_of);

} // namespace
} // namespace rubato::verification::histories_test
