// SPDX-License-Identifier: LGPL-3.0-or-later
/// The parts of the module, a source each.
#pragma once

#include <pybind11/pybind11.h>

namespace rubato::python {

void bind_errors(pybind11::module_& module);
void bind_study(pybind11::module_& module);
void bind_given_field(pybind11::module_& module);
void bind_deck(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_mesh_report(pybind11::module_& module);
void bind_state(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_fields(pybind11::module_& module);
void bind_runs(pybind11::module_& module);
void bind_stored(pybind11::module_& module);
void bind_comparison(pybind11::module_& module);

} // namespace rubato::python
