// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/figure.hpp"

#include "rubato/core/error.hpp"
#include "rubato/plot/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::plot {
namespace {

constexpr double side_margin = 14;
constexpr double top_margin = 14;
constexpr double title_height = 24;
constexpr double legend_row = 20;
constexpr double between_panels = 18;
constexpr double note_height = 18;
constexpr double least_panel = 60;
/// Curves keep this part of the height free above and below, and to the sides where the axis is not the time.
constexpr double curve_margin = 0.05;

/// Points nearer than this to the last one that is drawn show nothing new; looked at in long curves only.
constexpr double least_distance = 0.1;
constexpr std::size_t long_curve = 20'000;

struct LegendEntry {
  std::string label;
  LineStyle style;
  Mark mark = Mark::line;
  double left = 0; ///< from the left of the box
  int row = 0;
};

struct Legend {
  std::vector<LegendEntry> entries;
  int rows = 0;
};

constexpr double sample_width = 26;
constexpr double sample_gap = 6;
constexpr double entry_gap = 18;

bool is_entry_of(const LegendEntry& entry, const Curve& curve) {
  return entry.label == curve.label && entry.mark == curve.mark &&
         (entry.mark == Mark::rings ||
          (entry.style.colour == curve.style.colour && entry.style.dashes == curve.style.dashes));
}

/// Entries side by side, in as many rows as they need.
Legend legend_of(const Panel& panel, double width) {
  Legend legend;
  double left = 0;
  for (const auto& curve : panel.curves) {
    if (std::ranges::any_of(legend.entries, [&](const auto& entry) { return is_entry_of(entry, curve); }))
      continue;
    const auto label = cut_to_width(curve.label, label_size, width - sample_width - sample_gap);
    const double entry_width = sample_width + sample_gap + text_width(label, label_size);
    if (left > 0 && left + entry_width > width) {
      left = 0;
      ++legend.rows;
    }
    legend.entries.push_back({label, curve.style, curve.mark, left, legend.rows});
    left += entry_width + entry_gap;
  }
  ++legend.rows;
  return legend;
}

Range all_x(const Figure& figure) {
  std::vector<double> values;
  for (const auto& panel : figure.panels)
    for (const auto& curve : panel.curves)
      values.insert(values.end(), curve.x.begin(), curve.x.end());
  return range_of(values, figure.time_axis ? 0 : curve_margin);
}

Range all_y(const Panel& panel) {
  std::vector<double> values;
  for (const auto& curve : panel.curves)
    values.insert(values.end(), curve.y.begin(), curve.y.end());
  return range_of(values, curve_margin);
}

/// Where each panel is, and what it has around it.
struct Layout {
  double left_of = 0; ///< from a box to the text of its y axis
  std::vector<Frame> frames;
  std::vector<Legend> legends;
};

double panels_top(const Figure& figure) {
  return top_margin + (figure.title.empty() ? 0 : title_height);
}

double below_panels(const Figure& figure) {
  return label_below + (figure.note.empty() ? 0 : note_height);
}

/// The y axes stand below one another; the widest numbers decide where.
double widest_numbers(const Figure& figure, double height) {
  double widest = 0;
  for (const auto& panel : figure.panels)
    widest = std::max(widest, width_of_labels(y_ticks(all_y(panel), height)));
  return widest;
}

Layout layout_of(const Figure& figure, Size size) {
  const auto count = static_cast<double>(figure.panels.size());
  const double room = size.height - panels_top(figure) - below_panels(figure) - (count - 1) * between_panels;
  Layout layout;
  layout.left_of = widest_numbers(figure, room / count) + 16;
  const double left = side_margin + label_size + layout.left_of - 6;
  const double right = size.width - side_margin - 10;
  double legend_rows = 0;
  for (const auto& panel : figure.panels) {
    layout.legends.push_back(legend_of(panel, right - left));
    legend_rows += layout.legends.back().rows;
  }
  const double height = (room - legend_rows * legend_row) / count;
  if (height < least_panel || right - left < 2 * least_panel)
    throw InputError(fmt::format("found a size of {} x {} pixels, which has no room for {} panel{} of curves",
                                 size.width, size.height, count, count == 1 ? "" : "s"));
  double top = panels_top(figure);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    top += layout.legends[i].rows * legend_row;
    layout.frames.push_back({{left, top, right, top + height}, all_x(figure), all_y(figure.panels[i])});
    top += height + between_panels;
  }
  return layout;
}

Stroke stroke_of(const LineStyle& style) {
  return {style.colour, 1.8, style.dashes};
}

void draw_mark(Svg& svg, Point at, const LineStyle& style, Mark mark) {
  constexpr double dot_radius = 2.2;
  constexpr double ring_radius = 4.5;
  if (mark == Mark::rings)
    svg.ring(at, ring_radius, {style.colour, 1.5});
  else
    svg.dot(at, dot_radius, style.colour);
}

void draw_legend(Svg& svg, const Legend& legend, const Box& box) {
  svg.open_group("legend");
  for (const auto& entry : legend.entries) {
    const double x = box.left + entry.left;
    const double y = box.top - (legend.rows - entry.row) * legend_row + legend_row / 2 - 2;
    if (entry.mark == Mark::line)
      svg.line({x, y}, {x + sample_width, y}, stroke_of(entry.style));
    else
      draw_mark(svg, {x + sample_width / 2, y},
                entry.mark == Mark::rings ? LineStyle{"#222222", ""} : entry.style, entry.mark);
    svg.text({x + sample_width + sample_gap, y + 4.5}, entry.label);
  }
  svg.close_group();
}

/// The unbroken parts of a curve, in pixels.
std::vector<std::vector<Point>> parts_of(const Curve& curve, const Frame& frame) {
  std::vector<std::vector<Point>> parts(1);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]))
      parts.back().push_back(frame.place(curve.x[i], curve.y[i]));
    else if (!parts.back().empty())
      parts.emplace_back();
  }
  if (parts.back().empty())
    parts.pop_back();
  return parts;
}

/// Without points that lie on the last one that is drawn.
std::vector<Point> thinned(const std::vector<Point>& points) {
  if (points.size() < long_curve)
    return points;
  std::vector<Point> kept;
  for (const auto& point : points)
    if (kept.empty() || std::hypot(point.x - kept.back().x, point.y - kept.back().y) >= least_distance)
      kept.push_back(point);
  kept.push_back(points.back());
  return kept;
}

void draw_curve(Svg& svg, const Curve& curve, const Frame& frame) {
  svg.open_group("curve", curve.label);
  for (const auto& part : parts_of(curve, frame)) {
    if (curve.mark == Mark::line && part.size() > 1)
      svg.polyline(thinned(part), stroke_of(curve.style));
    else
      for (const auto& point : part)
        draw_mark(svg, point, curve.style, curve.mark);
  }
  svg.close_group();
}

} // namespace

int usual_height(const Figure& figure) {
  constexpr double panel_height = 300;
  constexpr double further_panel_height = 200;
  double height = panels_top(figure) + below_panels(figure);
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    height += figure.panels.size() == 1 ? panel_height + legend_row : further_panel_height + legend_row;
  return static_cast<int>(height);
}

std::string to_svg(const Figure& figure, Size size) {
  const auto layout = layout_of(figure, size);
  Svg svg(size, figure.title);
  draw_title_and_note(svg, size, figure.title, figure.note);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const auto& frame = layout.frames[i];
    const bool lowest = i + 1 == figure.panels.size();
    svg.open_group("panel", figure.panels[i].label);
    draw_axes(svg, frame, {x_ticks(frame.x, frame.box.width()), figure.x_label, lowest},
              {y_ticks(frame.y, frame.box.height()), figure.panels[i].label}, layout.left_of);
    draw_legend(svg, layout.legends[i], frame.box);
    for (const auto& curve : figure.panels[i].curves)
      draw_curve(svg, curve, frame);
    svg.close_group();
  }
  return std::move(svg).finish();
}

} // namespace rubato::plot
