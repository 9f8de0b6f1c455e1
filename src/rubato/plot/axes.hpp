// SPDX-License-Identifier: LGPL-3.0-or-later
/// A box with axes: numbers below and to the left of it, and where values are inside of it.
#pragma once

#include "rubato/plot/svg.hpp"
#include "rubato/plot/ticks.hpp"

#include <string>

namespace rubato::plot {

/// Values of two ranges in a box of pixels.
struct Frame {
  Box box;
  Range x;
  Range y;
  Point place(double at_x, double at_y) const {
    return {box.left + (at_x - x.low) / x.length() * box.width(),
            box.bottom - (at_y - y.low) / y.length() * box.height()};
  }
};

/// Ticks as many as have room along the pixels.
Ticks x_ticks(Range range, double pixels);
Ticks y_ticks(Range range, double pixels);

/// How wide the labels are.
double width_of_labels(const Ticks& ticks);

/// An axis: its ticks and what it shows.
struct Axis {
  Ticks ticks;
  std::string label;
  bool numbers = true; ///< whether numbers and label are written, or marks alone
};

/// Lines over the box at every tick, its border, numbers and labels. `left_of`: distance from the box to the
/// text of the y axis.
void draw_axes(Svg& svg, const Frame& frame, const Axis& x, const Axis& y, double left_of);

/// Numbers to the right of a bar.
void draw_right_axis(Svg& svg, const Box& bar, Range range, const Axis& axis);

/// The size of numbers and labels, of titles and of notes.
inline constexpr double label_size = 13;
inline constexpr double title_size = 15;
inline constexpr double note_size = 11;
/// From a box to the lower end of the numbers below it and of the label below these.
inline constexpr double numbers_below = 22;
inline constexpr double label_below = 42;

/// The title over a drawing and the note at its lower edge, cut to its width.
void draw_title_and_note(Svg& svg, Size size, const std::string& title, const std::string& note);

} // namespace rubato::plot
