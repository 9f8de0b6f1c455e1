// SPDX-License-Identifier: LGPL-3.0-or-later
/// The class of meshes, for the sources that add methods to it.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <memory>
#include <pybind11/pybind11.h>

namespace rubato::python {

using SharedMesh = std::shared_ptr<mesh::Mesh>;
using MeshClass = pybind11::class_<mesh::Mesh, SharedMesh>;

/// Meshes made of others, and built by programs.
void bind_mesh_tools(pybind11::module_& module, MeshClass& type);

} // namespace rubato::python
