// SPDX-License-Identifier: LGPL-3.0-or-later
/// tables.dat: values at nodes, in cells, on faces and of contact in the layout of CalculiX's .dat file.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/ccx_contact.hpp"
#include "rubato/results/ccx_numbers.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/step/state.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace rubato::results {

/// The tables of a study. Errors are those of LineFile.
class Tables {
public:
  /// A new file. The model must outlive this.
  Tables(const model::Model& model, const std::filesystem::path& path);
  /// Continues a file after its first `bytes`.
  Tables(const model::Model& model, const std::filesystem::path& path, std::uintmax_t bytes);

  /// Appends the tables that are due at step `number`.
  void write(const step::State& now, int number, bool last);
  /// Appends text whose last character ends a line.
  void add_words(std::string_view text) { file_.add(text.substr(0, text.size() - 1)); }
  void cut(std::uintmax_t bytes) { file_.cut(bytes); }
  std::uintmax_t bytes() const { return file_.bytes(); }

private:
  const model::Model* model_;
  LineFile file_;
  CcxNumbers numbers_;
  ContactLister contact_;
};

} // namespace rubato::results
