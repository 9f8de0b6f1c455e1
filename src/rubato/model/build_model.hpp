// SPDX-License-Identifier: LGPL-3.0-or-later
/// Builds the model of a study.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/core/ranks.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/fwd.hpp"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace rubato::contact {
struct Zone;
} // namespace rubato::contact

namespace rubato::study {
struct MeshSource;
struct Study;
} // namespace rubato::study

namespace rubato::model {

/// Builds the discrete problem. Throws InputError with every rule that the study breaks, else with every
/// fault that shows against the mesh; faults have the path of the value in the study.
Model build_model(const study::Study& study, mesh::Mesh mesh, const Workers& workers = {});

/// The discrete problem from one of the releases on: the supports that end by then are gone, preloads that
/// are locked by then have their shortening. Its dofs and contact points are those of `first`, the model at
/// the begin of the run. `shortening`: one a preload [length].
Model build_stage(const Model& first, double release, const Eigen::VectorXd& shortening);

/// What preloads that are locked at one of the releases are shortened by, u being the displacements then;
/// leaves the others alone.
void lock_preloads(const Model& first, double release, const Eigen::VectorXd& u, Eigen::VectorXd& shortening);

/// A sentence for each zone whose sides the model has chosen: which one is the slave, and why.
std::vector<std::string> chosen_sides(std::span<const contact::Zone> zones);

/// The faults of each study that show against its mesh, without assembling anything: whoever is about to run
/// several learns first whether one of them is bad.
std::vector<std::vector<Fault>> faults_of(std::span<const study::Study> studies);

/// The mesh a study names or describes: read or generated, mended, converted and refined. Throws InputError;
/// what is wrong with a mesh file is told at the path that names it.
mesh::Mesh load_mesh(const study::MeshSource& source);

/// build_model on that mesh.
Model build_model(const study::Study& study, const Workers& workers = {});

} // namespace rubato::model
