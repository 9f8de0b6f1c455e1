// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/svg.hpp"

#include "rubato/mesh/io/vtu.hpp"

#include <fmt/format.h>

#include <iterator>

namespace rubato::plot {
namespace {

/// DejaVu Sans is there on Debian; Verdana has its widths.
constexpr std::string_view fonts = "DejaVu Sans, Verdana, Arial, Helvetica, sans-serif";
/// Of a letter, over the size of the text: the digits of these fonts.
constexpr double letter_width = 0.64;

bool begins_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; // the others continue a letter of UTF-8
}

std::string dashes_of(const Stroke& stroke) {
  return stroke.dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", stroke.dashes);
}

std::string stroke_of(const Stroke& stroke) {
  return fmt::format("stroke=\"{}\" stroke-width=\"{:g}\"{}", stroke.colour, stroke.width, dashes_of(stroke));
}

/// A thousandth of a pixel, without zeros at the end.
std::string pixels(double value) {
  auto text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.'))
    text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string places(std::span<const Point> points) {
  std::string text;
  for (const auto& point : points)
    fmt::format_to(std::back_inserter(text), "{}{},{}", text.empty() ? "" : " ", pixels(point.x),
                   pixels(point.y));
  return text;
}

/// As XML takes it: titles of decks may have breaks of lines and the like.
std::string written(std::string text) {
  for (auto& letter : text)
    if (static_cast<unsigned char>(letter) < ' ')
      letter = ' ';
  return mesh::xml_escaped(text);
}

std::string_view anchor_word(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

} // namespace

double text_width(std::string_view text, double size) {
  double letters = 0;
  for (const char byte : text)
    letters += begins_letter(byte) ? 1 : 0;
  return letters * size * letter_width;
}

std::string cut_to_width(std::string_view text, double size, double width) {
  if (text_width(text, size) <= width)
    return std::string(text);
  std::string cut;
  for (const char byte : text) {
    if (begins_letter(byte) && text_width(cut, size) + 2 * size * letter_width > width)
      break;
    cut += byte;
  }
  return cut + "…";
}

Svg::Svg(Size size, const std::string& title) {
  text_ =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
                  "{1}\" font-family=\"{2}\">\n"
                  "<title>{3}</title>\n"
                  "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
                  size.width, size.height, fonts, written(title));
}

void Svg::line(Point a, Point b, const Stroke& stroke) {
  text_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", pixels(a.x), pixels(a.y),
                       pixels(b.x), pixels(b.y), stroke_of(stroke));
}

void Svg::polyline(std::span<const Point> points, const Stroke& stroke) {
  text_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke-linejoin=\"round\" {}/>\n",
                       places(points), stroke_of(stroke));
}

void Svg::areas(std::span<const std::vector<Point>> outlines, std::string_view colour, bool crisp) {
  std::string path;
  for (const auto& outline : outlines)
    path += "M" + places(outline) + "z";
  text_ += fmt::format("<path d=\"{}\" fill=\"{}\"{}/>\n", path, colour,
                       crisp ? " shape-rendering=\"crispEdges\"" : "");
}

void Svg::closed_line(std::span<const Point> points, const Stroke& stroke) {
  text_ += fmt::format("<polygon points=\"{}\" fill=\"none\" stroke-linejoin=\"round\" {}/>\n",
                       places(points), stroke_of(stroke));
}

void Svg::rectangle(const Box& box, const Stroke& stroke, std::string_view filled) {
  text_ +=
      fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" {}/>\n", pixels(box.left),
                  pixels(box.top), pixels(box.width()), pixels(box.height()), filled, stroke_of(stroke));
}

void Svg::dot(Point centre, double radius, std::string_view colour) {
  text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:g}\" fill=\"{}\"/>\n", pixels(centre.x),
                       pixels(centre.y), radius, colour);
}

void Svg::ring(Point centre, double radius, const Stroke& stroke) {
  text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:g}\" fill=\"none\" {}/>\n", pixels(centre.x),
                       pixels(centre.y), radius, stroke_of(stroke));
}

void Svg::text(Point at, std::string_view text, const TextStyle& style) {
  if (text.empty())
    return;
  const auto turned =
      style.upward ? fmt::format(" transform=\"rotate(-90 {} {})\"", pixels(at.x), pixels(at.y)) : "";
  text_ += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n", pixels(at.x),
      pixels(at.y), style.size, anchor_word(style.anchor), style.colour, turned, written(std::string(text)));
}

void Svg::open_group(std::string_view what, const std::string& title) {
  text_ += fmt::format("<g class=\"{}\">\n", what);
  if (!title.empty())
    text_ += fmt::format("<title>{}</title>\n", written(title));
}

void Svg::close_group() {
  text_ += "</g>\n";
}

std::string Svg::finish() && {
  text_ += "</svg>\n";
  return std::move(text_);
}

} // namespace rubato::plot
