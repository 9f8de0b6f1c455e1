// SPDX-License-Identifier: LGPL-3.0-or-later
// Whatever the bytes, reading ends in a mesh or an InputError, prints nothing and gives every handle back.
#include "rubato/mesh/io/med.hpp"

#include <gtest/gtest.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "support/shared_files.hpp"
#include <fstream>
#include <iterator>
#include <random>

namespace rubato::mesh::damaged_med_test {
namespace {

using test::ScratchFolder;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// With so many groups that HDF5 keeps their list in another kind of storage.
std::string sample_bytes(const ScratchFolder& folder) {
  auto mesh = test::one_cell(CellType::hexa27, 3);
  for (int i = 0; i < 20; ++i)
    mesh.node_groups.push_back({"more_" + std::to_string(i), {i}});
  write_med(folder / "sample.med", mesh);
  return bytes_of(folder / "sample.med");
}

/// The files this process has open; −1 where the system doesn't tell.
int open_files() {
  const std::filesystem::path listing = "/proc/self/fd";
  if (!std::filesystem::exists(listing))
    return -1;
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(listing), {}));
}

void expect_clear_faults_when_truncated(const ScratchFolder& folder, const std::string& bytes) {
  constexpr std::size_t pieces = 24;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const auto length = bytes.size() * piece / pieces;
    write_bytes(folder / "cut.med", std::string_view(bytes).substr(0, length));
    const auto fault = test::fault_of([&] { read_med(folder / "cut.med"); });
    EXPECT_NE(fault.find(length == 0 ? "is empty" : "is truncated"), std::string::npos) << fault;
  }
}

TEST(DamagedMedFile, IsCalledTruncatedWhereverItEnds) {
  const ScratchFolder folder;
  expect_clear_faults_when_truncated(folder, sample_bytes(folder));
  for (const auto* letter : {"a", "b", "c", "d", "f"}) {
    const auto real = test::shared_file(std::string("sdnl140/sdnl140").append(letter).append(".med"));
    if (std::filesystem::exists(real))
      expect_clear_faults_when_truncated(folder, bytes_of(real));
  }
}

TEST(DamagedMedFile, IsCalledTruncatedInItsFirstBytes) {
  const ScratchFolder folder;
  const auto bytes = sample_bytes(folder);
  for (const std::size_t length : {1U, 7U, 8U, 20U, 63U}) {
    write_bytes(folder / "cut.med", std::string_view(bytes).substr(0, length));
    EXPECT_NE(test::fault_of([&] { read_med(folder / "cut.med"); }).find("is truncated"), std::string::npos);
  }
}

TEST(DamagedMedFile, NeverCrashesNorPrintsNorLeaksWhereverBytesAreWrong) {
  const ScratchFolder folder;
  const auto sound = sample_bytes(folder);
  const auto open_before = open_files();
  constexpr int attempts = 150;
  int refused = 0;
  testing::internal::CaptureStderr();
  for (int attempt = 0; attempt < attempts; ++attempt) {
    std::mt19937 random(static_cast<unsigned>(attempt));
    auto bytes = sound;
    for (int i = 0; i <= attempt % 20; ++i)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    write_bytes(folder / "wrong.med", bytes);
    refused += test::fault_of([&] { read_med(folder / "wrong.med"); }) != "nothing thrown" ? 1 : 0;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(open_files(), open_before);
  EXPECT_GT(refused, attempts / 4);
  write_bytes(folder / "sound.med", sound);
  EXPECT_EQ(read_med(folder / "sound.med").node_count(), 27);
}

} // namespace
} // namespace rubato::mesh::damaged_med_test
