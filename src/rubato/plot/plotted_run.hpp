// SPDX-License-Identifier: LGPL-3.0-or-later
/// A finished run, or one that still goes on, as plots read it.
#pragma once

#include "rubato/plot/figure.hpp"
#include "rubato/study/study.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace rubato::plot {

struct PlottedRun {
  std::filesystem::path folder;
  std::string label; ///< in legends
  study::Study study;
};

/// The dimension of a field, of a column of contact_ZONE.csv or of resultants_ZONE.csv: "force/length²";
/// empty where it is a pure number, or not known.
std::string_view dimension_of(std::string_view quantity);

/// "displacement [length]": what it is, with its dimension where there is one.
std::string with_dimension(std::string_view quantity, std::string_view dimension);

/// The title of the runs where all have one, with the name of a single run.
std::string title_of(std::span<const PlottedRun> runs);

/// "units: mm, N, MPa", those of the decks.
std::string units_of(std::span<const PlottedRun> runs);

/// The line of an expression of the abscissa, x or t, over what the figure shows, in its first panel. Throws
/// InputError when `expression` is none.
void add_reference(Figure& figure, const std::string& expression);

} // namespace rubato::plot
