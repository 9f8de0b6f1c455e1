// SPDX-License-Identifier: LGPL-3.0-or-later
/// The folder a run writes into: what its files are called, and making it ready.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::results {

constexpr std::string_view summary_file = "run.json";
constexpr std::string_view probes_file = "probes.csv";
constexpr std::string_view energy_file = "energy.csv";
constexpr std::string_view steps_file = "steps.jsonl";
constexpr std::string_view vtu_folder = "fields";
constexpr std::string_view pvd_file = "fields.pvd";
constexpr std::string_view med_file = "fields.med";
constexpr std::string_view vtkhdf_file = "fields.vtkhdf";
constexpr std::string_view frd_file = "fields.frd";
constexpr std::string_view tables_file = "tables.dat";
constexpr std::string_view report_file = "report.html"; ///< `rubato report` writes it
constexpr std::string_view checkpoint_file = "checkpoint.h5";
constexpr std::string_view former_folder = "former";

/// "resultants_<zone>.csv"
std::string resultants_file(std::string_view zone);
/// "contact_<zone>.csv"
std::string contact_file(std::string_view zone);
/// The contact zones of a run, by name, as its folder has tables of their resultants.
std::vector<std::string> contact_zones(const std::filesystem::path& folder);
/// "000012.vtu", in the folder `vtu_folder`.
std::string vtu_file(int step);

/// "checkpoint_000012.med": fields.med as it was at a checkpoint, where it has grown since.
std::string copy_of_fields(std::string_view file, int step);
/// Removes these copies but some.
void remove_copies_of_fields(const std::filesystem::path& folder, std::span<const std::string> kept);

/// Removes the files in `vtu_folder` but those of these names.
void remove_vtu_files_but(const std::filesystem::path& folder, std::span<const std::string> kept);

/// Whether a run has been in the folder: its run.json tells.
bool holds_run(const std::filesystem::path& folder);

/// Makes the folder, with those above it. Of a run that was there before the files move into `former_folder`
/// inside, whose own make room for them: old and new results never stand side by side, and nobody loses a run
/// by a slip. Other files stay. Throws InputError when the folder cannot be made or cannot be written into.
void prepare_run_folder(const std::filesystem::path& folder);

/// That one run, and no other one, writes into a folder. The system gives the folder back when the program
/// ends, however it does.
class FolderClaim {
public:
  /// Claims the folder when it is there. Throws InputError when another program has it.
  explicit FolderClaim(std::filesystem::path folder);
  ~FolderClaim();
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;

  /// Makes the folder, with those above it, when it is not there, and claims it. Throws InputError when it
  /// cannot be made, and when another program has it.
  void make();

private:
  void take();

  std::filesystem::path folder_;
  int handle_ = -1;
};

} // namespace rubato::results
