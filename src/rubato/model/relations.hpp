// SPDX-License-Identifier: LGPL-3.0-or-later
/// Supports and relations as prescribed dofs and linear equations.
#pragma once

#include "rubato/constraint/elimination.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/references.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rubato::contact {
struct Zone;
} // namespace rubato::contact

namespace rubato::model {

/// Equations and what in the study says each: the source of an equation is the place of its path.
struct Equations {
  std::vector<constraint::Equation> list;
  std::vector<std::string> paths;
};

/// What the functions below need of a model that is being made.
struct Parts {
  const study::Study& study;
  const mesh::Mesh& mesh;
  const domain::DofMap& dofs;
  std::span<const Reference> references;
};

/// A field of the study, integrated over the run where it gives a velocity or an acceleration. Throws
/// InputError where that cannot be done.
std::shared_ptr<const FieldFunction> shared_field(const Parts& parts, const study::Field& field,
                                                  const std::string& path);

/// A field's value at a node. An expression that does not change with time, or a table along an axis, is a
/// number there. Throws
/// InputError when it is no finite number.
constraint::ImposedValue imposed_at(const Parts& parts, mesh::NodeIndex node,
                                    const std::shared_ptr<const FieldFunction>& field);
/// The same at any place.
constraint::ImposedValue imposed_at(const Parts& parts, const Eigen::Vector3d& place,
                                    const std::shared_ptr<const FieldFunction>& field);

/// Adds what a support says along a direction across the axes.
void add_oblique(const Parts& parts, const study::Support& support, const std::string& path,
                 Equations& equations, std::vector<Fault>& faults);
/// Adds what a support says of a reference.
void add_held_reference(const Parts& parts, const study::Support& support, const std::string& path,
                        Equations& equations);
/// Adds what pairs of nodes have at the cut of a preload: one jump, along the normal; the one that is given
/// by a shortening, or that is locked at one.
void add_preload(const Parts& parts, const study::Preload& preload, const PreloadedCut& cut,
                 const std::optional<double>& locked, Equations& equations);
/// Adds what a tie says of its nodes, with multipliers: the way of explicit runs, whose steps solve for no
/// multipliers of contact.
void add_tie(const Parts& parts, const contact::Zone& zone, Equations& equations);
/// Notes on ties over a gap whose relations keep the linearised rotation though bodies turn: explicit runs.
std::vector<std::string> notes_on_tied_gaps(const Model& model);
/// Adds a relation.
void add_relation(const Parts& parts, const study::Relation& relation, Equations& equations,
                  std::vector<Fault>& faults);

} // namespace rubato::model
