// SPDX-License-Identifier: LGPL-3.0-or-later
/// The folder a run writes into: what its files are called, and making it ready.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace rubato::results {

constexpr std::string_view summary_file = "run.json";
constexpr std::string_view probes_file = "probes.csv";
constexpr std::string_view energy_file = "energy.csv";
constexpr std::string_view steps_file = "steps.jsonl";
constexpr std::string_view vtu_folder = "fields";
constexpr std::string_view pvd_file = "fields.pvd";
constexpr std::string_view med_file = "fields.med";
constexpr std::string_view checkpoint_file = "checkpoint.h5";

/// "resultants_<zone>.csv"
std::string resultants_file(std::string_view zone);
/// "000012.vtu", in the folder `vtu_folder`.
std::string vtu_file(int step);

/// "checkpoint_000012.med": fields.med as it was at a checkpoint.
std::string med_copy_file(int step);
/// Removes these copies but one.
void remove_med_copies(const std::filesystem::path& folder, const std::string& but);

/// Removes the files in `vtu_folder` but those of these names.
void remove_vtu_files_but(const std::filesystem::path& folder, std::span<const std::string> kept);

/// Makes the folder, with those above it. The files of a run that was there before (its run.json tells) are
/// removed, so that old and new results never stand side by side; other files stay. Throws InputError when
/// the folder cannot be made or its former files cannot be removed.
void prepare_run_folder(const std::filesystem::path& folder);

} // namespace rubato::results
