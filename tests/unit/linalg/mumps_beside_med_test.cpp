// SPDX-License-Identifier: LGPL-3.0-or-later
// MUMPS carries a stub of MPI, libmedC a real MPI; both bear the same names and must not meet.
#include "rubato/linalg/direct_solver.hpp"

#include <gtest/gtest.h>
#include <med.h>

#include "elastic_block.hpp"
#include <array>
#include <dlfcn.h>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::linalg::mumps_beside_med_test {
namespace {

void expect_mumps_solves() {
  const auto matrix = test::tied_block(test::elastic_block(4, 3, 3), 8, 16);
  const auto lu = LuFactor::of(matrix, GeneralEngine::mumps);
  ASSERT_TRUE(lu);
  const Eigen::VectorXd right_side = Eigen::VectorXd::LinSpaced(matrix.cols(), -1, 2);
  const Eigen::VectorXd found = lu->solve(right_side);
  EXPECT_LE((matrix * found - right_side).norm(), 1e-13 * matrix.norm() * found.norm());
}

void expect_med_writes_and_reads(const std::string& file) {
  const std::array<double, 6> written{0, 0, 0, 1, 2, 3};
  std::array<char, 3 * MED_SNAME_SIZE + 1> axes{"x               y               z               "};
  const auto opened = MEDfileOpen(file.c_str(), MED_ACC_CREAT);
  ASSERT_GE(opened, 0);
  ASSERT_GE(MEDmeshCr(opened, "pair", 3, 3, MED_UNSTRUCTURED_MESH, "", "", MED_SORT_DTIT, MED_CARTESIAN,
                      axes.data(), axes.data()),
            0);
  ASSERT_GE(MEDmeshNodeCoordinateWr(opened, "pair", MED_NO_DT, MED_NO_IT, 0.0, MED_FULL_INTERLACE, 2,
                                    written.data()),
            0);
  ASSERT_GE(MEDfileClose(opened), 0);

  const auto again = MEDfileOpen(file.c_str(), MED_ACC_RDONLY);
  ASSERT_GE(again, 0);
  std::array<double, 6> read{};
  EXPECT_GE(MEDmeshNodeCoordinateRd(again, "pair", MED_NO_DT, MED_NO_IT, MED_FULL_INTERLACE, read.data()), 0);
  EXPECT_GE(MEDfileClose(again), 0);
  EXPECT_EQ(read, written);
}

std::filesystem::path home_of(const void* symbol) {
  Dl_info place{};
  return dladdr(symbol, &place) != 0 ? std::filesystem::path(place.dli_fname) : std::filesystem::path();
}

TEST(MumpsBesideMed, FactorsBeforeBetweenAndAfterMedFiles) {
  const auto file = std::filesystem::temp_directory_path() / "rubato_mumps_beside_med_test.med";
  expect_mumps_solves();
  expect_med_writes_and_reads(file.string());
  expect_mumps_solves();
  expect_med_writes_and_reads(file.string());
  std::filesystem::remove(file);
}

TEST(MumpsBesideMed, ExportsNoStubOfMpiFromTheProgram) {
  const auto program = std::filesystem::canonical("/proc/self/exe").filename();
  for (const char* name : {"MPI_Init", "MPI_Comm_rank", "MPI_Allreduce", "mpi_init_", "mpi_allreduce_",
                           "dmumps_c", "rubato_dmumps_c"}) {
    const void* symbol = dlsym(RTLD_DEFAULT, name);
    EXPECT_TRUE(symbol == nullptr || home_of(symbol).filename() != program) << name;
  }
  // What libmedC's HDF5 finds is the real one.
  const void* real = dlsym(RTLD_DEFAULT, "MPI_Init");
  ASSERT_NE(real, nullptr);
  EXPECT_EQ(home_of(real).filename().string().rfind("libmpi.so", 0), 0U) << home_of(real);
}

} // namespace
} // namespace rubato::linalg::mumps_beside_med_test
