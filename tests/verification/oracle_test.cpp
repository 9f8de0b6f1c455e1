// SPDX-License-Identifier: LGPL-3.0-or-later
// Histories and fields by Code_Aster, of what the document of SDNL140 does not name.
#include <gtest/gtest.h>

#include "verification/oracle_heat.hpp"
#include "verification/oracle_statics.hpp"

namespace rubato::verification::oracle_test {
namespace {

/// Code_Aster's own residual is 1e-10 to 1e-12 of the forces.
constexpr double agreement = 1e-9;

TEST(Oracle, HasTheDisplacementsOfStaticStudies) {
  const auto studies = oracle_statics();
  if (studies.empty())
    GTEST_SKIP() << "needs the shared folder";
  for (const auto& study : studies) {
    const auto found = compare(study);
    EXPECT_GT(found.nodes, 0) << study.file;
    EXPECT_LE(found.largest, agreement) << study.file;
  }
}

/// Code_Aster's residual is 1e-9 of its forces there.
TEST(Oracle, HasTheHistoriesOfAHeatedBeam) {
  const auto studies = oracle_heat();
  if (studies.empty())
    GTEST_SKIP() << "needs the shared folder";
  for (const auto& study : studies) {
    const auto found = compare(study);
    EXPECT_GE(found.rows, 4) << study.file;
    EXPECT_LE(found.displacement, 1e-6) << study.file;
    EXPECT_LE(found.reaction, 1e-6) << study.file;
  }
}

} // namespace
} // namespace rubato::verification::oracle_test
