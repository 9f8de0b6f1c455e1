// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a run's folder tells besides its fields: summary, tables, steps.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace rubato::report {

/// As the page's scripts read it:
///   folder    as it was given
///   summary   run.json without study and tolerances
///   topics    the study in words: name, sentences
///   study, tolerances   as run.json has them
///   tables    of probes.csv, energy.csv and each resultants_ZONE.csv that is there: file, kind (probes,
///   energy,
///             resultants), zone, columns, values (an array a column; null where not finite)
///   attempts  steps.jsonl by columns; `failed`: the lines of attempts that were not accepted
///   warnings  sentences: those of the run, and what this reader could not read or left out
/// Long tables are thinned to every k-th line. Throws InputError when the folder is no run's.
nlohmann::ordered_json run_record(const std::filesystem::path& folder);

} // namespace rubato::report
