// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/sheet.hpp"

#include "rubato/mesh/corner_sets.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/orientation.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::mesh {
namespace {

/// A border of a face, the way the face runs along it.
struct Border {
  std::size_t face = 0;
  bool forwards = true; ///< from the smaller node to the larger one; in 2D: ends at the node
};

std::span<const NodeIndex> corners_of(const SurfaceFace& face) {
  return face.nodes().first(static_cast<std::size_t>(cell::topology(face.type).corner_count));
}

/// Calls take(corner set, whether the face runs forwards) for each border.
template <class Take> void for_each_border(const SurfaceFace& face, const Take& take) {
  const auto corners = corners_of(face);
  if (cell::topology(face.type).dimension == 1) {
    take(corner_set(corners.first(1)), false);
    take(corner_set(corners.last(1)), true);
    return;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::array ends{corners[i], corners[(i + 1) % corners.size()]};
    take(corner_set(ends), ends[0] < ends[1]);
  }
}

/// Faces side by side turned alike.
class Orienting {
public:
  Orienting(const Mesh& mesh, Sheets& sheets) : mesh_(mesh), sheets_(sheets) {
    for (std::size_t f = 0; f < sheets.faces.size(); ++f)
      for_each_border(sheets.faces[f], [&](const CornerSet& set, bool forwards) {
        const auto number = static_cast<std::size_t>(sets_.insert(set));
        if (number == borders_.size())
          borders_.emplace_back();
        borders_[number].push_back({f, forwards});
      });
  }

  void run() {
    const auto crowded = std::ranges::count_if(borders_, [](const auto& at) { return at.size() > 2; });
    if (crowded > 0)
      sheets_.faults.push_back(fmt::format("more than two faces meet at {} of its {}", crowded,
                                           mesh_.dimension == 3 ? "edges" : "nodes"));
    sheets_.sheet_of_face.assign(sheets_.faces.size(), -1);
    turned_.assign(sheets_.faces.size(), false);
    for (std::size_t f = 0; f < sheets_.faces.size(); ++f)
      if (sheets_.sheet_of_face[f] < 0)
        spread_from(f);
    for (std::size_t f = 0; f < sheets_.faces.size(); ++f)
      if (turned_[f])
        turn(sheets_.faces[f]);
  }

private:
  void spread_from(std::size_t first) {
    const int sheet = sheets_.count++;
    std::vector<std::size_t> waiting{first};
    sheets_.sheet_of_face[first] = sheet;
    bool one_sided = false;
    while (!waiting.empty()) {
      const auto face = waiting.back();
      waiting.pop_back();
      for_each_border(sheets_.faces[face], [&](const CornerSet& set, bool forwards) {
        const auto& meeting = borders_[static_cast<std::size_t>(sets_.find(set))];
        if (meeting.size() != 2)
          return;
        const auto& other = meeting[meeting[0].face == face ? 1 : 0];
        // Neighbours run along their common border in opposite senses.
        const bool turned = turned_[face] != (other.forwards == forwards);
        auto& of_other = sheets_.sheet_of_face[other.face];
        if (of_other < 0) {
          of_other = sheet;
          turned_[other.face] = turned;
          waiting.push_back(other.face);
        } else {
          one_sided = one_sided || turned_[other.face] != turned;
        }
      });
    }
    if (one_sided)
      sheets_.faults.push_back(
          fmt::format("the sheet of cell {} has one side only", cell_name(mesh_, sheets_.faces[first].face)));
  }

  const Mesh& mesh_;
  Sheets& sheets_;
  CornerSets sets_;
  std::vector<std::vector<Border>> borders_;
  std::vector<bool> turned_;
};

const Eigen::Vector3d& at(const Mesh& mesh, NodeIndex node) {
  return mesh.points[static_cast<std::size_t>(node)];
}

} // namespace

Sheets sheets_of(const Mesh& mesh, std::span<const CellIndex> cells) {
  Sheets sheets;
  for (const auto cell : cells) {
    SurfaceFace face;
    face.type = mesh.type_of(cell);
    face.face = cell;
    std::ranges::copy(mesh.nodes_of(cell), face.node_list.begin());
    sheets.faces.push_back(face);
  }
  Orienting(mesh, sheets).run();
  return sheets;
}

void turn(SurfaceFace& face) {
  const auto before = face.node_list;
  if (cell::topology(face.type).dimension == 1) {
    std::swap(face.node_list[0], face.node_list[1]);
    return;
  }
  const auto mirrored = mirrored_numbering(face.type);
  for (std::size_t i = 0; i < mirrored.size(); ++i)
    face.node_list[i] = before[mirrored[i]];
}

Eigen::Vector3d normal_of(const Mesh& mesh, const SurfaceFace& face) {
  const auto corners = corners_of(face);
  if (corners.size() == 2) {
    const Eigen::Vector3d along = at(mesh, corners[1]) - at(mesh, corners[0]);
    return {along.y(), -along.x(), 0};
  }
  const Eigen::Vector3d first = at(mesh, corners[2]) - at(mesh, corners[0]);
  const Eigen::Vector3d second = at(mesh, corners.back()) - at(mesh, corners[1]);
  return corners.size() == 4
             ? Eigen::Vector3d(first.cross(second) / 2)
             : Eigen::Vector3d((at(mesh, corners[1]) - at(mesh, corners[0])).cross(first) / 2);
}

Eigen::Vector3d centre_of(const Mesh& mesh, const SurfaceFace& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto corners = corners_of(face);
  for (const auto node : corners)
    sum += at(mesh, node);
  return sum / static_cast<double>(corners.size());
}

} // namespace rubato::mesh
