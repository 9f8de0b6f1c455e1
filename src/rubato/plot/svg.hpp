// SPDX-License-Identifier: LGPL-3.0-or-later
/// A drawing in lines, areas and text, as an SVG document. Places are in pixels, x to the right and y down.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::plot {

struct Size {
  int width = 0;  ///< pixels
  int height = 0; ///< pixels
};

struct Point {
  double x = 0;
  double y = 0;
};

struct Box {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

struct Stroke {
  std::string_view colour = "#222222";
  double width = 1;
  std::string_view dashes = {}; ///< as stroke-dasharray has them
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 13; ///< pixels
  Anchor anchor = Anchor::start;
  std::string_view colour = "#222222";
  bool upward = false; ///< turned by a right angle, read from below
};

/// How wide a text is, on the safe side: which font a viewer takes is not known.
double text_width(std::string_view text, double size);

/// The text, cut such that it is not wider, with "…" at the end then.
std::string cut_to_width(std::string_view text, double size, double width);

class Svg {
public:
  /// `title`: what the whole drawing is about, for readers that do not see it.
  Svg(Size size, const std::string& title);

  void line(Point a, Point b, const Stroke& stroke);
  void polyline(std::span<const Point> points, const Stroke& stroke);
  /// Closed lines of one colour without a border. `crisp`: areas side by side show no seam.
  void areas(std::span<const std::vector<Point>> outlines, std::string_view colour, bool crisp = true);
  void closed_line(std::span<const Point> points, const Stroke& stroke);
  void rectangle(const Box& box, const Stroke& stroke, std::string_view filled = "none");
  void dot(Point centre, double radius, std::string_view colour);
  void ring(Point centre, double radius, const Stroke& stroke);
  /// Nothing when the text is empty.
  void text(Point at, std::string_view text, const TextStyle& style = {});

  /// Everything up to close_group belongs together. `what`: its class; `title`: shown by viewers that are
  /// pointed at it.
  void open_group(std::string_view what, const std::string& title = "");
  void close_group();

  /// The whole document.
  std::string finish() &&;

private:
  std::string text_;
};

} // namespace rubato::plot
