// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: nodes, elements, sets and surfaces of an .inp file, by the labels and numbers
/// that its lines use.
#pragma once

#include "rubato/mesh/io/inp_elements.hpp"
#include "rubato/mesh/io/inp_layout.hpp"
#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace rubato::mesh::inp {

struct Element {
  const ElementType* type = nullptr;
  std::int64_t number = 0; ///< in its scope
  int scope = 0;
  std::size_t first_node = 0; ///< in Content::connectivity
  Word at;
};

/// A set of nodes or elements. `items` are their indices, ascending.
struct Set {
  std::string label; ///< as it is first written
  int scope = 0;
  std::vector<std::int32_t> items;
  std::string group; ///< what the mesh calls it; empty: it has no such group
};

struct ElementFace {
  std::int32_t element = 0;
  int side = 0; ///< of its cell
};

struct Surface {
  std::string label;
  int scope = 0;
  Word at;
  bool of_nodes = false;
  std::vector<ElementFace> faces;
  std::vector<NodeIndex> nodes;
  std::string group; ///< of cells, or of nodes
  /// Slave nodes of contact: the group of faces of bodies that have them, and the group of nodes
  /// of these faces that are not on the surface. Empty: none.
  std::string slave_faces;
  std::string beside;
  /// A pre-tension section: the group of the elements around it, its middle and its normal.
  std::string cut_cells;
  Eigen::Vector3d cut_point = Eigen::Vector3d::Zero();
  Eigen::Vector3d cut_normal = Eigen::Vector3d::Zero();
};

/// A note on a line of the file.
struct Remark {
  Word at;
  std::string text;
};

/// Sets or surfaces by scope and folded label.
template <class Item> using Labelled = std::map<std::pair<int, std::string>, Item>;

struct Content {
  Content() = default;
  Content(Content&&) = default;
  Content& operator=(Content&&) = default;
  Content(const Content&) = delete; ///< blocks refer to the source
  Content& operator=(const Content&) = delete;

  Source source;
  Layout layout;
  int dimension = 3;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::int64_t> node_numbers;    ///< in the mesh
  std::vector<std::int64_t> element_numbers; ///< in the mesh
  std::vector<Element> elements;
  std::vector<NodeIndex> connectivity;                                    ///< in the order of the cell types
  std::vector<std::unordered_map<std::int64_t, std::int32_t>> node_at;    ///< by number, of each scope
  std::vector<std::unordered_map<std::int64_t, std::int32_t>> element_at; ///< by number, of each scope
  Labelled<Set> node_sets;
  Labelled<Set> element_sets;
  Labelled<Surface> surfaces;
  /// Groups that the file has no label for: faces with *DLOAD and those of slave nodes, elements of a section
  /// with one formulation, nodes.
  std::map<std::string, std::vector<ElementFace>> loaded_faces;
  std::map<std::string, std::vector<std::int32_t>> made_cells;
  std::map<std::string, std::vector<NodeIndex>> made_nodes;
  std::vector<Remark> remarks;
  /// By reference node of a coupling that is written as equations: the node, at its place, whose
  /// displacements are its rotations. In the plane the first displacement is the rotation about z.
  std::map<NodeIndex, NodeIndex> rotation_nodes;
  std::set<NodeIndex> shared_references; ///< reference nodes of several couplings, or of equations, too

  std::span<const NodeIndex> nodes_of(const Element& element) const {
    return std::span(connectivity)
        .subspan(element.first_node, static_cast<std::size_t>(element.type->node_count));
  }
};

/// Reads everything that a mesh is made of. Throws InputError with every fault of it.
Content read_content(const std::filesystem::path& path);
/// The same of text (inp_blocks.hpp: parse_source).
Content parse_content(std::string text, const std::string& name);

/// Nodes, cells, and groups with the names of sets and surfaces.
Mesh mesh_of(const Content& content);

/// What a label or a number on a line stands for.
struct Found {
  std::string name;                ///< of the group; of a single one "N12" of a node, "E12" of an element
  std::vector<std::int32_t> items; ///< nodes or elements, ascending
  bool is_set = false;
};
/// A set of nodes or a node; a fault and nothing found where there is none. `INSTANCE.LABEL` is looked up in
/// that instance.
std::optional<Found> find_nodes(const Content& content, int scope, const Word& word, Faults& faults);
std::optional<Found> find_elements(const Content& content, int scope, const Word& word, Faults& faults);
const Surface* find_surface(const Content& content, int scope, const Word& word, Faults& faults);

/// The group of the faces with that number of an element or a set, "EALL.P3".
std::string loaded_group(const Found& elements, int face);

// ---- parts of read_content

/// *NGEN, *NFILL, *NCOPY: nodes from those above.
void generate_nodes(Content& content, const Placed& placed, Faults& faults);
/// *ELGEN, *ELCOPY: elements from those above.
void generate_elements(Content& content, const Placed& placed, Faults& faults);
/// A set of nodes while nodes are read, for keywords that make nodes of sets.
void read_node_set(Content& content, const Placed& placed, Faults& faults);
/// Sets, in the order of the file: sets of sets name those above.
void read_sets(Content& content, Faults& faults);
void read_surfaces(Content& content, Faults& faults);
/// Faces with pressures by *DLOAD.
void read_loaded_faces(Content& content, Faults& faults);
/// Elements without a section beside bodies become surfaces, as mesh generators write them.
void settle_families(Content& content);
/// Groups of the elements of each section that have one formulation, where it has several.
void split_sections(Content& content);
/// The elements of a set that have the formulation: the set's own group where all have it.
std::string section_group(const Found& elements, Integration how, bool all);
/// Middles, normals and elements of the surfaces of pre-tension sections.
void find_cuts(Content& content);
/// Moves slave nodes onto their masters as *TIE and *CONTACT PAIR, ADJUST= say.
void adjust_slaves(Content& content, Faults& faults);
/// The least and the largest distance of slave nodes from the master.
std::pair<double, double> distances(const Content& content, const Surface& slave, const Surface& master);
/// Nodes for the rotations of reference nodes whose couplings are no rigid or distributed relation.
void add_rotation_nodes(Content& content);
/// Faces that one element of a body has alone.
std::vector<ElementFace> free_faces(const Content& content);
/// Faces of bodies for surfaces of nodes that contact pairs and ties have as slaves.
void find_slave_faces(Content& content, Faults& faults);
/// Sets and surfaces get the names of their groups: their labels, with the instance before them where labels
/// of several instances are equal.
void name_groups(Content& content);

} // namespace rubato::mesh::inp
