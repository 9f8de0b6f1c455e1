// SPDX-License-Identifier: LGPL-3.0-or-later
/// The files of a run that programs around CalculiX read: fields.frd and tables.dat.
#pragma once

#include "rubato/results/frd.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/tables.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace rubato::results {

class CcxFiles {
public:
  /// Creates the files that the study requests. The model must outlive this.
  CcxFiles(const model::Model& model, const std::filesystem::path& folder);
  /// Continues the files at `position`; what follows there is removed.
  CcxFiles(const model::Model& model, const std::filesystem::path& folder, const std::string& position);

  /// Appends the tables that are due at step `number` of the run.
  void write_tables(const step::State& now, int number, bool last);
  void write_fields(const step::State& now, int number, std::span<const OwnedField> fields);
  void cut(const std::string& position);
  /// Lengths and counters of the files, as text for a checkpoint.
  std::string position() const;

private:
  const model::Model* model_;
  ContactLister contact_;
  std::optional<FrdFile> frd_;
  std::optional<Tables> tables_;
};

/// Joins fields.frd and tables.dat of consecutive runs to `<name>.frd` and `<name>.dat` in the parent folder
/// of the runs. Runs without such files are skipped. If no run has one, an earlier joined file is removed.
void join_ccx_files(const std::filesystem::path& folder, std::span<const std::string> runs,
                    const std::string& name);

} // namespace rubato::results
