// SPDX-License-Identifier: LGPL-3.0-or-later
/// The ccx module: studies become an input file of CalculiX CrunchiX 2.20, so that another program can
/// compute them.
#pragma once

#include "rubato/study/study.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rubato::ccx {

struct Draft;

/// Number and range of the natural modes of a step.
struct Frequencies {
  int number = 10;
  double lowest = 0;             ///< frequency [1/time]
  std::optional<double> highest; ///< likewise
};

/// An input file, step by step.
class InputFile {
public:
  InputFile();
  InputFile(InputFile&&) noexcept;
  InputFile& operator=(InputFile&&) noexcept;
  ~InputFile();

  /// Adds a run as the next step, which starts from the end of the one before; or its natural modes. Throws
  /// InputError with every fault of the study, else with a fault for each of its keys that CalculiX has no
  /// counterpart of; faults have the path of the value.
  void add(const study::Study& study, const std::optional<Frequencies>& modes = {});

  /// The whole file. There is a step.
  std::string text() const;
  /// Sentences on what differs in CalculiX, those of the head of the file.
  const std::vector<std::string>& notes() const;

private:
  std::unique_ptr<Draft> draft_;
};

} // namespace rubato::ccx
