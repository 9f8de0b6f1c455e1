// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/version.hpp"

#include "bind.hpp"
#include "model_class.hpp"
#include <pybind11/stl.h>
#include <string>
#include <vector>

PYBIND11_MODULE(_rubato, module) {
  using namespace rubato;
  module.doc() = "The compiled part of rubato.";
  module.attr("__version__") = std::string(version);
  module.def("_unknown_name", [](const std::string& name, const std::vector<std::string>& known) {
    return "found " + shown(name) + suggestion(name, known);
  });
  python::bind_errors(module);
  python::bind_given_field(module);
  python::bind_study(module);
  python::bind_deck(module);
  python::bind_mesh_report(module);
  python::bind_mesh(module);
  auto model = python::declare_model(module); // states name it
  python::bind_state(module);
  python::bind_fields(module);
  python::bind_model(model);
  python::bind_simulation(module);
  python::bind_runs(module);
  python::bind_stored(module);
  python::bind_comparison(module);
}
