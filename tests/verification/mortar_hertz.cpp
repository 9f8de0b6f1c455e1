// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/mortar_hertz.hpp"

#include "rubato/model/build_model.hpp"

#include <fmt/format.h>

#include "support/walk.hpp"
#include "verification/hertz.hpp"
#include "verification/mortar_runs.hpp"
#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <utility>
#include <vector>

namespace rubato::verification {
namespace {

using std::numbers::pi;

constexpr double young = 2e5, poisson = 0.3;
constexpr double modulus = young / (1 - poisson * poisson) / 2; ///< E*
constexpr double half_width = 1;                                ///< a
constexpr double radius = 20;                                   ///< R
constexpr double size = 8;                                      ///< of the bodies, in every direction

bool is_solid(CellType cells) {
  return cell::topology(cells).dimension == 3;
}

/// Cells of `fine` up to `until`, then growing by `growth` until `size`.
std::vector<double> ticks(double fine, double until, double growth) {
  std::vector<double> at{0};
  double step = fine;
  while (at.back() < size - 1e-9) {
    if (at.back() >= until - 1e-9)
      step *= growth;
    at.push_back(at.back() + step);
  }
  const double reached = at.back() - until;
  for (auto& x : at) // the growing part ends at `size`
    if (x > until)
      x = until + (x - until) * (size - until) / reached;
  return at;
}

/// The ticks, between them in proportion, of a coordinate that counts cells.
double place(const std::vector<double>& at, double count) {
  const auto last = static_cast<double>(at.size() - 2);
  const double first = std::clamp(std::floor(count), 0.0, last);
  const auto i = static_cast<std::size_t>(first);
  return at[i] + (count - first) * (at[i + 1] - at[i]);
}

struct Grid {
  std::vector<double> across, down;
};

Grid grid_of(double fine, bool solid) {
  const double growth = solid ? 1.5 : 1.25;
  return {ticks(fine, 1.2 * half_width, growth), ticks(fine, (solid ? 0 : 0.6) * half_width, growth)};
}

std::string body(const char* name, const Grid& grid, CellType cells, const char* sides) {
  const auto across = grid.across.size() - 1;
  const auto down = grid.down.size() - 1;
  return is_solid(cells)
             ? fmt::format(
                   "    - {{name: {0}, box: {{from: [0, 0, 0], to: [{1}, {2}, {1}]}}, divisions: [{1}, {2}, "
                   "{1}], cells: {3}, sides: {{left: middle, back: other_middle, {4}}}}}\n",
                   name, across, down, word_of(cells), sides)
             : fmt::format(
                   "    - {{name: {0}, rectangle: {{from: [0, 0], to: [{1}, {2}]}}, divisions: [{1}, {2}], "
                   "cells: {3}, sides: {{left: middle, {4}}}}}\n",
                   name, across, down, word_of(cells), sides);
}

double force_by_hertz(bool solid) {
  return solid ? 4 * modulus * std::pow(half_width, 3) / (3 * radius)
               : pi * modulus * half_width * half_width / (4 * radius);
}

double peak_by_hertz(bool solid) {
  return solid ? 2 * modulus * half_width / (pi * radius) : modulus * half_width / (2 * radius);
}

std::string deck_of(const RoundOnBlock& bodies, const Grid& round, const Grid& block) {
  const bool solid = is_solid(bodies.cells);
  const double roof = solid ? force_by_hertz(true) / (4 * size * size) : force_by_hertz(false) / (2 * size);
  return fmt::format(R"(mesh:
  generate:
{}{}physics: {}
materials: {{steel: {{young: {}, poisson: {}}}}}
supports:
  - {{on: ground, fix: y}}
  - {{on: middle, fix: x}}
{}loads: [{{pressure: {{on: roof, value: {:.17g}}}}}]
contact: {{touch: {{master: {}, slave: {}, integration: {}}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     body("round", round, bodies.cells, "bottom: above, top: roof"),
                     body("block", block, bodies.cells, "bottom: ground, top: below"),
                     solid ? "solid" : "plane_strain", young, poisson,
                     solid ? "  - {on: other_middle, fix: z}\n" : "", roof,
                     bodies.round_is_slave ? "below" : "above", bodies.round_is_slave ? "above" : "below",
                     bodies.integration);
}

/// From counts of cells to places: the round body rises from its lowest point at the origin, its roof stays
/// flat; the block is below y = 0.
mesh::Mesh shaped(mesh::Mesh mesh, const Grid& round, const Grid& block) {
  const bool solid = mesh.dimension == 3;
  for (const auto node : mesh::nodes_named(mesh, "round")) {
    auto& x = mesh.points[static_cast<std::size_t>(node)];
    x = {place(round.across, x.x()), place(round.down, x.y()), solid ? place(round.across, x.z()) : 0};
    const double along = x.x() * x.x() + x.z() * x.z();
    const double rise = solid ? along / (2 * radius) : radius - std::sqrt(radius * radius - along);
    x.y() += rise * (1 - x.y() / size);
  }
  const auto rows = static_cast<double>(block.down.size() - 1);
  for (const auto node : mesh::nodes_named(mesh, "block")) {
    auto& x = mesh.points[static_cast<std::size_t>(node)];
    x = {place(block.across, x.x()), -place(block.down, rows - x.y()),
         solid ? place(block.across, x.z()) : 0};
  }
  return mesh;
}

std::vector<SurfacePoint> points_of(const test::Walk& walk) {
  std::vector<SurfacePoint> points;
  const auto& status = walk.state().zones.front().status;
  for (std::size_t i = 0; i < walk.slave_count(); ++i) {
    const auto& x = walk.slave_point(i);
    points.push_back({std::hypot(x.x(), x.z()), walk.pressure(i), 0, status[i]});
  }
  std::ranges::sort(points, {}, &SurfacePoint::x);
  return points;
}

void compare(const std::vector<SurfacePoint>& points, double peak, HertzErrors& errors) {
  int touching = 0;
  for (const auto& point : points) {
    const double s = point.x / half_width;
    const double error = std::abs(point.pressure / peak - (s < 1 ? std::sqrt(1 - s * s) : 0));
    errors.anywhere = std::max(errors.anywhere, error);
    if (s < 0.85)
      errors.inside = std::max(errors.inside, error);
    if (point.status == contact::Status::open)
      continue;
    errors.rms += error * error;
    ++touching;
  }
  errors.rms = std::sqrt(errors.rms / touching);
  errors.centre = std::abs(points.front().pressure / peak - 1);
  const auto ellipse = fitted_ellipse(points);
  errors.peak = ellipse.peak / peak - 1;
  errors.radius = ellipse.half_width / half_width - 1;
  errors.largest = largest_pressure(points) / peak - 1;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

} // namespace

HertzErrors press_round(const RoundOnBlock& bodies) {
  const bool solid = is_solid(bodies.cells);
  const double fine = half_width / bodies.faces;
  constexpr double coarser = 1.2; // so that the meshes don't match
  const auto round = grid_of(fine, solid);
  const auto block = grid_of(coarser * fine, solid);
  const double start = processor_seconds();
  const auto study = deck::parse_deck(deck_of(bodies, round, block), "deck.yaml", {}).runs.front();
  test::Walk walk(study, shaped(model::load_mesh(study.mesh), round, block));
  HertzErrors errors;
  const bool complete = walk.to_end();
  errors.seconds = processor_seconds() - start;
  errors.nodes = walk.model.mesh.node_count();
  for (const auto& report : walk.reports)
    errors.iterations += report.iterations;
  if (complete)
    compare(points_of(walk), peak_by_hertz(solid), errors);
  else
    errors.failure = step::to_string(walk.reports.back().outcome);
  return errors;
}

} // namespace rubato::verification
