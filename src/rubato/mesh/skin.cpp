// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/skin.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/mesh/corner_sets.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

#include <string_view>

namespace rubato::mesh {
namespace {

struct Owner {
  CellIndex cell = SurfaceFace::none;
  std::uint8_t side = 0;
  std::uint8_t count = 0; ///< how many bulk cells have this side; the first one is kept
};

void claim(Owner& owner, CellIndex cell, std::size_t side) {
  if (owner.count == 0) {
    owner.cell = cell;
    owner.side = static_cast<std::uint8_t>(side);
  }
  if (owner.count < 2)
    ++owner.count;
}

SurfaceFace surface_face(const Mesh& mesh, const Owner& owner, CellIndex face) {
  const auto place = mesh.place_of(owner.cell);
  const auto nodes = place.block->cell(place.index);
  const auto& side = cell::topology(place.block->type).sides[owner.side];
  SurfaceFace result;
  result.type = side.type;
  result.side = owner.side;
  result.owner = owner.cell;
  result.face = face;
  for (std::size_t i = 0; i < side.nodes.size(); ++i)
    result.node_list[i] = nodes[side.nodes[i]];
  return result;
}

class SkinSearch {
public:
  explicit SkinSearch(int dimension) : dimension_(dimension) {}

  void add(CellIndex cell, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    if (shape.dimension != dimension_)
      return;
    for (std::size_t side = 0; side < shape.sides.size(); ++side) {
      const auto number = static_cast<std::size_t>(sets_.insert(corner_set(nodes, shape.sides[side])));
      if (number == owners_.size())
        owners_.emplace_back();
      claim(owners_[number], cell, side);
    }
  }

  std::vector<SurfaceFace> faces(const Mesh& mesh) const {
    std::vector<SurfaceFace> found;
    for (const auto& owner : owners_)
      if (owner.count == 1)
        found.push_back(surface_face(mesh, owner, SurfaceFace::none));
    return found;
  }

private:
  int dimension_;
  CornerSets sets_;
  std::vector<Owner> owners_;
};

/// A filter that spares most sides of a large mesh the search: only few have all corners on the faces asked
/// for.
class NodeMarks {
public:
  explicit NodeMarks(NodeIndex node_count) : marked_(static_cast<std::size_t>(node_count), false) {}

  void mark(std::span<const NodeIndex> nodes) {
    for (const auto node : nodes)
      marked_[static_cast<std::size_t>(node)] = true;
  }
  bool all_marked(const CornerSet& corners) const {
    for (const auto node : corners)
      if (node >= 0 && !marked_[static_cast<std::size_t>(node)])
        return false;
    return true;
  }

private:
  std::vector<bool> marked_;
};

CornerSet corners_of_face(const Mesh& mesh, CellIndex cell) {
  const auto place = mesh.place_of(cell);
  const auto corners = static_cast<std::size_t>(cell::topology(place.block->type).corner_count);
  return corner_set(place.block->cell(place.index).first(corners));
}

std::vector<Owner> owners_of(const Mesh& mesh, const CornerSets& wanted, const NodeMarks& marks) {
  std::vector<Owner> owners(static_cast<std::size_t>(wanted.size()));
  for_each_cell(mesh, [&](CellIndex cell, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    if (shape.dimension != mesh.dimension)
      return;
    for (std::size_t side = 0; side < shape.sides.size(); ++side) {
      const auto corners = corner_set(nodes, shape.sides[side]);
      if (!marks.all_marked(corners))
        continue;
      if (const auto number = wanted.find(corners); number != CornerSets::none)
        claim(owners[static_cast<std::size_t>(number)], cell, side);
    }
  });
  return owners;
}

/// "number 12", or the cell's name in the file.
std::string called(const Mesh& mesh, CellIndex cell) {
  return (mesh.place_of(cell).block->names.empty() ? "number " : "") + cell_name(mesh, cell);
}

} // namespace

std::vector<SurfaceFace> skin(const Mesh& mesh, std::span<const CellIndex> bulk_cells) {
  SkinSearch search(mesh.dimension);
  for (const auto cell : bulk_cells) {
    const auto place = mesh.place_of(cell);
    search.add(cell, cell::topology(place.block->type), place.block->cell(place.index));
  }
  return search.faces(mesh);
}

std::vector<SurfaceFace> skin(const Mesh& mesh) {
  SkinSearch search(mesh.dimension);
  for_each_cell(mesh, [&](CellIndex cell, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    search.add(cell, shape, nodes);
  });
  return search.faces(mesh);
}

OrientedFaces oriented_faces(const Mesh& mesh, std::span<const CellIndex> cells) {
  OrientedFaces surface;
  std::vector<CellIndex> faces;
  CornerSets wanted;
  NodeMarks marks(mesh.node_count());
  for (const auto cell : cells) {
    if (cell::topology(mesh.type_of(cell)).dimension != mesh.dimension - 1) {
      surface.not_faces.push_back(cell);
      continue;
    }
    faces.push_back(cell);
    wanted.insert(corners_of_face(mesh, cell));
    marks.mark(mesh.nodes_of(cell));
  }

  const auto owners = owners_of(mesh, wanted, marks);
  for (const auto face : faces) {
    const auto& owner = owners[static_cast<std::size_t>(wanted.find(corners_of_face(mesh, face)))];
    if (owner.count == 1)
      surface.faces.push_back(surface_face(mesh, owner, face));
    else
      (owner.count == 0 ? surface.unowned : surface.inside).push_back(face);
  }
  return surface;
}

std::vector<std::string> faults_of(const Mesh& mesh, const OrientedFaces& surface) {
  std::vector<std::string> sentences;
  const auto tell = [&](const std::vector<CellIndex>& cells, std::string_view what) {
    if (!cells.empty())
      sentences.push_back(fmt::format("{} cell{} (the first: {} of {}) {}", cells.size(),
                                      cells.size() == 1 ? "" : "s", called(mesh, cells.front()),
                                      cell::topology(mesh.type_of(cells.front())).name, what));
  };
  tell(surface.not_faces, mesh.dimension == 3 ? "found where faces (triangles, quadrangles) are expected"
                                              : "found where segments are expected");
  tell(surface.unowned,
       mesh.dimension == 3 ? "found that bound no solid cell" : "found that bound no surface cell");
  tell(surface.inside, "found inside a body, between two of its cells: a skin is expected");
  return sentences;
}

} // namespace rubato::mesh
