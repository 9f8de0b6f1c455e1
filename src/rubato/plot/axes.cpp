// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/axes.hpp"

#include <algorithm>

namespace rubato::plot {
namespace {

constexpr double tick_length = 5;
constexpr double widest_x_label = 80; // with the distance to the next one
constexpr double y_label_distance = 36;
constexpr std::string_view grid_colour = "#e4e4e4";
constexpr std::string_view text_colour = "#222222";

/// The label with the factor of its numbers: "t [time] ×10⁻³".
std::string label_with_factor(const Axis& axis) {
  const auto factor = factor_of(axis.ticks);
  return factor.empty() ? axis.label : axis.label + "  " + factor;
}

void draw_x_axis(Svg& svg, const Frame& frame, const Axis& axis) {
  svg.open_group("x-axis");
  for (const double value : axis.ticks.values) {
    const double x = frame.place(value, 0).x;
    svg.line({x, frame.box.bottom}, {x, frame.box.bottom + tick_length}, {});
    if (axis.numbers)
      svg.text({x, frame.box.bottom + numbers_below - 2}, label_of(axis.ticks, value),
               {label_size, Anchor::middle});
  }
  if (axis.numbers)
    svg.text({(frame.box.left + frame.box.right) / 2, frame.box.bottom + label_below - 2},
             label_with_factor(axis), {label_size, Anchor::middle});
  svg.close_group();
}

void draw_y_axis(Svg& svg, const Frame& frame, const Axis& axis, double left_of) {
  svg.open_group("y-axis");
  constexpr double half_a_digit = 4.5;
  for (const double value : axis.ticks.values) {
    const double y = frame.place(0, value).y;
    svg.line({frame.box.left - tick_length, y}, {frame.box.left, y}, {});
    svg.text({frame.box.left - tick_length - 3, y + half_a_digit}, label_of(axis.ticks, value),
             {label_size, Anchor::end});
  }
  // Over the numbers: a label that is cut for want of room does not take the factor with it.
  svg.text({frame.box.left - tick_length - 3, frame.box.top - 6}, factor_of(axis.ticks),
           {label_size, Anchor::end});
  svg.text({frame.box.left - left_of, (frame.box.top + frame.box.bottom) / 2},
           cut_to_width(axis.label, label_size, frame.box.height() + 40),
           {label_size, Anchor::middle, text_colour, true});
  svg.close_group();
}

void draw_grid(Svg& svg, const Frame& frame, const Axis& x, const Axis& y) {
  svg.open_group("grid");
  for (const double value : x.ticks.values) {
    const double at = frame.place(value, 0).x;
    svg.line({at, frame.box.top}, {at, frame.box.bottom}, {grid_colour});
  }
  for (const double value : y.ticks.values) {
    const double at = frame.place(0, value).y;
    svg.line({frame.box.left, at}, {frame.box.right, at}, {grid_colour});
  }
  svg.close_group();
}

} // namespace

Ticks x_ticks(Range range, double pixels) {
  auto most = std::max(2, static_cast<int>(pixels / widest_x_label));
  auto ticks = ticks_in(range, most);
  // Long numbers, as of a small range around a large one, need more room.
  while (most > 2 && width_of_labels(ticks) > 0.9 * pixels / static_cast<double>(ticks.values.size()))
    ticks = ticks_in(range, --most);
  return ticks;
}

Ticks y_ticks(Range range, double pixels) {
  return ticks_in(range, std::max(2, static_cast<int>(pixels / y_label_distance)));
}

double width_of_labels(const Ticks& ticks) {
  double widest = 0;
  for (const double value : ticks.values)
    widest = std::max(widest, text_width(label_of(ticks, value), label_size));
  return widest;
}

void draw_axes(Svg& svg, const Frame& frame, const Axis& x, const Axis& y, double left_of) {
  draw_grid(svg, frame, x, y);
  svg.rectangle(frame.box, {"#222222", 1});
  draw_x_axis(svg, frame, x);
  draw_y_axis(svg, frame, y, left_of);
}

void draw_right_axis(Svg& svg, const Box& bar, Range range, const Axis& axis) {
  const Frame frame{bar, {0, 1}, range};
  constexpr double half_a_digit = 4.5;
  for (const double value : axis.ticks.values) {
    const double y = frame.place(0, value).y;
    svg.line({bar.right, y}, {bar.right + tick_length, y}, {});
    svg.text({bar.right + tick_length + 3, y + half_a_digit}, label_of(axis.ticks, value));
  }
  svg.text({bar.left, bar.top - 6}, factor_of(axis.ticks));
  const double beside = bar.right + tick_length + width_of_labels(axis.ticks) + 22;
  svg.text({beside, (bar.top + bar.bottom) / 2}, cut_to_width(axis.label, label_size, bar.height() + 70),
           {label_size, Anchor::middle, text_colour, true});
}

void draw_title_and_note(Svg& svg, Size size, const std::string& title, const std::string& note) {
  constexpr double margin = 12;
  const double room = size.width - 2 * margin;
  if (!title.empty())
    svg.text({size.width / 2.0, margin + title_size}, cut_to_width(title, title_size, room),
             {title_size, Anchor::middle});
  if (!note.empty())
    svg.text({size.width - margin, size.height - margin / 2}, cut_to_width(note, note_size, room),
             {note_size, Anchor::end, "#666666"});
}

} // namespace rubato::plot
