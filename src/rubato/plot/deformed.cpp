// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/deformed.hpp"

#include "rubato/core/error.hpp"
#include "rubato/plot/axes.hpp"
#include "rubato/plot/colours.hpp"
#include "rubato/plot/facets.hpp"
#include "rubato/plot/snapshot.hpp"
#include "rubato/study/words.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace rubato::plot {
namespace {

using Eigen::Vector3d;

constexpr int colour_count = 64;
/// Lines between more facets than these would hide the colours.
constexpr std::size_t most_outlined = 5000;
constexpr double bar_width = 18;
constexpr double bar_distance = 22;
constexpr double top_space = 40;

/// From places in space to the plane of the picture: x to the right, y up, z to the viewer.
Eigen::Matrix3d view_matrix(const std::array<double, 2>& view) {
  const double azimuth = view[0] * std::numbers::pi / 180;
  const double elevation = view[1] * std::numbers::pi / 180;
  const Vector3d to_viewer(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                           std::sin(elevation));
  const Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0);
  Eigen::Matrix3d matrix;
  matrix.row(0) = right;
  matrix.row(1) = to_viewer.cross(right);
  matrix.row(2) = to_viewer;
  return matrix;
}

/// What is drawn, in the plane of the picture and in the order of drawing.
struct Scene {
  std::vector<Facet> facets;
  std::vector<std::vector<Vector3d>> borders; ///< in the plane
  Range values;
  bool is_plane = true;
  Eigen::Matrix3d view = Eigen::Matrix3d::Identity();
};

/// Whether a facet shows its outside. One that is seen from its edge does not.
bool faces_viewer(const Facet& facet) {
  Vector3d area = Vector3d::Zero();
  for (std::size_t i = 0; i < facet.outline.size(); ++i)
    area += facet.outline[i].cross(facet.outline[(i + 1) % facet.outline.size()]);
  constexpr double edge_on = 1e-9;
  return area.z() > edge_on * area.norm();
}

double depth(const Facet& facet) {
  double sum = 0;
  for (const auto& point : facet.outline)
    sum += point.z();
  return sum / static_cast<double>(facet.outline.size());
}

/// Turns facets to the viewer, removes those that are seen from behind and puts the nearest last.
void look_at(std::vector<Facet>& facets, const Eigen::Matrix3d& view) {
  for (auto& facet : facets) {
    for (auto& point : facet.outline)
      point = view * point;
    for (auto& patch : facet.patches)
      for (auto& corner : patch.corners)
        corner = view * corner;
  }
  std::erase_if(facets, [](const Facet& facet) { return !faces_viewer(facet); });
  std::ranges::stable_sort(facets, {}, depth);
}

Scene scene_of(const Snapshot& snapshot, const NodeValues& values, const DeformedChoice& choice) {
  Scene scene;
  auto points = displacements(snapshot);
  for (std::size_t node = 0; node < points.size(); ++node)
    points[node] = snapshot.mesh.points[node] + choice.scale * points[node];
  scene.facets = facets(snapshot.mesh, points, values.values);
  scene.is_plane = snapshot.mesh.dimension == 2;
  if (scene.is_plane) {
    scene.borders = border_lines(snapshot.mesh, points);
  } else {
    scene.view = view_matrix(choice.view);
    look_at(scene.facets, scene.view);
  }
  scene.values = choice.range.value_or(range_of(values.values));
  return scene;
}

Frame extent_of(const Scene& scene) {
  std::vector<double> x;
  std::vector<double> y;
  for (const auto& facet : scene.facets)
    for (const auto& point : facet.outline) {
      x.push_back(point.x());
      y.push_back(point.y());
    }
  constexpr double margin = 0.03;
  return {{}, range_of(x, margin), range_of(y, margin)};
}

/// Widens the shorter range such that a length is as long in both directions.
void make_true_to_scale(Frame& frame) {
  const double unit = std::max(frame.x.length() / frame.box.width(), frame.y.length() / frame.box.height());
  const auto widen = [&](Range& range, double pixels) {
    const double more = (unit * pixels - range.length()) / 2;
    range = {range.low - more, range.high + more};
  };
  widen(frame.x, frame.box.width());
  widen(frame.y, frame.box.height());
}

struct DeformedLayout {
  Size size;
  Frame frame;
  double left_of = 0;
  Box bar = {};
};

DeformedLayout deformed_layout(const Scene& scene, int width, std::optional<int> height) {
  DeformedLayout layout{.size = {width, 0}, .frame = extent_of(scene)};
  auto& frame = layout.frame;
  constexpr double usual_bar_height = 300;
  layout.left_of = scene.is_plane ? width_of_labels(y_ticks(frame.y, usual_bar_height)) + 16 : 0;
  const double left = scene.is_plane ? 14 + label_size + layout.left_of - 6 : 20;
  const double numbers = width_of_labels(y_ticks(scene.values, usual_bar_height));
  const double right = width - (bar_distance + bar_width + numbers + 44);
  const double below = (scene.is_plane ? label_below : 12) + 20;
  constexpr double least_height = 210; // of the label beside the bar
  constexpr double most_height = 700;
  const double wanted =
      std::clamp((right - left) * frame.y.length() / frame.x.length(), least_height, most_height);
  layout.size.height = height.value_or(static_cast<int>(std::ceil(top_space + wanted + below)));
  frame.box = {left, top_space, right, layout.size.height - below};
  if (frame.box.width() < 100 || frame.box.height() < 60)
    throw InputError(fmt::format("found a size of {} x {} pixels, which has no room for the picture", width,
                                 layout.size.height));
  make_true_to_scale(frame);
  layout.bar = {right + bar_distance, frame.box.top, right + bar_distance + bar_width, frame.box.bottom};
  return layout;
}

std::vector<Point> placed(std::span<const Vector3d> points, const Frame& frame) {
  std::vector<Point> found(points.size());
  std::ranges::transform(points, found.begin(),
                         [&](const Vector3d& point) { return frame.place(point.x(), point.y()); });
  return found;
}

int colour_number(double value, const Range& range) {
  const double part = std::clamp((value - range.low) / range.length(), 0.0, 1.0);
  return std::min(static_cast<int>(part * colour_count), colour_count - 1);
}

std::string colour_of(int number) {
  return range_colour(static_cast<double>(number) / (colour_count - 1));
}

using AreasByColour = std::map<int, std::vector<std::vector<Point>>>;

void add_areas(const Facet& facet, const Frame& frame, const Range& range, AreasByColour& areas) {
  for (const auto& patch : facet.patches)
    areas[colour_number(patch.value, range)].push_back(placed(patch.corners, frame));
}

void draw_areas(Svg& svg, const AreasByColour& areas) {
  for (const auto& [number, outlines] : areas)
    svg.areas(outlines, colour_of(number));
}

constexpr Stroke cell_stroke{"#333333", 0.3};

void draw_plane(Svg& svg, const Scene& scene, const Frame& frame) {
  AreasByColour areas;
  for (const auto& facet : scene.facets)
    add_areas(facet, frame, scene.values, areas);
  draw_areas(svg, areas);
  if (scene.facets.size() <= most_outlined)
    for (const auto& facet : scene.facets)
      svg.closed_line(placed(facet.outline, frame), cell_stroke);
  for (const auto& line : scene.borders)
    svg.polyline(placed(line, frame), {"#000000", 1});
}

void draw_space(Svg& svg, const Scene& scene, const Frame& frame) {
  for (const auto& facet : scene.facets) {
    AreasByColour areas;
    add_areas(facet, frame, scene.values, areas);
    draw_areas(svg, areas);
    if (scene.facets.size() <= most_outlined)
      svg.closed_line(placed(facet.outline, frame), cell_stroke);
  }
}

/// The directions of the axes, in the lower left corner.
void draw_triad(Svg& svg, const Scene& scene, const Frame& frame) {
  constexpr double length = 32;
  const Point origin{frame.box.left + length, frame.box.bottom - length / 2};
  svg.open_group("axes");
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d direction = scene.view.col(axis);
    const Point end{origin.x + length * direction.x(), origin.y - length * direction.y()};
    svg.line(origin, end, {"#222222", 1.2});
    svg.text({origin.x + (length + 9) * direction.x(), origin.y - (length + 9) * direction.y() + 4},
             study::axis_words[static_cast<std::size_t>(axis)], {12, Anchor::middle});
  }
  svg.close_group();
}

void draw_bar(Svg& svg, const Box& bar, const Range& range, const std::string& label) {
  svg.open_group("colour-bar");
  const double height = bar.height() / colour_count;
  for (int i = 0; i < colour_count; ++i) {
    const double bottom = bar.bottom - i * height;
    const std::vector<Point> area{
        {bar.left, bottom}, {bar.right, bottom}, {bar.right, bottom - height}, {bar.left, bottom - height}};
    svg.areas(std::span(&area, 1), colour_of(i));
  }
  svg.rectangle(bar, {"#222222", 1});
  draw_right_axis(svg, bar, range, {y_ticks(range, bar.height()), label});
  svg.close_group();
}

std::string note_of(const PlottedRun& run, const DeformedChoice& choice) {
  const auto units = units_of(std::span(&run, 1));
  return choice.scale == 1 ? units
                           : fmt::format("{}; displacements enlarged {:g} times", units, choice.scale);
}

} // namespace

std::string deformed_svg(const PlottedRun& run, const DeformedChoice& choice, int width,
                         std::optional<int> height) {
  const auto snapshot = read_snapshot(run.folder, choice.at, study::dimension_of(run.study.physics));
  const auto values = node_values(snapshot, choice.field);
  const auto scene = scene_of(snapshot, values, choice);
  const auto layout = deformed_layout(scene, width, height);
  const auto title = fmt::format("{}, t = {:.6g}", title_of(std::span(&run, 1)), snapshot.t);
  Svg svg(layout.size, title);
  draw_title_and_note(svg, layout.size, title, note_of(run, choice));
  const auto& frame = layout.frame;
  if (scene.is_plane) {
    const auto length = dimension_of("x");
    draw_axes(svg, frame, {x_ticks(frame.x, frame.box.width()), with_dimension("x", length)},
              {y_ticks(frame.y, frame.box.height()), with_dimension("y", length)}, layout.left_of);
  }
  svg.open_group("bodies");
  (scene.is_plane ? draw_plane : draw_space)(svg, scene, frame);
  svg.close_group();
  if (!scene.is_plane)
    draw_triad(svg, scene, frame);
  draw_bar(svg, layout.bar, scene.values, with_dimension(values.name, values.dimension));
  return std::move(svg).finish();
}

} // namespace rubato::plot
