// SPDX-License-Identifier: LGPL-3.0-or-later
/// The pages of docs/verification, each written from runs made now.
#pragma once

#include "verification/sdnl140.hpp"
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace rubato::verification {

/// A page in Markdown. Lines appear in the file as they are written.
class Page {
public:
  Page(const std::filesystem::path& file, const std::string& title);
  void paragraph(const std::string& text);
  void table(const std::vector<std::string>& columns);
  void row(const std::vector<std::string>& values);

private:
  void line(const std::string& text);
  std::ofstream file_;
};

/// "complete", or why not.
std::string outcome_of(const run::RunResult& result);
/// Processor seconds of set-up and steps.
std::string seconds_of(const run::RunResult& result);

/// SDNL140: every run of every modeling against the document and Code_Aster, and further histories.
void write_sdnl140(const std::filesystem::path& folder);
/// The same for the modelings of these letters, without the further histories: sdnl140_<letters>.md.
void write_sdnl140_of(const std::filesystem::path& folder, const std::string& letters);
/// The part of that page on the decks' runs, which stay in the build folder for draw_histories.py.
void write_modelings(Page& page, const std::string& letters);
/// V3.
void write_contact_patch(const std::filesystem::path& folder);
/// V1, V2, V8 and V10: impacts, with every scheme.
void write_bar_on_wall(const std::filesystem::path& folder);
void write_dropped_bar(const std::filesystem::path& folder);
void write_sphere_impact(const std::filesystem::path& folder);
void write_rod_on_rod(const std::filesystem::path& folder);
/// V4 to V7 and V9: laws of contact and friction.
void write_hertz(const std::filesystem::path& folder);
void write_mindlin(const std::filesystem::path& folder);
void write_incline(const std::filesystem::path& folder);
void write_slider(const std::filesystem::path& folder);
void write_signorini(const std::filesystem::path& folder);
/// Relations and orthotropic materials against Code_Aster's displacements.
void write_relations(const std::filesystem::path& folder);
void write_heat(const std::filesystem::path& folder);
void write_solids(const std::filesystem::path& folder);
/// Benchmarks of nonlinear bodies, locking and convergence of Newton's method.
void write_bulk(const std::filesystem::path& folder);
/// V11.
void write_free_beam(const std::filesystem::path& folder);
/// Natural frequencies against Code_Aster.
void write_modes(const std::filesystem::path& folder);
/// How the answer settles as steps and cells get finer.
void write_convergence(const std::filesystem::path& folder);
/// Explicit runs of modeling F against the converged answer and against implicit ones.
void write_explicit(const std::filesystem::path& folder);
/// The runs of SDNL140 solved on the contact points and as a whole.
void write_condensed(const std::filesystem::path& folder);
/// Hundreds of random variants of the two beams, as robustness.hpp draws them; the decks of those that fail
/// stay in the build folder.
void write_robustness(const std::filesystem::path& folder);
/// Hundreds of random variants of bodies that yield and stretch, as solids_sweep.hpp draws them; likewise.
void write_solids_robustness(const std::filesystem::path& folder);
/// Hundreds of random studies, each in several ways that must agree, as second_way.hpp draws them; the decks
/// stay in the build folder.
void write_second_way(const std::filesystem::path& folder);
/// Mortar contact against closed solutions, beside nodes.
void write_mortar(const std::filesystem::path& folder);
/// Random variants of the two beams with mortar contact, some of them beside nodes.
void write_mortar_robustness(const std::filesystem::path& folder);
/// Modeling C with nothing chosen by the user, at smaller steps and on finer meshes.
void write_defaults(const std::filesystem::path& folder);

} // namespace rubato::verification
