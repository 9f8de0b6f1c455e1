// SPDX-License-Identifier: LGPL-3.0-or-later
/// Colours that people with any kind of colour vision tell apart, as "#rrggbb".
#pragma once

#include <string>
#include <string_view>

namespace rubato::plot {

/// How one of several curves is drawn: a colour, and once these are used up dashes too.
struct LineStyle {
  std::string_view colour;
  std::string_view dashes; ///< as stroke-dasharray has them; empty: an unbroken line
};

/// The style of the curve of that number, from 0: the colours of Okabe and Ito (2008), without black and
/// yellow.
LineStyle line_style(int colour, int dashes = 0);

/// The number of colours that line_style has before dashes set in.
int line_colour_count();

/// The colour of a part 0 to 1 of a range, from dark to light (viridis, of matplotlib; CC0).
std::string range_colour(double part);

} // namespace rubato::plot
