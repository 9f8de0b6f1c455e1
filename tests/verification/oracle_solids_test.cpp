// SPDX-License-Identifier: LGPL-3.0-or-later
// Plasticity, finite strain, rubber and pressures that follow, against Code_Aster.
#include <gtest/gtest.h>

#include "verification/oracle_solids.hpp"

namespace rubato::verification::oracle_solids_test {
namespace {

/// Code_Aster's residual is 1e-9 of its forces there, 1e-10 of blocks and pressures.
TEST(Oracle, HasTheHistoriesOfBodiesThatYieldAndStretch) {
  const auto studies = oracle_solids();
  if (studies.empty())
    GTEST_SKIP() << "needs the shared folder";
  for (const auto& study : studies) {
    const auto found = compare(study);
    EXPECT_GE(found.rows, 10) << study.file;
    EXPECT_LE(found.balance, 1e-10) << study.file;
    EXPECT_LE(found.largest, study.stands_beside ? 1e-3 : 1e-6) << study.file;
  }
}

} // namespace
} // namespace rubato::verification::oracle_solids_test
