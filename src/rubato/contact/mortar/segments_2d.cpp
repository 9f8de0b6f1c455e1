// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/segments.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int max_line_iterations = 40;
constexpr double largest_step = 1;
/// Projections are looked for up to there on the slave's reference line.
constexpr double farthest_root = 2;
constexpr double last_line_step = 1e-8;
/// Pieces shorter than that on the slave's reference line are rounding.
constexpr double least_piece = 1e-10;
/// How far outside, on the master's reference line, a place still belongs to the face.
constexpr double line_outside = 0.5;

double plane_cross(const Vector3d& a, const Vector3d& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Values of nodes along a line, interpolated.
struct Along {
  Vector3d value, slope;
};

Along along(CellType type, const FaceCoordinates& nodes, double xi) {
  const auto start = column_of(nodes, 0), end = column_of(nodes, 1);
  if (type == CellType::seg2)
    return {sum_of(scaled(0.5 * (1 - xi), start), scaled(0.5 * (1 + xi), end)),
            scaled(0.5, difference_of(end, start))};
  const auto middle = column_of(nodes, 2);
  const Vector3d ends = sum_of(scaled(0.5 * xi * (xi - 1), start), scaled(0.5 * xi * (xi + 1), end));
  const Vector3d slopes = sum_of(scaled(xi - 0.5, start), scaled(xi + 0.5, end));
  return {sum_of(ends, scaled(1 - xi * xi, middle)), difference_of(slopes, scaled(2 * xi, middle))};
}

struct Root {
  double at = 0;
  bool found = false;
};

/// Newton's method for f(s) = 0 where f tells value and slope.
template <class Function> Root newton(double start, double limit, const Function& f) {
  Root root{.at = start};
  for (int iteration = 0; iteration < max_line_iterations; ++iteration) {
    const auto [value, slope] = f(root.at);
    const double step = -value / slope;
    if (!std::isfinite(step))
      return value == 0 ? Root{root.at, true} : root;
    const double before = root.at;
    root.at = std::clamp(before + std::clamp(step, -largest_step, largest_step), -limit, limit);
    if (std::abs(step) <= last_line_step) {
      root.found = true;
      return root;
    }
    if (root.at == before) // held at the limit: the root is beyond
      return {root.at, true};
  }
  return root;
}

/// Where the sign changes between −1 and 1.
template <class Function> double by_bisection(const Function& f) {
  double low = -1, high = 1;
  const double at_low = f(low)[0];
  while (high - low > 1e-15 && 0.5 * (low + high) != low && 0.5 * (low + high) != high) {
    const double middle = 0.5 * (low + high);
    (f(middle)[0] * at_low > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// ξ of the slave with (x_s(ξ) − x) × n(ξ) = 0, held between the limits. Nothing where x is beyond the point
/// at which lines along the normals of the slave's ends cross: places come in the opposite order there. The
/// sides of those two lines that x is on decide whether ξ is on the face: the equation has roots beyond the
/// crossing too.
std::optional<double> slave_place(const SlaveFace& slave, const Vector3d& x) {
  const auto f = [&](double xi) {
    const auto at = along(slave.type, slave.x, xi), normal = along(slave.type, slave.normals, xi);
    const Vector3d apart = difference_of(at.value, x);
    return std::array{plane_cross(apart, normal.value),
                      plane_cross(at.slope, normal.value) + plane_cross(apart, normal.slope)};
  };
  const double sign = plane_cross(difference_of(column_of(slave.x, 1), column_of(slave.x, 0)),
                                  along(slave.type, slave.normals, 0).value);
  const double at_low = sign * f(-1)[0], at_high = sign * f(1)[0];
  if (at_low > 0 && at_high < 0)
    return std::nullopt;
  const auto root = newton(0, farthest_root, f);
  if (at_low > 0)
    return root.found && root.at < -1 ? root.at : -farthest_root;
  if (at_high < 0)
    return root.found && root.at > 1 ? root.at : farthest_root;
  return root.found && std::abs(root.at) <= 1 ? root.at : by_bisection(f);
}

/// Where (x_m(η) − x) × n = 0.
Root place_on_line(const MasterFace& master, const Vector3d& x, const Vector3d& normal, double start) {
  return newton(start, 1 + 2 * line_outside, [&](double eta) {
    const auto at = along(master.type, master.x, eta);
    return std::array{plane_cross(difference_of(at.value, x), normal), plane_cross(at.slope, normal)};
  });
}

/// η of the master with (x_m(η) − x) × n = 0, else its closest point.
double master_place(const MasterFace& master, const Vector3d& x, const Vector3d& normal, double start) {
  const auto root = place_on_line(master, x, normal, start);
  if (root.found && std::abs(root.at) <= 1 + line_outside)
    return root.at;
  return project(master.type, master.x, x).clamped[0];
}

std::span<const cell::QuadraturePoint> line_rule(CellType slave, CellType master) {
  static const auto linear = cell::gauss_rule(CellType::seg2, 3);
  static const auto quadratic = cell::gauss_rule(CellType::seg2, 5);
  return slave == CellType::seg2 && master == CellType::seg2 ? linear : quadratic;
}

bool has_length(const FaceCoordinates& x) {
  const Vector3d way = difference_of(column_of(x, 1), column_of(x, 0));
  return dot(way, way) > 0;
}

double distance_to(const MasterFace& master, double eta, const Vector3d& x, const Vector3d& normal) {
  return dot(normal, difference_of(along(master.type, master.x, eta).value, x)) / length_of(normal);
}

/// The master's place before ξ of the slave, and how far away it is along the slave's normal.
struct MetMaster {
  double eta = 0, distance = 0;
};

/// A piece of the slave's reference line and the ends of the master's there.
struct Piece {
  double low = 0, high = 0;
  std::array<double, 2> ends{};
  std::array<MetMaster, 2> met{}; ///< before low and high

  bool has_length() const { return high - low >= least_piece; }

  /// η if it were linear in ξ.
  double guess(double xi) const {
    const double eta = -1 + 2 * (xi - ends[0]) / (ends[1] - ends[0]);
    return std::isfinite(eta) ? std::clamp(eta, -1., 1.) : 0.;
  }
};

bool face_each_other(const SlaveFace& slave, const MasterFace& master, const Piece& piece) {
  const double middle = 0.5 * (piece.low + piece.high);
  const Vector3d normal = along(slave.type, slave.normals, middle).value;
  const Vector3d x = along(slave.type, slave.x, middle).value;
  const double eta = master_place(master, x, normal, piece.guess(middle));
  const Vector3d slope = along(master.type, master.x, eta).slope;
  return slope[1] * normal[0] - slope[0] * normal[1] < 0; // slope × e_z
}

MetMaster met_at(const SlaveFace& slave, const MasterFace& master, const Piece& piece, double xi) {
  const Vector3d x = along(slave.type, slave.x, xi).value;
  const Vector3d normal = along(slave.type, slave.normals, xi).value;
  const double eta = master_place(master, x, normal, piece.guess(xi));
  return {eta, distance_to(master, eta, x, normal)};
}

void append_piece(const SlaveFace& slave, const Measure& measure, const MasterFace& master,
                  const Piece& piece, const Reach& reach, OverlapPoints& into) {
  const auto first = into.points.size();
  const double half = 0.5 * (piece.high - piece.low);
  bool within_reach = false;
  for (const auto& [r, weight] : line_rule(slave.type, master.type)) {
    Point point;
    const double xi = piece.low + half * (1 + r[0]);
    const auto met = met_at(slave, master, piece, xi);
    point.xi[0] = xi;
    point.eta[0] = met.eta;
    point.slave_values = face_values(slave.type, point.xi);
    point.master_values = face_values(master.type, point.eta);
    point.weight = half * weight * undeformed_measure(slave.type, slave.undeformed, point.xi, measure);
    point.distance = met.distance;
    within_reach = within_reach || reach.contains(point.distance);
    into.points.push_back(point);
  }
  if (!within_reach) {
    into.points.resize(first);
    return;
  }
  into.corners.push_back({Vector2d(piece.low, 0), Vector2d(piece.met[0].eta, 0), piece.met[0].distance});
  into.corners.push_back({Vector2d(piece.high, 0), Vector2d(piece.met[1].eta, 0), piece.met[1].distance});
}

/// Whether lines along the normals go that far before they cross.
bool is_before_crossing(const SlaveFace& slave, double xi, double distance) {
  const auto x = along(slave.type, slave.x, xi), normal = along(slave.type, slave.normals, xi);
  const double lengths = distance / length_of(normal.value);
  return plane_cross(x.slope, normal.value) *
             plane_cross(sum_of(x.slope, scaled(lengths, normal.slope)), normal.value) >
         0;
}

/// The piece of a sub-facet before a master face, without length where there is none. Nothing where lines
/// along the normals cross between the two: places come in the opposite order there.
std::optional<Piece> piece_before(const SlaveFace& slave, const SubFacet& facet, const MasterFace& master) {
  const auto first = slave_place(slave, column_of(master.x, 0)),
             last = slave_place(slave, column_of(master.x, 1));
  if (!first || !last)
    return std::nullopt;
  Piece piece;
  piece.ends = {*first, *last};
  const double half_facet = std::abs(facet.from_local(0, 0));
  piece.low = std::max(facet.middle[0] - half_facet, std::min(piece.ends[0], piece.ends[1]));
  piece.high = std::min(facet.middle[0] + half_facet, std::max(piece.ends[0], piece.ends[1]));
  if (!piece.has_length())
    return piece;
  piece.met = {met_at(slave, master, piece, piece.low), met_at(slave, master, piece, piece.high)};
  const bool in_order = is_before_crossing(slave, piece.low, piece.met[0].distance) &&
                        is_before_crossing(slave, piece.high, piece.met[1].distance);
  return in_order ? std::optional(piece) : std::nullopt;
}

/// The slave face with one direction of projection: that of its middle.
SlaveFace along_one_normal(SlaveFace slave) {
  const Vector3d middle = along(slave.type, slave.normals, 0).value;
  slave.normals.resize(3, 9);
  for (int node = 0; node < 9; ++node)
    for (int i = 0; i < 3; ++i)
      slave.normals(i, node) = middle[i];
  return slave;
}

void append_if_facing(const SlaveFace& slave, const Measure& measure, const MasterFace& master,
                      const Piece& piece, const Reach& reach, OverlapPoints& into) {
  if (piece.has_length() && face_each_other(slave, master, piece))
    append_piece(slave, measure, master, piece, reach, into);
}

} // namespace

std::optional<double> distance_along_normal(const SlaveFace& slave, const MasterFace& master,
                                            const Vector2d& xi) {
  const Vector3d x = along(slave.type, slave.x, xi[0]).value;
  const Vector3d normal = along(slave.type, slave.normals, xi[0]).value;
  const auto root = place_on_line(master, x, normal, 0);
  if (!root.found || std::abs(root.at) > 1)
    return std::nullopt;
  return distance_to(master, root.at, x, normal);
}

void append_line_overlap(const SlaveFace& slave, const SubFacet& facet, const Measure& measure,
                         const MasterFace& master, const Reach& reach, OverlapPoints& into) {
  if (!has_length(slave.x) || !has_length(master.x))
    return;
  if (const auto piece = piece_before(slave, facet, master))
    return append_if_facing(slave, measure, master, *piece, reach, into);
  const auto straight = along_one_normal(slave);
  if (const auto piece = piece_before(straight, facet, master))
    append_if_facing(straight, measure, master, *piece, reach, into);
}

} // namespace rubato::contact::mortar
