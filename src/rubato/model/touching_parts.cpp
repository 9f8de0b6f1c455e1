// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/touching_parts.hpp"

#include "rubato/contact/sharp_edges.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/named_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace rubato::model {
namespace {

using Eigen::Vector3d;
using mesh::SurfaceFace;

/// Beyond this product of their normals faces do not face each other.
constexpr double facing = -0.1;
/// How far behind each other faces of bodies that overlap are, in sizes of the smaller face.
constexpr double overlap = 0.1;
/// Part of a face's size that is rounding of its place.
constexpr double same_place = 1e-9;

struct PlacedFace {
  Vector3d centre;
  Vector3d normal; ///< unit
  double size = 0;
};

struct SkinPart {
  int body = 0;
  std::vector<SurfaceFace> faces;
  std::vector<PlacedFace> places;
  SideMeasures::Side measured;
};

PlacedFace placed(const mesh::Mesh& mesh, const SurfaceFace& face) {
  const Vector3d normal = mesh::normal_of(mesh, face);
  const double area = contact::length_of(normal);
  return {mesh::centre_of(mesh, face), contact::unit_of(normal),
          mesh.dimension == 3 ? std::sqrt(area) : area};
}

/// Each in front of the other, or no more than `behind` behind it.
bool in_front(const PlacedFace& one, const PlacedFace& other, double behind) {
  const Vector3d apart = contact::difference_of(other.centre, one.centre);
  return contact::dot(apart, one.normal) > -behind && contact::dot(apart, other.normal) < behind;
}

/// The skins of all bodies, cut along their sharp edges; in the order of their first faces.
std::vector<SkinPart> skin_parts(const mesh::Mesh& mesh, const domain::Bulk& bulk, const Bodies& bodies) {
  const auto faces = mesh::skin(mesh, bulk.cells);
  const auto surface = surface_of(mesh, faces);
  const auto part_of_face = contact::smooth_parts(surface, contact::undeformed_places(mesh, surface));
  std::vector<SkinPart> parts;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (part_of_face[f] == parts.size())
      parts.push_back({bodies.of(faces[f].nodes().front()), {}, {}, {}});
    auto& part = parts[part_of_face[f]];
    part.faces.push_back(faces[f]);
    part.places.push_back(placed(mesh, faces[f]));
  }
  return parts;
}

bool can_touch(const SkinPart& one, const SkinPart& other) {
  return one.body != other.body && std::ranges::any_of(one.places, [&](const auto& a) {
           return std::ranges::any_of(other.places, [&](const auto& b) {
             return contact::dot(a.normal, b.normal) < facing &&
                    in_front(a, b, overlap * std::min(a.size, b.size));
           });
         });
}

/// What users call the bodies.
std::vector<std::string> names_of(const mesh::Mesh& mesh, const domain::Bulk& bulk, const Bodies& bodies) {
  std::vector<std::size_t> cells(static_cast<std::size_t>(bodies.count()), 0);
  for (const auto cell : bulk.cells)
    ++cells[static_cast<std::size_t>(bodies.of(mesh.nodes_of(cell).front()))];
  std::vector<std::string> names(cells.size());
  for (const auto& group : mesh.cell_groups) {
    std::set<int> found;
    for (const auto cell : group.items)
      found.insert(cell::topology(mesh.type_of(cell)).dimension == mesh.dimension
                       ? bodies.of(mesh.nodes_of(cell).front())
                       : -1);
    if (found.size() != 1 || *found.begin() < 0 || !is_name(group.name))
      continue;
    auto& name = names[static_cast<std::size_t>(*found.begin())];
    if (name.empty() && group.items.size() == cells[static_cast<std::size_t>(*found.begin())])
      name = group.name;
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].empty())
      names[i] = fmt::format("body{}", i + 1);
  return names;
}

/// Finds for each part what it is the slave of.
class Matching {
public:
  Matching(const mesh::Mesh& mesh, const domain::Bulk& bulk, const SideMeasures& measures)
      : bodies_(mesh, bulk), names_(names_of(mesh, bulk, bodies_)), parts_(skin_parts(mesh, bulk, bodies_)) {
    for (auto& part : parts_)
      part.measured = measures.of(part.faces);
  }

  std::vector<TouchingParts> zones() {
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t k = i + 1; k < parts_.size(); ++k)
        if (can_touch(parts_[i], parts_[k]))
          match(i, k);
    std::vector<TouchingParts> zones;
    for (const auto& [slave, masters] : masters_)
      zones.push_back(zone(slave, masters));
    return zones;
  }

private:
  struct Master {
    std::size_t part;
    std::string reason;
  };

  void match(std::size_t one, std::size_t other) {
    const auto choice = choose_slave(parts_[one].measured, parts_[other].measured);
    const auto [slave, master] = choice.slave == 0 ? std::pair(one, other) : std::pair(other, one);
    masters_[slave].push_back({master, choice.reason});
  }

  const std::string& name_of(std::size_t part) const {
    return names_[static_cast<std::size_t>(parts_[part].body)];
  }

  TouchingParts zone(std::size_t slave, const std::vector<Master>& masters) {
    TouchingParts zone;
    std::vector<std::string> names;
    for (const auto& master : masters) {
      const auto& faces = parts_[master.part].faces;
      zone.master.insert(zone.master.end(), faces.begin(), faces.end());
      if (std::ranges::find(names, name_of(master.part)) == names.end())
        names.push_back(name_of(master.part));
    }
    zone.slave = parts_[slave].faces;
    zone.slave_name = name_of(slave);
    zone.master_name = joined(names, ", ");
    zone.choice = masters.front().reason;
    zone.name = unused(names.size() == 1 ? zone.slave_name + "_" + names.front() : zone.slave_name);
    return zone;
  }

  std::string unused(const std::string& name) {
    auto free = name;
    for (int i = 2; !used_.insert(free).second; ++i)
      free = fmt::format("{}_{}", name, i);
    return free;
  }

  Bodies bodies_;
  std::vector<std::string> names_;
  std::vector<SkinPart> parts_;
  std::map<std::size_t, std::vector<Master>> masters_; ///< by slave
  std::set<std::string> used_;
};

} // namespace

std::vector<TouchingParts> touching_parts(const mesh::Mesh& mesh, const domain::Bulk& bulk,
                                          const SideMeasures& measures) {
  return Matching(mesh, bulk, measures).zones();
}

bool can_meet_itself(const mesh::Mesh& mesh, std::span<const SurfaceFace> faces) {
  std::vector<PlacedFace> places;
  for (const auto& face : faces)
    places.push_back(placed(mesh, face));
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = a + 1; b < places.size(); ++b)
      if (in_front(places[a], places[b], -same_place * places[a].size) &&
          std::ranges::none_of(faces[a].nodes(), [&](auto node) {
            return std::ranges::find(faces[b].nodes(), node) != faces[b].nodes().end();
          }))
        return true;
  return false;
}

} // namespace rubato::model
