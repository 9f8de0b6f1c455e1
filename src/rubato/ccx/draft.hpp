// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: what is written so far, and the functions that write parts of a study.
#pragma once

#include "rubato/ccx/text.hpp"
#include "rubato/ccx/write.hpp"
#include "rubato/core/error.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/model.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::ccx {

/// A value of each instant: a factor times an amplitude, whose label is empty where it is 1 throughout.
struct Course {
  double factor = 0;
  std::string amplitude;
  bool operator<(const Course& other) const {
    return std::tie(factor, amplitude) < std::tie(other.factor, other.amplitude);
  }
  bool operator==(const Course&) const = default;
};

/// A component of a node of the file, from 1.
struct Place {
  std::int64_t node = 0;
  int component = 0;
  auto operator<=>(const Place&) const = default;
};

struct PlaceTerm {
  Place at;
  double coefficient = 0;
};

struct Draft {
  Labels labels;
  std::vector<std::string> notes;
  std::set<std::string> changed_names; ///< of groups, with their labels, for one note

  double begin = 0; ///< of the first run: CalculiX' total time is 0 there

  std::vector<std::int64_t> node_numbers;    ///< by node of the mesh
  std::vector<std::int64_t> element_numbers; ///< by cell of the mesh; 0 of those that are not written
  std::int64_t next_node = 1;
  std::int64_t next_element = 1;
  std::map<std::string, std::int64_t> made_nodes; ///< by what they are for

  std::string all_nodes;                        ///< label of the set of all nodes of the mesh
  std::map<std::string, std::string> node_sets; ///< labels by name in the study
  std::map<std::string, std::string> element_sets;
  std::map<std::string, std::string> surface_labels;
  std::map<std::vector<std::int64_t>, std::string> node_sets_by_content;
  std::vector<std::vector<std::string>> element_sets_of_law; ///< of each material, those of its elements

  std::string mesh;       ///< nodes, elements, sets and surfaces
  std::string more_sets;  ///< that steps refer to
  std::string more_nodes; ///< nodes with displacements of others
  std::string amplitudes;
  std::map<std::string, std::string> amplitude_of_table; ///< label by text
  std::string initial;
  std::string body;                    ///< materials, relations and contact: the same of all steps
  std::map<Place, std::string> copies; ///< equations of nodes that move as another one, for a second force
  std::vector<std::string> steps;
  std::map<std::string, std::string> parts; ///< of the last step: supports, loads and temperatures by keyword
  bool has_energies = false;                ///< whether the first step has a table of energies of cells
  std::string last_run;
};

/// A component of a node that is not of the mesh, with its displacement.
struct MovedNode {
  Place at;
  Course course;
};

/// One run while its step is written.
struct Run {
  const model::Model& model;
  Draft& draft;
  std::vector<Fault>& faults;
  bool nonlinear = false; ///< NLGEOM
  bool modes = false;
  std::int64_t next_element = 1;           ///< of those that are no cells: the same numbers in each run
  std::vector<MovedNode> moved = {};       ///< of obstacles
  std::vector<std::string> materials = {}; ///< labels of those that elements have
  std::string body = {};

  const study::Study& study() const { return model.study; }
  bool is_plane() const { return model.mesh.dimension == 2; }
  bool is_static() const { return !modes && study().time.scheme == study::SchemeKind::static_steps; }
  void refuse(std::string path, std::string text) {
    faults.push_back(fault_at(std::move(path), std::move(text)));
  }
};

/// Adds a note, once.
void add_note(Draft& draft, const std::string& text);

// ---- mesh

/// Numbers nodes and elements; writes both, with the sets and surfaces of all groups.
void write_mesh(Run& run);
/// The number of a node that is not of the mesh, made at its first use.
std::int64_t made_node(Draft& draft, const std::string& purpose,
                       const Eigen::Vector3d& place = Eigen::Vector3d::Zero());
/// A set with these nodes of the mesh, or the number of a single one.
std::string label_of_nodes(Run& run, std::span<const mesh::NodeIndex> nodes, std::string_view name);
/// A surface with these faces.
std::string label_of_faces(Run& run, std::span<const mesh::SurfaceFace> faces, const std::string& name);
/// The number of a face in its element, from 1.
int face_number(const model::Model& model, const mesh::SurfaceFace& face);
Place place_of(const Run& run, int dof);

// ---- functions of time

/// Instants at which a run has steps, ascending, with the first one.
std::vector<double> instants_of(const study::TimeStepping& time);
/// Returns whether the steps of a run are equally long.
bool has_equal_steps(const study::TimeStepping& time);
Course course_of(Run& run, double value, const std::optional<Function>& function, std::string_view name);
/// The course of a function that is only known by its values; `name` is that of the amplitude.
Course sampled_course(Run& run, const std::function<double(double)>& value_at, std::string_view name);

// ---- parts of the body

void write_materials(Run& run);
/// The lines of *PLASTIC.
std::string hardening_lines(Run& run, const study::Material& material);
void write_relations(Run& run);
/// Adds an equation; the first term is the one that follows from the others.
void write_equation(std::string& body, std::span<const PlaceTerm> terms);
void write_springs(Run& run);
void write_masses(Run& run);
void write_contact(Run& run);
/// Adds a rigid block whose face is the plane of a zone's obstacle, which supports move. `label`: of its
/// surface and of its set of elements.
void write_obstacle(Run& run, const study::Obstacle& obstacle, const std::string& zone,
                    const std::string& label);
void write_initial(Run& run);

// ---- parts of the step, the lines below one keyword each

std::string support_lines(Run& run);
void write_loads(Run& run, std::map<std::string, std::string>& parts);
std::string temperature_lines(Run& run);
std::string request_lines(Run& run);
std::string procedure_lines(Run& run, const std::optional<Frequencies>& modes);

/// Refuses keys of the study that CalculiX has no counterpart of.
void check_limits(Run& run);

} // namespace rubato::ccx
