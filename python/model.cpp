// SPDX-License-Identifier: LGPL-3.0-or-later
// Models: numbering, matrices, loads.
#include "rubato/model/model.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/threads.hpp"
#include "rubato/mesh/made_groups.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/model/sparse_matrix.hpp"
#include "rubato/simulation/memento.hpp"

#include <fmt/format.h>

#include "model_class.hpp"
#include "values.hpp"
#include "views.hpp"
#include <algorithm>
#include <pybind11/stl.h>

namespace rubato::python {
namespace {

using model::Model;

/// What an echo has where a program gave the mesh.
constexpr const char* given_mesh = "(mesh of a program)";

py::array dofs_of(const Model& model) {
  const auto& dofs = model.dofs;
  py::array_t<std::int32_t> numbers(
      {static_cast<py::ssize_t>(model.mesh.node_count()), py::ssize_t{dofs.components}});
  for (mesh::NodeIndex node = 0; node < model.mesh.node_count(); ++node)
    for (int i = 0; i < dofs.components; ++i)
      numbers.mutable_at(node, i) = dofs.has(node) ? dofs.dof(node, i) : -1;
  return numbers;
}

int dof_of(const Model& model, const py::object& node, const py::object& component) {
  const auto axis = PyIndex_Check(component.ptr()) != 0
                        ? Codec<int>::from(component, "component")
                        : static_cast<int>(Codec<Axis>::from(component, "component"));
  if (axis < 0 || axis >= model.dofs.components)
    throw py::index_error(
        fmt::format("component: found {}, expected 0 to {}", axis, model.dofs.components - 1));
  mesh::NodeIndex index = 0;
  if (py::isinstance<py::str>(node)) {
    const auto found = mesh::find_nodes(model.mesh, node.cast<std::string>());
    if (!found.fault.empty() || found.nodes.size() != 1)
      throw InputError(found.fault.empty() ? fmt::format("group {} has {} nodes, expected one",
                                                         shown(node.cast<std::string>()), found.nodes.size())
                                           : found.fault);
    index = found.nodes.front();
  } else {
    index = indices_of(py::make_tuple(node), model.mesh.node_count(), "nodes").front();
  }
  return model.dofs.has(index) ? model.dofs.dof(index, axis) : -1;
}

/// (data, indices, indptr) of compressed columns, views; the matrix is compressed.
py::tuple columns_of(const model::SparseMatrix& matrix, py::handle owner) {
  return py::make_tuple(view(matrix.valuePtr(), {matrix.nonZeros()}, owner),
                        view(matrix.innerIndexPtr(), {matrix.nonZeros()}, owner),
                        view(matrix.outerIndexPtr(), {matrix.cols() + 1}, owner));
}

/// A view that can be written.
py::array changeable(Eigen::VectorXd& numbers, py::handle owner) {
  return py::array_t<double>({numbers.size()}, numbers.data(), owner);
}

void assign(Eigen::VectorXd& numbers, const Numbers& values) {
  if (values.size() != numbers.size())
    throw std::invalid_argument(
        fmt::format("found {} numbers, expected one a degree of freedom: {}", values.size(), numbers.size()));
  std::copy_n(values.data(), values.size(), numbers.data());
}

void bind_matrices(ModelClass& type) {
  type.def_property_readonly(
          "mass", [](const py::object& self) { return columns_of(self.cast<const Model&>().mass, self); },
          "Mass matrix: (data, indices, indptr) of its compressed columns, views; no entries in static and "
          "explicit "
          "runs. Symmetric, so that scipy.sparse.csc_matrix(model.mass) has it.")
      .def_property_readonly(
          "stiffness",
          [](const py::object& self) {
            return columns_of(self.cast<const Model&>().domain.initial_tangent(), self);
          },
          "Tangent of the undeformed bodies, as mass [force/length]: cells, springs and connectors, without "
          "contact.")
      .def_property_readonly(
          "damping",
          [](const py::object& self) { return columns_of(self.cast<const Model&>().damping, self); },
          "Damping matrix, as mass [force time/length]; no entries without Rayleigh coefficients and "
          "dashpots.")
      .def_property_readonly(
          "lumped_mass",
          [](const py::object& self) { return view(self.cast<const Model&>().lumped_mass, self); },
          "Of an explicit run one a degree of freedom [mass], a view; else empty.")
      .def(
          "external_force", [](const Model& model, double t) { return model::external_force(model, t); },
          py::arg("t"), py::call_guard<py::gil_scoped_release>(),
          "Loads at an instant, one a degree of freedom [force].");
}

void bind_initial(ModelClass& type) {
  type.def_property(
          "initial_displacement",
          [](const py::object& self) { return changeable(self.cast<Model&>().initial.displacement, self); },
          [](Model& model, const Numbers& values) { assign(model.initial.displacement, values); },
          "Where the bodies are when a simulation of the model begins, one a degree of freedom [length]: a "
          "view that "
          "can be written. Supports count before it.")
      .def_property(
          "initial_velocity",
          [](const py::object& self) { return changeable(self.cast<Model&>().initial.velocity, self); },
          [](Model& model, const Numbers& values) { assign(model.initial.velocity, values); },
          "How they move then [length/time]: a view that can be written. Supports count before it.");
}

} // namespace

study::Study on_given_mesh(study::Study study) {
  if (study.mesh.file.empty() && study.mesh.bodies.empty())
    study.mesh.file = given_mesh;
  return study;
}

mesh::Mesh as_run(mesh::Mesh mesh, const study::MeshSource& source) {
  mesh::mend_orientation(mesh);
  return source.groups.empty() ? std::move(mesh) : mesh::with_groups(std::move(mesh), source.groups);
}

SharedModel make_model(const py::object& study, std::optional<mesh::Mesh> mesh, int threads) {
  const Threads workers(threads);
  const auto of = Codec<study::Study>::from(study, "");
  const py::gil_scoped_release unlocked;
  if (!mesh)
    return std::make_shared<Model>(model::build_model(of, workers));
  return std::make_shared<Model>(
      model::build_model(on_given_mesh(of), as_run(std::move(*mesh), of.mesh), workers));
}

void check_fits(const Model& model, const step::State& state) {
  if (!simulation::fits(model, state) || !simulation::remembers_alike(model, state))
    throw InputError(
        "the state is that of another model: one with another mesh, other contact zones or materials "
        "that remember something else");
}

std::size_t zone_of(const Model& model, const py::object& zone) {
  if (!py::isinstance<py::str>(zone))
    return static_cast<std::size_t>(
        indices_of(py::make_tuple(zone), static_cast<std::int64_t>(model.zones.size()), "zones").front());
  std::vector<std::string> names;
  for (const auto& any : model.zones)
    names.push_back(any.settings.name);
  const auto name = zone.cast<std::string>();
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError(fmt::format("no contact zone is called {}{}", shown(name), suggestion(name, names)));
  return static_cast<std::size_t>(found - names.begin());
}

ModelClass declare_model(py::module_& module) {
  return {module, "Model",
          "The discrete problem of a study: numbered unknowns, matrices, loads, contact zones."};
}

void bind_model(ModelClass& type) {
  type.def(py::init([](const py::object& study, const mesh::Mesh* mesh, int threads) {
             return make_model(study, mesh != nullptr ? std::optional(*mesh) : std::nullopt, threads);
           }),
           py::arg("study"), py::arg("mesh") = py::none(), py::arg("threads") = 1,
           "mesh: instead of the one that the study names; it is copied, its cells are mended and it gets "
           "the groups "
           "that study.mesh makes. Raises InputError with every rule that the study breaks, else with every "
           "fault "
           "that shows against the mesh. threads: that assembly and simulations may use.")
      .def_property_readonly(
          "mesh", [](const SharedModel& model) { return std::shared_ptr<mesh::Mesh>(model, &model->mesh); },
          "The mesh of the model.")
      .def_property_readonly(
          "study", [](const Model& model) { return Codec<study::Study>::to(model.study); },
          "A copy of the study.")
      .def_property_readonly(
          "notes", [](const Model& model) { return model.notes; },
          "Sentences that whoever runs it should read.")
      .def_property_readonly(
          "zone_names",
          [](const Model& model) {
            py::list names;
            for (const auto& zone : model.zones)
              names.append(zone.settings.name);
            return names;
          },
          "Names of the contact zones, in their order; those of 'all' are a zone a pair of surfaces.")
      .def_property_readonly(
          "dof_count", [](const Model& model) { return model.dofs.dof_count; },
          "Number of degrees of freedom.")
      .def_property_readonly(
          "dofs", &dofs_of,
          "Place of each node's component in u, v, a and forces: nodes x axes, int32; -1 where a "
          "node has none.")
      .def("dof", &dof_of, py::arg("node"), py::arg("component"),
           "Place of a component (0, 1, 2 or \"x\", \"y\", \"z\") of a node (index or name); -1 where it has "
           "none.");
  bind_matrices(type);
  bind_initial(type);
  bind_model_fields(type);
}

} // namespace rubato::python
