// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: what has been read so far, and the functions that read keywords into it.
#pragma once

#include "rubato/core/transformed.hpp"
#include "rubato/inp/material_data.hpp"
#include "rubato/inp/read.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::inp {

using mesh::inp::Block;
using mesh::inp::Content;
using mesh::inp::Faults;
using mesh::inp::Found;
using mesh::inp::Placed;
using mesh::inp::Word;

/// A function of time, of the step or of all steps: a table, or an expression of T.
struct Curve {
  std::string name;
  LinearTable table;
  std::string formula;     ///< empty: the table
  bool total_time = false; ///< else the time of the step
};

/// A material of the study: what it is made of at each temperature, and its elements.
struct MadeMaterial {
  const MaterialData* data = nullptr;
  study::Material turned; ///< has the axes
  std::vector<std::int32_t> elements;
};

/// Axes of a material.
struct Axes {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< columns: x', y', z' in those that it turns
  std::optional<study::CylindricalAxes> cylindrical;
  Word at;
};

/// Axes that lines of nodes refer to, and couplings.
struct LocalAxes {
  enum class Kind { rectangular, cylindrical, spherical };
  Kind kind = Kind::rectangular;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< columns: the axes; the third is the line otherwise
};

/// A contact property.
struct Interaction {
  study::ContactZone numbers; ///< friction and method
  Word at;
  bool tied = false;    ///< surfaces do not part or slide
  bool changed = false; ///< in the step that is read
};

/// The relation that a node is the reference of; of a node for rotations alone its displacements are
/// rotations.
struct ReferenceNode {
  std::string relation;
  bool rotations = false;
};

/// What of a body the lines of *BOUNDARY and *CLOAD are about.
struct Target {
  std::string name; ///< in a study
  std::vector<std::int32_t> nodes;
  const ReferenceNode* reference = nullptr;
  std::int32_t rotation = -1; ///< the node whose displacements are the rotations; −1: none
};

/// A set of elements by its group.
struct ElementGroup {
  std::string name;
  std::vector<std::int32_t> items; ///< ascending
  bool operator==(const ElementGroup&) const = default;
};

struct Reading {
  Reading(const Content& all, Faults& told) : content(all), faults(told) {}

  const Content& content;
  Faults& faults;
  std::vector<std::string> notes;
  std::map<std::string, std::vector<int>> harmless; ///< lines of keywords and values that change nothing
  std::string title;

  study::Study study; ///< what all steps share
  Places places;
  std::map<std::string, Curve> curves; ///< by folded label, as all below
  std::map<std::string, MaterialData> materials;
  std::vector<MadeMaterial> made_materials; ///< of each material of the study
  std::map<std::string, Axes> axes;
  std::map<std::string, Interaction> interactions;
  std::set<std::string> removed_zones;              ///< by *MODEL CHANGE
  std::vector<ElementGroup> removed_elements;       ///< likewise
  std::map<std::int32_t, ReferenceNode> references; ///< by node
  std::vector<char> body_nodes;                     ///< by node: whether an element that deforms has it
  std::set<std::int32_t> used_nodes;                ///< of equations, springs, dashpots and masses
  std::vector<LocalAxes> transforms;
  std::map<std::int32_t, std::size_t> axes_of_node; ///< its axes in `transforms`
  bool massless_contact = false;
  std::vector<std::pair<std::string, study::Preload>> pretensions; ///< with the name of their node
  std::set<std::string> names;                                     ///< taken, of what a study names
  std::map<std::string, int> next_names;                           ///< numbers behind names that are taken
  std::map<std::string, double> densities;                         ///< by folded label of the element set
  std::vector<std::int32_t> with_section;                          ///< elements
  std::optional<double> initial_temperature;
  std::vector<std::int32_t> nodes_with_initial_temperature;

  int dimension() const { return content.dimension; }
};

/// A name that a study may have, made of a label, that nothing else of the kind has; of a relation, which
/// stands for a point, no set or surface either.
std::string chosen_name(Reading& reading, std::string_view kind, std::string_view label);
inline constexpr std::string_view relation_kind = "relation";
/// A note, once.
void note(Reading& reading, const Word& at, const std::string& text);
/// Tells once that something changes nothing.
void leave_out(Reading& reading, const Word& at, const std::string& what);
/// A keyword that changes nothing; a fault where it does all the same.
void leave_out(Reading& reading, const Block& block);
/// Sorted lists share an item.
bool share(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b);

/// The entry of that label; nullptr and a fault with the nearest label.
template <class Entry>
const Entry* named(const std::map<std::string, Entry>& entries, const Word& label, std::string_view what,
                   Faults& faults);
void refuse_label(const Word& label, std::string_view what, const std::vector<std::string>& known,
                  Faults& faults);
template <class Entry>
const Entry* named(const std::map<std::string, Entry>& entries, const Word& label, std::string_view what,
                   Faults& faults) {
  const auto found = entries.find(mesh::inp::folded(label.text));
  if (found != entries.end())
    return &found->second;
  const auto known =
      transformed<std::string>(entries, [](const auto& entry) -> const std::string& { return entry.first; });
  refuse_label(label, what, known, faults);
  return nullptr;
}

/// A node, a set, or the reference that a node is; nothing and a fault where there is none.
std::optional<Target> find_target(Reading& reading, int scope, const Word& word);
/// What a study calls a single node.
std::string node_name(const Reading& reading, std::int32_t node);
/// The keyword above that this one completes: the nearest block before `index` of one of these names that no
/// other keyword than those in `between` separates; nullptr and a fault when there is none.
const Placed* parent_of(Reading& reading, std::size_t index, std::string_view parent,
                        std::initializer_list<std::string_view> between);

// ---- keywords outside of steps; `index`: of the block in content.layout.blocks

void read_amplitude(Reading& reading, std::size_t index);
void read_material(Reading& reading, std::size_t index);
void read_elastic(Reading& reading, std::size_t index);
void read_density(Reading& reading, std::size_t index);
void read_expansion(Reading& reading, std::size_t index);
void read_damping(Reading& reading, std::size_t index);
void read_plastic(Reading& reading, std::size_t index);
void read_cyclic_hardening(Reading& reading, std::size_t index);
void read_rate_dependent(Reading& reading, std::size_t index);
void read_hyperelastic(Reading& reading, std::size_t index);
void read_viscoelastic(Reading& reading, std::size_t index);
void read_creep(Reading& reading, std::size_t index);
void read_orientation(Reading& reading, std::size_t index);
void read_solid_section(Reading& reading, std::size_t index);
void read_initial_conditions(Reading& reading, std::size_t index);
void read_coupling(Reading& reading, std::size_t index);
void read_kinematic_coupling(Reading& reading, std::size_t index);
void read_distributing_coupling(Reading& reading, std::size_t index);
void read_rigid_body(Reading& reading, std::size_t index);
void read_embedded(Reading& reading, std::size_t index);
void read_equation(Reading& reading, std::size_t index);
void read_mpc(Reading& reading, std::size_t index);
void read_transform(Reading& reading, std::size_t index);
void read_gap(Reading& reading, std::size_t index);
void read_pretension(Reading& reading, std::size_t index);
void read_spring(Reading& reading, std::size_t index);
void read_dashpot(Reading& reading, std::size_t index);
void read_mass(Reading& reading, std::size_t index);
void read_tie(Reading& reading, std::size_t index);
void read_interaction(Reading& reading, std::size_t index);
void read_surface_behavior(Reading& reading, std::size_t index);
void read_friction(Reading& reading, std::size_t index);
/// Returns the elements of a group of cells, by their places in the content; none of an unknown group.
std::vector<std::int32_t> elements_of_group(const Reading& reading, const std::string& group);

void read_contact_pair(Reading& reading, std::size_t index);
void read_clearance(Reading& reading, std::size_t index);
void read_general_contact(Reading& reading, std::size_t index);

/// What is wrong with the elements as a whole, and what their formulations differ in.
void check_elements(Reading& reading);
/// Elements of springs, dashpots and masses without their keyword, cells without a section.
void check_properties(Reading& reading);

} // namespace rubato::inp
