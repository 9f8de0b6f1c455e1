// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/operators.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/directions.hpp"
#include "rubato/contact/mortar/parts.hpp"
#include "rubato/contact/mortar/self_contact_normals.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/index.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;

void set_masters(const Surface& master, std::span<const Vector3d> x, Workspace::Impl& work) {
  work.masters.resize(master.faces.size());
  std::vector<Box> boxes(master.faces.size());
  for (std::size_t f = 0; f < master.faces.size(); ++f) {
    const auto& face = master.faces[f];
    auto& placed = work.masters[f];
    placed.type = face.type;
    placed.x = values_of(face, x);
    boxes[f] = box_of(face.type, placed.x);
  }
  work.search.build(boxes);
}

void find_candidates(int slave_face, const SlaveFace& placed, const Options& options, const Reach& reach,
                     const FaceSearch& search, Covering& work) {
  auto box = box_of(placed.type, placed.x);
  for (int i = 0; i < 3; ++i) {
    box.min()[i] -= reach.most();
    box.max()[i] += reach.most();
  }
  search.find(box, work.candidates);
  if (options.may_pair)
    std::erase_if(work.candidates, [&](int face) { return !options.may_pair(slave_face, face); });
}

/// Adds ∫H N of one node's shape function over the points.
void add_weighted(std::span<const Point> points, std::span<const Eigen::Vector4d> weighted,
                  std::array<double, 9> Point::*values, int node, Products& products) {
  Eigen::Vector4d sum(products(0, node), products(1, node), products(2, node), products(3, node));
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += (points[i].*values)[at(node)] * weighted[i];
  for (int row = 0; row < 4; ++row)
    products(row, node) = sum[row];
}

/// One slave sub-facet before all candidates.
class FacetIntegral {
public:
  FacetIntegral(const Surface& slave, const SlaveReference& reference, const Surface& master,
                const Options& options, std::span<const MasterFace> masters, Covering& work)
      : slave_(slave), reference_(reference), master_(master), options_(options), masters_(masters),
        work_(work) {}

  void add(int face, int facet, const SlaveFace& placed, const Reach& reach) {
    part_ = {};
    part_.face = face;
    part_.facet = facet;
    const auto& of = subfacets(placed.type)[at(facet)];
    if (reference_.dimension == 2) {
      collect([&](const MasterFace& master) {
        append_line_overlap(placed, of, reference_.measure, master, reach, work_.overlap);
      });
      choose(placed, [&](int master, const Eigen::Vector2d& xi) {
        return distance_along_normal(placed, masters_[at(master)], xi);
      });
    } else {
      const PlaneOverlaps overlaps(placed, of, reference_.measure, reach);
      collect([&](const MasterFace& master) { overlaps.append(master, work_.overlap); });
      choose(placed, [&](int master, const Eigen::Vector2d& xi) {
        return overlaps.distance_before(masters_[at(master)], xi);
      });
    }
    integrate(placed);
  }

private:
  const SubFacet& facet() const { return subfacets(slave_.faces[at(part_.face)].type)[at(part_.facet)]; }

  template <class Append> void collect(const Append& append) {
    auto& points = work_.overlap.points;
    work_.overlap.clear();
    work_.ranges.clear();
    for (const int candidate : work_.candidates) {
      const auto first = points.size(), first_corner = work_.overlap.corners.size();
      append(masters_[at(candidate)]);
      if (points.size() > first)
        work_.ranges.push_back({candidate, first, points.size(), first_corner, work_.overlap.corners.size()});
    }
  }

  void choose(const SlaveFace& placed, const DistanceBefore& distance_before) {
    if (options_.all_layers || work_.ranges.size() < 2)
      return;
    leave_out_hidden(master_, work_.ranges, full_area(reference_, part_), distance_before,
                     work_.overlap.points);
    leave_out_far(master_, work_.ranges, size_of(placed, facet()), work_.overlap.points);
  }

  void integrate(const SlaveFace& placed) {
    part_.first_overlap = work_.overlaps.size();
    weigh_functions();
    if (!(total_of(part_.covered.first) > 0))
      return;
    for (const auto& range : work_.ranges)
      add_overlap(range);
    if (!options_.mean_normals)
      for (const auto& range : work_.ranges)
        add_faced(range);
    part_.last_overlap = work_.overlaps.size();
    make_dual(placed, reference_, work_, part_);
    work_.parts.push_back(part_);
  }

  void weigh_functions() {
    work_.weighted.clear();
    work_.seen_gaps.clear();
    for (const auto& point : work_.overlap.points) {
      auto values = facet_values(facet(), point.xi);
      part_.covered.add(point.weight, values);
      for (int i = 0; i < 4; ++i) {
        values[i] *= point.weight;
        part_.gaps[i] += point.distance * values[i];
      }
      work_.weighted.push_back(values);
    }
    for (const auto& range : work_.ranges)
      if (counts(range))
        see_gaps(range);
  }

  void see_gaps(const PointRange& range) {
    for (const auto& point : range.of(std::span<const Point>(work_.overlap.points)))
      if (point.weight != 0)
        work_.seen_gaps.push_back(
            {facet_values(facet(), point.xi), point.distance, point.xi, point.eta, range.master_face});
    for (const auto& corner : range.of_corners(work_.overlap.corners))
      work_.seen_gaps.push_back(
          {facet_values(facet(), corner.xi), corner.distance, corner.xi, corner.eta, range.master_face});
  }

  bool counts(const PointRange& range) const {
    return std::ranges::any_of(range.of(std::span<const Point>(work_.overlap.points)),
                               [](const Point& point) { return point.weight != 0; });
  }

  void add_faced(const PointRange& range) {
    if (!counts(range))
      return;
    const auto points = range.of(std::span<const Point>(work_.overlap.points));
    const auto weighted = range.of(std::span<const Eigen::Vector4d>(work_.weighted));
    for (std::size_t p = 0; p < points.size(); ++p)
      if (points[p].weight != 0)
        add_faced(points[p], range.master_face, weighted[p]);
    for (const auto& corner : range.of_corners(work_.overlap.corners)) {
      measure_overhang(corner);
      measure_border(corner, range.master_face);
    }
  }

  void add_faced(const Point& point, int master_face, const Eigen::Vector4d& weighted) {
    const auto& face = master_.faces[at(master_face)];
    const auto& placed = masters_[at(master_face)];
    const Vector3d normal = outward_normal(placed.type, placed.x, point.eta);
    double kink = 0, edge = 0;
    for (int l = 0; l < face.node_count; ++l) {
      const double value = std::max(0., point.master_values[at(l)]);
      kink += value * face.kinks[at(l)];
      edge += value * master_.at_edge[at(face.positions[at(l)])];
    }
    for (int i = 0; i < 4; ++i) {
      for (int c = 0; c < 3; ++c)
        part_.faced.normals(i, c) += weighted[i] * normal[c];
      part_.faced.kinks[i] += weighted[i] * kink;
      part_.faced.edges[i] += weighted[i] * edge;
    }
  }

  void measure_border(const Corner& corner, int master_face) {
    const auto& face = master_.faces[at(master_face)];
    const auto values = face_values(face.type, corner.eta);
    double border = 0;
    for (int l = 0; l < face.node_count; ++l)
      border += values[at(l)] * master_.at_edge[at(face.positions[at(l)])];
    part_.faced.border = std::max(part_.faced.border, border);
  }

  /// The reference face is two long.
  void measure_overhang(const Corner& corner) {
    const auto& nodes = cell::reference_cell(slave_.faces[at(part_.face)].type).nodes;
    for (int i = 0; i < facet().node_count; ++i) {
      const auto& place = nodes[facet().nodes[at(i)]];
      auto& overhang = part_.faced.overhang[at(i)];
      overhang = std::min(overhang, 0.5 * std::hypot(corner.xi[0] - place[0], corner.xi[1] - place[1]));
    }
  }

  /// Adds the integrals over the points to the part, and to one overlap of it.
  void add_overlap(const PointRange& range) {
    auto& overlap = work_.overlaps.emplace_back();
    overlap.master_face = range.master_face;
    const auto points = range.of(std::span<const Point>(work_.overlap.points));
    const auto weighted = range.of(std::span<const Eigen::Vector4d>(work_.weighted));
    for (int k = 0; k < slave_.faces[at(part_.face)].node_count; ++k)
      add_weighted(points, weighted, &Point::slave_values, k, part_.slave);
    for (int l = 0; l < master_.faces[at(range.master_face)].node_count; ++l)
      add_weighted(points, weighted, &Point::master_values, l, overlap.master);
    if (options_.gradients)
      add_gradients(range.master_face, points, weighted);
  }

  void add_gradients(int master_face, std::span<const Point> points,
                     std::span<const Eigen::Vector4d> weighted) {
    auto& sums = work_.gradients.emplace_back();
    for (auto& sum : sums)
      sum.setZero();
    const auto& placed = masters_[at(master_face)];
    const int nodes = master_.faces[at(master_face)].node_count;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto gradients = surface_gradients(placed.type, placed.x, points[p].eta);
      for (std::size_t c = 0; c < sums.size(); ++c)
        for (int l = 0; l < nodes; ++l)
          for (int i = 0; i < 4; ++i)
            sums[c](i, l) += gradients[at(l)][static_cast<Eigen::Index>(c)] * weighted[p][i];
    }
  }

  const Surface& slave_;
  const SlaveReference& reference_;
  const Surface& master_;
  const Options& options_;
  std::span<const MasterFace> masters_; ///< of the master, where they are
  Covering& work_;
  Part part_;
};

void measure_gaps(const Surface& slave, const Surface& master, std::span<const Vector3d> slave_x,
                  std::span<const Vector3d> master_x, Operators& into) {
  for (auto& node : into.nodes) {
    Vector3d apart(0, 0, 0);
    for (std::size_t i = 0; i < node.stencil.nodes.size(); ++i) {
      const bool on_slave = i < at(node.slave_nodes);
      const int position = (on_slave ? slave : master).position_of(node.stencil.nodes[i]);
      add_scaled(node.stencil.weights[static_cast<Eigen::Index>(i)],
                 (on_slave ? slave_x : master_x)[at(position)], apart);
    }
    node.gap = dot(node.normal, apart) + node.lift;
  }
}

/// Calls integrate(first face, face after the last, where to) for parts that follow one another.
template <class Integrate>
void integrate_faces(std::size_t faces, const Threads& threads, Workspace::Impl& work,
                     const Integrate& integrate) {
  constexpr std::size_t fewest = 64; // faces that are worth a thread
  const int parts = threads.parts_of(faces, fewest);
  work.others.resize(at(parts) - 1);
  threads.each(parts, [&](int part) {
    Covering& own = part == 0 ? work : work.others[at(part) - 1];
    own.clear_parts();
    integrate(faces * at(part) / at(parts), faces * (at(part) + 1) / at(parts), own);
  });
  for (const auto& next : work.others)
    work.append(next);
}

} // namespace

Workspace::Workspace() : impl_(std::make_unique<Impl>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

void integrate(const Surface& slave, const SlaveReference& reference, const Surface& master,
               std::span<const Vector3d> slave_x, std::span<const Vector3d> master_x, const Options& options,
               Workspace& workspace, Operators& into) {
  require_finite(slave, slave_x, "slave");
  require_finite(master, master_x, "master");
  auto& work = workspace.impl();
  const double common_reach = reach_of(options, reference);
  set_masters(master, master_x, work);
  set_normals(slave, reference, slave_x, options, work.normals);
  if (options.mean_normals)
    take_mean_normals(slave, slave_x, options, common_reach, work);
  integrate_faces(slave.faces.size(), options.threads, work,
                  [&](std::size_t first, std::size_t last, Covering& own) {
                    FacetIntegral integral(slave, reference, master, options, work.masters, own);
                    for (std::size_t f = first; f < last; ++f) {
                      auto placed = slave_face(slave.faces[f], reference, slave_x, work.normals);
                      placed.along_normals = options.mean_normals;
                      const Reach reach =
                          options.reaches.empty() ? Reach{common_reach, common_reach} : options.reaches[f];
                      find_candidates(static_cast<int>(f), placed, options, reach, work.search, own);
                      if (own.candidates.empty())
                        continue;
                      for (std::size_t facet = 0; facet < subfacets(placed.type).size(); ++facet)
                        integral.add(static_cast<int>(f), static_cast<int>(facet), placed, reach);
                    }
                  });
  share_functions(slave, reference, slave_x, options, work, into);
  if (!options.mean_normals)
    set_directions(slave, reference, slave_x, options, work, into);
  fill_stencils(slave, &master, reference.dimension, work, into);
  if (options.gradients)
    fill_gradients(master, work, into);
  measure_gaps(slave, master, slave_x, master_x, into);
}

void mean_normals(const Surface& surface, const SlaveReference& reference, std::span<const Vector3d> x,
                  const Options& options, Workspace& workspace, std::vector<Vector3d>& normals) {
  auto& work = workspace.impl();
  set_masters(surface, x, work);
  set_normals(surface, reference, x, options, work.normals);
  take_mean_normals(surface, x, options, reach_of(options, reference), work);
  normals = work.normals;
}

Operators integrate(const Surface& slave, const SlaveReference& reference, const Surface& master,
                    std::span<const Vector3d> slave_x, std::span<const Vector3d> master_x,
                    const Options& options) {
  Workspace workspace;
  Operators operators;
  integrate(slave, reference, master, slave_x, master_x, options, workspace, operators);
  return operators;
}

} // namespace rubato::contact::mortar
