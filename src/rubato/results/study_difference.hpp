// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whether two runs are the same but for what a run may change when it is resumed.
#pragma once

#include <optional>
#include <string>

namespace rubato::results {

/// The first difference between two echoes of studies (study::to_json), in words: "contact.interface.friction
/// was 0.2 and is 0.3 now". Nothing when they differ only in the title, where the mesh file is, the end of
/// the run or its instants, what is done about failing steps (time.on_failure, newton), in checkpoints and
/// checks.
std::optional<std::string> study_difference(const std::string& before, const std::string& now);

/// Whether a run of one study has every result of the other: they differ in nothing but the title, where the
/// mesh file is, checkpoints and checks.
bool same_results_expected(const std::string& before, const std::string& now);

} // namespace rubato::results
