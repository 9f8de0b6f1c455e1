// SPDX-License-Identifier: LGPL-3.0-or-later
/// Models and states as Python holds them.
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/step/state.hpp"
#include "rubato/study/study.hpp"

#include <memory>
#include <optional>
#include <pybind11/pybind11.h>

namespace rubato::python {

using SharedModel = std::shared_ptr<model::Model>;
using ModelClass = pybind11::class_<model::Model, SharedModel>;
/// Python can only read states: that it holds them as ones that could change is pybind11's.
using SharedState = std::shared_ptr<step::State>;

/// A study whose mesh a program gives: it says so where it names none.
study::Study on_given_mesh(study::Study study);
/// The mesh as the study has it: cells mended, with the groups that the study makes. Throws InputError.
mesh::Mesh as_run(mesh::Mesh mesh, const study::MeshSource& source);

/// Of a record of a study, on the mesh if there is one. With the interpreter's lock held; throws InputError.
SharedModel make_model(const pybind11::object& study, std::optional<mesh::Mesh> mesh, int threads);

/// Throws InputError for a state of another model.
void check_fits(const model::Model& model, const step::State& state);

/// The index of a zone that is given by its name or its index. Throws InputError, IndexError and TypeError.
std::size_t zone_of(const model::Model& model, const pybind11::object& zone);

/// The class without its methods, for those of other classes that take models.
ModelClass declare_model(pybind11::module_& module);
void bind_model(ModelClass& type);
/// Adds the fields of states to the class.
void bind_model_fields(ModelClass& type);

} // namespace rubato::python
