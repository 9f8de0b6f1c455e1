// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/operators.hpp"

#include "rubato/contact/mortar/parts.hpp"
#include "rubato/contact/mortar/self_contact_normals.hpp"

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

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

void find_candidates(int slave_face, const SlaveFace& placed, const Options& options, double reach,
                     Workspace::Impl& work) {
  auto box = box_of(placed.type, placed.x);
  box.min() -= Vector3d::Constant(reach);
  box.max() += Vector3d::Constant(reach);
  work.search.find(box, work.candidates);
  if (options.may_pair)
    std::erase_if(work.candidates, [&](int face) { return !options.may_pair(slave_face, face); });
}

/// Adds the integral of one node's shape function.
void add_weighted(const Workspace::Impl& work, std::array<double, 9> Point::*values, int node,
                  Products& products) {
  Eigen::Vector4d sum = products.col(node);
  for (std::size_t i = 0; i < work.points.size(); ++i)
    sum += (work.points[i].*values)[at(node)] * work.weighted[i];
  products.col(node) = sum;
}

/// Adds the integrals over the points to the part, and to one overlap of it.
void add_overlap(const SubFacet& facet, int slave_nodes, int master_nodes, int master_face,
                 Workspace::Impl& work, Part& part) {
  auto& overlap = work.overlaps.emplace_back();
  overlap.master_face = master_face;
  work.weighted.clear();
  for (const auto& point : work.points) {
    const Eigen::Vector4d values = facet_values(facet, point.xi);
    part.covered.add(point.weight, values);
    work.weighted.emplace_back(point.weight * values);
  }
  for (int k = 0; k < slave_nodes; ++k)
    add_weighted(work, &Point::slave_values, k, part.slave);
  for (int l = 0; l < master_nodes; ++l)
    add_weighted(work, &Point::master_values, l, overlap.master);
}

/// The part of one slave sub-facet before all candidates; `append(master)` fills work.points.
template <class Append>
void integrate_facet(const Surface& slave, int face, int facet_index, const Append& append,
                     Workspace::Impl& work) {
  const auto type = slave.faces[at(face)].type;
  const auto& facet = subfacets(type)[at(facet_index)];
  Part part;
  part.face = face;
  part.facet = facet_index;
  part.first_overlap = work.overlaps.size();
  for (const int candidate : work.candidates) {
    work.points.clear();
    append(work.masters[at(candidate)]);
    if (!work.points.empty())
      add_overlap(facet, slave.faces[at(face)].node_count,
                  static_cast<int>(work.masters[at(candidate)].x.cols()), candidate, work, part);
  }
  part.last_overlap = work.overlaps.size();
  if (part.covered.first.sum() > 0)
    work.parts.push_back(part);
  else
    work.overlaps.resize(part.first_overlap);
}

void integrate_face(const Surface& slave, int face, const SlaveFace& placed, const SlaveReference& reference,
                    double reach, Workspace::Impl& work) {
  const auto facets = subfacets(placed.type);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (reference.dimension == 2) {
      const auto append = [&](const MasterFace& master) {
        append_line_overlap(placed, facets[f], reference.measure, master, reach, work.points);
      };
      integrate_facet(slave, face, static_cast<int>(f), append, work);
    } else {
      const PlaneOverlaps overlaps(placed, facets[f], reference.measure, reach);
      const auto append = [&](const MasterFace& master) { overlaps.append(master, work.points); };
      integrate_facet(slave, face, static_cast<int>(f), append, work);
    }
  }
}

void measure_gaps(const Surface& slave, const Surface& master, std::span<const Vector3d> slave_x,
                  std::span<const Vector3d> master_x, Operators& into) {
  for (auto& node : into.nodes) {
    Vector3d apart = Vector3d::Zero();
    for (std::size_t i = 0; i < node.stencil.nodes.size(); ++i) {
      const bool on_slave = i < at(node.slave_nodes);
      const int position = (on_slave ? slave : master).position_of(node.stencil.nodes[i]);
      apart +=
          node.stencil.weights[static_cast<Eigen::Index>(i)] * (on_slave ? slave_x : master_x)[at(position)];
    }
    node.gap = node.normal.dot(apart);
  }
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
  work.clear_parts();
  for (std::size_t f = 0; f < slave.faces.size(); ++f) {
    auto placed = slave_face(slave.faces[f], reference, slave_x, work.normals);
    placed.along_normals = options.mean_normals;
    const double reach = options.reaches.empty() ? common_reach : options.reaches[f];
    find_candidates(static_cast<int>(f), placed, options, reach, work);
    if (!work.candidates.empty())
      integrate_face(slave, static_cast<int>(f), placed, reference, reach, work);
  }
  share_functions(slave, reference, slave_x, options, work, into);
  fill_stencils(slave, &master, reference.dimension, work, into);
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
