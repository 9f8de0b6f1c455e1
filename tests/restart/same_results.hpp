// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whether two folders hold the same results, to the last bit.
#pragma once

#include "rubato/results/hdf5_file.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/vtkhdf.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace rubato::test {

/// Those that a run without a checkpoint found there and moved aside when it began anew are not its own.
inline std::set<std::string> files_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto name = entry.path().lexically_relative(folder);
    if (entry.is_regular_file() &&
        std::ranges::find(name, std::filesystem::path(results::former_folder)) == name.end())
      names.insert(name.string());
  }
  return names;
}

/// The lines of steps.jsonl without the seconds they took.
inline std::vector<nlohmann::json> attempts_in(const std::filesystem::path& file) {
  std::vector<nlohmann::json> attempts;
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line);) {
    attempts.push_back(nlohmann::json::parse(line));
    attempts.back().erase("seconds");
  }
  return attempts;
}

inline nlohmann::json summary_in(const std::filesystem::path& file) {
  auto summary = nlohmann::json::parse(text_of(file));
  summary.erase("setup_seconds");
  summary.erase("elapsed_seconds");
  summary.erase("loop_seconds");
  summary.erase("method");
  summary.erase("factor_bytes"); // a run that was killed after its last step factors nothing when it goes on
  summary.erase("warnings");     // they tell how the run was stopped, too
  for (auto& check : summary.at("plausibility")) // each part of a run has values of its own
    for (const auto* key : {"value", "t", "where", "warned", "passes"})
      check.erase(key);
  return summary;
}

/// MED stamps the time into its files: they are compared by what they hold. Of the values, which take a
/// process each to read, the displacements: the .vtu files show them all.
inline void expect_same_fields(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto fields = results::med_fields(a);
  const auto others = results::med_fields(b);
  ASSERT_EQ(fields.size(), others.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    EXPECT_EQ(fields[f].name, others[f].name);
    ASSERT_EQ(fields[f].instants.size(), others[f].instants.size()) << fields[f].name;
    for (std::size_t i = 0; i < fields[f].instants.size(); ++i) {
      const auto& instant = fields[f].instants[i];
      EXPECT_EQ(instant.time, others[f].instants[i].time);
      EXPECT_EQ(instant.number, others[f].instants[i].number);
      if (fields[f].name == "displacement") {
        EXPECT_EQ(results::read_med_field(a, fields[f].name, instant.number),
                  results::read_med_field(b, fields[f].name, instant.number))
            << "at " << instant.time;
      }
    }
  }
}

/// Where a step was taken back, because the disk was full, HDF5 may have left its room unused: what the files
/// hold is compared.
inline void expect_same_instants(const std::filesystem::path& a, const std::filesystem::path& b) {
  const results::Hdf5File one(a, results::Hdf5File::Access::read);
  const results::Hdf5File other(b, results::Hdf5File::Access::read);
  for (const auto* name : {"Steps/Values", "PointData/displacement", "PointData/stress", "Points"})
    EXPECT_EQ(one.numbers(std::string("VTKHDF/") + name), other.numbers(std::string("VTKHDF/") + name))
        << name;
  EXPECT_EQ(one.integers("VTKHDF/Steps/PointDataOffsets/displacement"),
            other.integers("VTKHDF/Steps/PointDataOffsets/displacement"));
  EXPECT_EQ(results::instants_in_vtkhdf(a), results::instants_in_vtkhdf(b));
}

/// Everything but seconds, memory and checkpoints.
inline void expect_same_results(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto names = files_in(a);
  EXPECT_EQ(names, files_in(b));
  for (const auto& name : names) {
    const std::filesystem::path path(name);
    const auto other = b / path;
    if (!std::filesystem::exists(other) || path.filename().string().starts_with("checkpoint"))
      continue;
    if (path.filename() == "run.json")
      EXPECT_EQ(summary_in(a / path), summary_in(other)) << name;
    else if (path.extension() == ".jsonl")
      EXPECT_EQ(attempts_in(a / path), attempts_in(other)) << name;
    else if (path.extension() == ".med")
      expect_same_fields(a / path, other);
    else if (path.extension() == ".vtkhdf")
      expect_same_instants(a / path, other);
    else
      EXPECT_TRUE(text_of(a / path) == text_of(other)) << name << " differs";
  }
}

} // namespace rubato::test
