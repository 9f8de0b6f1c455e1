// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/hertz.hpp"

#include "rubato/contact/zone.hpp"

#include <Eigen/Core>

#include "support/dense.hpp"
#include "support/model_of.hpp"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace rubato::verification {

HertzLine hertz_line(double load, double radius, double modulus) {
  const double half_width = std::sqrt(4 * load * radius / (std::numbers::pi * modulus));
  return {half_width, 2 * load / (std::numbers::pi * half_width)};
}

HertzLine v4_theory() {
  const double compliance = (1 - 0.3 * 0.3) * (1 / 210e3 + 1 / 70e3);
  return hertz_line(35e3, 50, 1 / compliance);
}

MindlinTheory mindlin_theory(const CaseRun& run) {
  const auto& table = run.resultants.at("interface");
  const double normal = column(table, "force.y").back();
  const double tangential = std::abs(column(table, "force.x").back());
  MindlinTheory theory;
  theory.friction = run.study.contact.front().friction;
  const auto& steel = run.study.materials.front();
  theory.normal = hertz_line(normal, 50, steel.young / (1 - steel.poisson * steel.poisson) / 2);
  theory.mobilised = tangential / (theory.friction * normal);
  theory.stick = theory.normal.half_width * std::sqrt(1 - theory.mobilised);
  return theory;
}

double largest_pressure(const std::vector<SurfacePoint>& points) {
  return std::ranges::max(points, {}, &SurfacePoint::pressure).pressure;
}

std::vector<SurfacePoint> surface_at_end(const CaseRun& run) {
  const test::BuiltModel model(run.study);
  const auto& zone = model.zones.front();
  const auto& state = run.result.end.zones.front();
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const auto& point = zone.points[i];
    double x = 0;
    for (std::size_t n = 0; n < point.nodes.size(); ++n)
      x += point.shape[n] * model.mesh.points[static_cast<std::size_t>(point.nodes[n])][0];
    const auto& outcome = state.outcomes[i];
    points.push_back({x, outcome.pressure, outcome.tangential[0] / point.area, state.status[i]});
  }
  std::ranges::sort(points, {}, &SurfacePoint::x);
  return points;
}

HertzLine fitted_ellipse(const std::vector<SurfacePoint>& points) {
  const double largest = largest_pressure(points);
  const bool half = points.front().x >= 0; // of a symmetric model
  double weight = 0;
  double moment = 0;
  for (const auto& point : points) {
    weight += point.pressure;
    moment += half ? 0 : point.pressure * point.x;
  }
  const double centre = moment / weight;
  std::vector<SurfacePoint> used;
  std::ranges::copy_if(points, std::back_inserter(used),
                       [&](const auto& point) { return point.pressure > largest / 5; });
  Eigen::MatrixX2d sides(used.size(), 2); // p² = A + B (x − x₀)²
  Eigen::VectorXd squares(sides.rows());
  for (Eigen::Index i = 0; i < sides.rows(); ++i) {
    const auto& point = used[static_cast<std::size_t>(i)];
    sides.row(i) << 1, std::pow(point.x - centre, 2);
    squares[i] = point.pressure * point.pressure;
  }
  const Eigen::Vector2d fit = test::least_squares(sides, squares);
  return {std::sqrt(-fit[0] / fit[1]), std::sqrt(fit[0])};
}

double mindlin_traction(double x, double a, double c) {
  const auto ellipse = [x](double half_width) {
    return std::abs(x) < half_width ? std::sqrt(1 - x * x / (half_width * half_width)) : 0.0;
  };
  return ellipse(a) - c / a * ellipse(c);
}

double stick_half_width(const std::vector<SurfacePoint>& points) {
  const auto sticks = [](const SurfacePoint& point) { return point.status == contact::Status::stick; };
  const auto first = std::ranges::find_if(points, sticks);
  const auto last = std::find_if(points.rbegin(), points.rend(), sticks).base() - 1;
  const double left = (first->x + std::prev(first)->x) / 2;
  const double right = (last->x + std::next(last)->x) / 2;
  return (right - left) / 2;
}

double traction_error(const std::vector<SurfacePoint>& points, const MindlinTheory& theory) {
  double squares = 0;
  int count = 0;
  for (const auto& point : points) {
    if (point.status == contact::Status::open)
      continue;
    const double found = std::abs(point.traction) / (theory.friction * theory.normal.peak);
    squares += std::pow(found - mindlin_traction(point.x, theory.normal.half_width, theory.stick), 2);
    ++count;
  }
  return std::sqrt(squares / count);
}

} // namespace rubato::verification
