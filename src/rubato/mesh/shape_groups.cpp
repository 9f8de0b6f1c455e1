// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/shape_groups.hpp"

#include "rubato/mesh/group_region.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/study/groups.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rubato::mesh {
namespace {

using study::GroupTake;

/// Takes what is near enough, and remembers what is nearest.
struct Choice {
  double limit = 0;
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;

  bool takes(double distance, std::size_t which) {
    if (distance < least) {
      least = distance;
      nearest = which;
    }
    return distance <= limit;
  }
};

std::string face_label(const Mesh& mesh, const SurfaceFace& face) {
  if (face.face != SurfaceFace::none)
    return "cell " + cell_name(mesh, face.face);
  std::vector<std::string> names;
  const auto corners = static_cast<std::size_t>(cell::topology(face.type).corner_count);
  for (const auto node : face.nodes().first(corners))
    names.push_back(node_name(mesh, node));
  return fmt::format("the face of nodes {}", fmt::join(names, ", "));
}

/// What makes sense of the nearest thing in a message about an empty shape.
std::string hint(const study::MadeGroup& group) {
  return study::entry_of(group.kind).within ? "; 'within' takes what is near the surface" : "";
}

[[noreturn]] void refuse_empty(const study::MadeGroup& group, std::string_view what,
                               const std::string& nearest, double distance) {
  refuse(study::path_of(group), fmt::format("found no {} there; {} is the nearest, {:.4g} away{}", what,
                                            nearest, distance, hint(group)));
}

/// Of the node that is farthest.
double distance_of_all(const study::MadeGroup& group, const Mesh& mesh, std::span<const NodeIndex> nodes) {
  double largest = 0;
  for (const auto node : nodes)
    largest = std::max(largest, distance_from(group, mesh.points[static_cast<std::size_t>(node)]));
  return largest;
}

GroupItems nodes_inside(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                        double rounding) {
  GroupItems found{false, {}};
  Choice choice{rounding};
  const auto nodes = sources.nodes(group);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (choice.takes(distance_from(group, mesh.points[static_cast<std::size_t>(nodes[i])]), i))
      found.items.push_back(nodes[i]);
  if (found.items.empty())
    refuse_empty(group, "node", place_label(mesh, nodes.at(choice.nearest)), choice.least);
  return found;
}

GroupItems cells_inside(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                        const FaceCells& faces, double rounding) {
  GroupItems found{true, {}};
  Choice choice{rounding};
  const auto cells = sources.cells(group);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (choice.takes(distance_of_all(group, mesh, faces.nodes_of(cells[i])), i))
      found.items.push_back(cells[i]);
  if (cells.empty())
    refuse(study::path_of(group), "the mesh has no cells of bodies");
  if (found.items.empty()) {
    const auto nearest = cells[choice.nearest];
    refuse_empty(group, "cell",
                 faces.is_new(nearest) ? std::string("one of its faces") : "cell " + cell_name(mesh, nearest),
                 choice.least);
  }
  return found;
}

/// Which cells are of the group.
std::vector<bool> marks_of(const std::vector<CellIndex>& cells, const Mesh& mesh) {
  std::vector<bool> marks(static_cast<std::size_t>(mesh.cell_count()), false);
  for (const auto cell : cells)
    if (cell < mesh.cell_count())
      marks[static_cast<std::size_t>(cell)] = true;
  return marks;
}

std::vector<SurfaceFace> skin_of(const std::vector<CellIndex>& cells, const Mesh& mesh,
                                 const FaceCells& faces) {
  const auto marks = marks_of(cells, mesh);
  std::vector<SurfaceFace> found;
  for (const auto& face : faces.faces())
    if (marks[static_cast<std::size_t>(face.owner)])
      found.push_back(face);
  return found;
}

/// A cell of a group as a face, outward where it bounds a body.
SurfaceFace face_of_cell(CellIndex cell, const FaceCells& faces) {
  SurfaceFace face;
  if (const auto* outward = faces.face_of(cell)) {
    face = *outward;
  } else {
    face.type = faces.type_of(cell);
    std::ranges::copy(faces.nodes_of(cell), face.node_list.begin());
  }
  face.face = cell;
  return face;
}

/// Faces that a group may be made of: the skin of the cells that it is made of, and its faces themselves.
std::vector<SurfaceFace> candidates(const study::MadeGroup& group, const GroupSources& sources,
                                    const Mesh& mesh, const FaceCells& faces) {
  if (GroupSources::is_of_everything(group))
    return {faces.faces().begin(), faces.faces().end()};
  const auto cells = sources.cells(group);
  auto found = skin_of(cells, mesh, faces);
  for (const auto cell : cells)
    if (cell::topology(faces.type_of(cell)).dimension == mesh.dimension - 1)
      found.push_back(face_of_cell(cell, faces));
  if (found.empty())
    refuse(study::path_of_source(group, 0),
           fmt::format("found '{}', which has no faces of bodies", group.of.front()));
  return found;
}

GroupItems as_cells(const std::vector<SurfaceFace>& chosen, FaceCells& faces) {
  GroupItems found{true, {}};
  for (const auto& face : chosen)
    found.items.push_back(face.face != SurfaceFace::none ? face.face : faces.cell_of(face));
  sort_without_repeats(found.items);
  return found;
}

GroupItems faces_inside(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                        FaceCells& faces, double rounding) {
  const auto all = candidates(group, sources, mesh, faces);
  std::vector<SurfaceFace> chosen;
  Choice choice{rounding};
  for (std::size_t i = 0; i < all.size(); ++i)
    if (choice.takes(distance_of_all(group, mesh, all[i].nodes()), i))
      chosen.push_back(all[i]);
  if (all.empty())
    refuse(study::path_of(group), "the mesh has no bodies with faces");
  if (chosen.empty())
    refuse_empty(group, "face", face_label(mesh, all[choice.nearest]), choice.least);
  return as_cells(chosen, faces);
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

} // namespace

GroupItems inside_of(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                     FaceCells& faces, double rounding) {
  switch (group.take) {
  case GroupTake::nodes:
    return nodes_inside(group, sources, mesh, rounding);
  case GroupTake::cells:
    return cells_inside(group, sources, mesh, faces, rounding);
  default:
    return faces_inside(group, sources, mesh, faces, rounding);
  }
}

GroupItems facing(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                  FaceCells& faces) {
  constexpr double rounding = 1e-9; // [degrees]
  const Eigen::Vector3d direction(group.direction[0], group.direction[1], group.direction[2]);
  const auto all = candidates(group, sources, mesh, faces);
  std::vector<SurfaceFace> chosen;
  Choice choice{group.angle + rounding};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].owner == SurfaceFace::none)
      refuse(study::path_of_source(group, 0),
             fmt::format("found '{}' with {}, which bounds no body: it has no outward side", group.of.front(),
                         face_label(mesh, all[i])));
    if (choice.takes(degrees_between(normal_of(mesh, all[i]), direction), i))
      chosen.push_back(all[i]);
  }
  if (all.empty())
    refuse(study::path_of(group), "the mesh has no bodies with faces");
  if (chosen.empty())
    refuse(
        study::path_of(group),
        fmt::format("found no face with this outward normal; that of {} is the nearest, {:.4g} degrees off",
                    face_label(mesh, all[choice.nearest]), choice.least));
  return as_cells(chosen, faces);
}

GroupItems outside_of(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                      FaceCells& faces) {
  const auto cells = sources.cells(group);
  const auto is_bulk = [&](CellIndex cell) {
    return cell::topology(faces.type_of(cell)).dimension == mesh.dimension;
  };
  const auto path = study::path_of_source(group, 0);
  if (std::ranges::none_of(cells, is_bulk))
    refuse(path, fmt::format("found '{}', expected a group of {}", group.of.front(),
                             mesh.dimension == 3 ? "solid cells" : "surface cells, which have a skin in 2D"));
  const auto chosen = skin_of(cells, mesh, faces);
  if (chosen.empty())
    refuse(path,
           fmt::format("found '{}', whose cells have others behind each of their sides", group.of.front()));
  return as_cells(chosen, faces);
}

} // namespace rubato::mesh
