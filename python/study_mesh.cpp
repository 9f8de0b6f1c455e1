// SPDX-License-Identifier: LGPL-3.0-or-later
// The mesh of a study.
#include "record.hpp"

namespace rubato::python {

using namespace study;

template <> struct Description<Body> {
  static constexpr std::string_view name = "Body";
  static constexpr std::string_view meaning = "A box or a rectangle cut into a regular grid.";
  static constexpr auto members = std::tuple(
      Member{"name", &Body::name, "of the body and of the group of its cells"},
      Member{"dimension", &Body::dimension, "2: rectangle, 3: box"},
      Member{"from_", &Body::from, "least coordinates [length]"},
      Member{"to", &Body::to, "greatest coordinates [length]"},
      Member{"divisions", &Body::divisions, "cells along x, y and z, each at least 1"},
      Member{"cells", &Body::cells, "type of the cells"},
      Member{"sides", &Body::sides, "group names of left, right (x), bottom, top (y), back, front (z)"},
      Member{"edges", &Body::edges, "of a box: group names of edges by the sides that meet, \"right_top\""},
      Member{"points", &Body::points, "group names of corners by the sides that meet, \"right_top_back\""});
};
template struct RecordCodec<Body>;

template <> struct Description<MadeGroup> {
  static constexpr std::string_view name = "MadeGroup";
  static constexpr std::string_view meaning = "A group that is made of what the mesh has.";
  static constexpr auto members = std::tuple(
      Member{"name", &MadeGroup::name, "of the group"}, Member{"kind", &MadeGroup::kind, "how it is made"},
      Member{"of", &MadeGroup::of, "groups it is made of; none: everything"},
      Member{"from_", &MadeGroup::from, "least coordinates of the box [length]"},
      Member{"to", &MadeGroup::to, "greatest ones [length]"},
      Member{"point", &MadeGroup::point, "of sphere, cylinder and plane [length]"},
      Member{"direction", &MadeGroup::direction, "axis or normal, of any length > 0"},
      Member{"radius", &MadeGroup::radius, "> 0 [length]"},
      Member{"within", &MadeGroup::within, "largest distance from plane or surface [length]"},
      Member{"angle", &MadeGroup::angle, "of normals with the direction, at most [degrees]"},
      Member{"take", &MadeGroup::take, "what a shape chooses"});
};
template struct RecordCodec<MadeGroup>;

template <> struct Description<MeshSource> {
  static constexpr std::string_view name = "MeshSource";
  static constexpr std::string_view meaning = "A mesh file, or bodies that are generated.";
  static constexpr auto members = std::tuple(
      Member{"file", &MeshSource::file, "from the current folder; empty when generated"},
      Member{"file_mesh", &MeshSource::file_mesh, "name of the mesh in the file; empty: its only one"},
      Member{"bodies", &MeshSource::bodies, "empty when read"},
      Member{"convert", &MeshSource::convert, "order that the cells are given"},
      Member{"refine", &MeshSource::refine, "parts that every edge is cut into"},
      Member{"groups", &MeshSource::groups, "made when that is done; one may be made of others"});
};
template struct RecordCodec<MeshSource>;

std::vector<RecordEntry> mesh_records() {
  return {record_entry<Body>(), record_entry<MadeGroup>(), record_entry<MeshSource>()};
}

} // namespace rubato::python
