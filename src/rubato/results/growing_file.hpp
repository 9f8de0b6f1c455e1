// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: files that libraries change in places as they grow.
#pragma once

#include <filesystem>
#include <string>

namespace rubato::results {

/// Such a file cannot be cut back to what it was. So what a checkpoint counts on is copied before the file
/// changes again, and not before.
class GrowingFile {
public:
  /// `copy`: by which the last checkpoint knows the file as it is now, or empty.
  GrowingFile(std::filesystem::path folder, std::string_view name, std::string copy = {});

  std::filesystem::path path() const { return folder_ / name_; }

  /// For a checkpoint: what its copy is called, at this number of steps.
  const std::string& name_copy(int step);
  /// Before the file changes. Throws WriteError.
  void keep_copy();
  /// Puts the copy in the file's place. Without one the file is as the checkpoint has it: nothing was written
  /// into it since. Throws InputError when there is neither.
  void restore() const;

private:
  std::filesystem::path folder_;
  std::string name_;
  std::string copy_;
};

} // namespace rubato::results
