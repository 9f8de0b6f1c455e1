// SPDX-License-Identifier: LGPL-3.0-or-later
/// Curves in panels one below the other, over one x axis.
#pragma once

#include "rubato/plot/colours.hpp"
#include "rubato/plot/svg.hpp"

#include <string>
#include <vector>

namespace rubato::plot {

enum class Mark {
  line,
  dots,  ///< points that no line joins
  rings, ///< larger, open ones: reference values
};

struct Curve {
  std::string label = {}; ///< in the legend; curves of one label and style have one entry
  std::vector<double> x = {};
  std::vector<double> y = {}; ///< as many; where it is not finite the line is broken
  LineStyle style = {};
  Mark mark = Mark::line;
};

/// Curves of one kind of quantity.
struct Panel {
  std::string label; ///< of the y axis
  std::vector<Curve> curves;
};

struct Figure {
  std::string title;
  std::string note = {}; ///< small, at the lower edge
  std::string x_label = {};
  bool time_axis = true;          ///< the x axis begins and ends where the curves do; else it has a margin
  std::vector<Panel> panels = {}; ///< at least one
};

/// A height that suits the number of panels.
int usual_height(const Figure& figure);

/// Draws it. Throws InputError when the size has no room for the panels.
std::string to_svg(const Figure& figure, Size size);

} // namespace rubato::plot
