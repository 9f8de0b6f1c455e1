// SPDX-License-Identifier: LGPL-3.0-or-later
// States: what steps change.
#include "rubato/contact/enforcement.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "model_class.hpp"
#include "values.hpp"
#include "views.hpp"
#include <memory>

namespace rubato::python {
namespace {

using step::State;

/// The state of a contact zone in a state of the whole that it keeps alive.
struct ZoneView {
  SharedState state;
  std::size_t index = 0;
  const contact::ZoneState& zone() const { return state->zones[index]; }
};

py::list zones_of(const SharedState& state) {
  py::list zones;
  for (std::size_t i = 0; i < state->zones.size(); ++i)
    zones.append(ZoneView{state, i});
  return zones;
}

/// One number a contact point, of a list of structs.
template <class Item>
py::array numbers_of(const ZoneView& zone, const std::vector<Item>& items, double Item::*member) {
  return member_view(items, items.empty() ? nullptr : &(items.front().*member), 1, py::cast(zone.state));
}

/// A vector a contact point.
template <class Vector> py::array vectors_of(const ZoneView& zone, Vector contact::PointOutcome::*member) {
  const auto& outcomes = zone.zone().outcomes;
  return member_view(outcomes, outcomes.empty() ? nullptr : (outcomes.front().*member).data(),
                     Vector::SizeAtCompileTime, py::cast(zone.state));
}

auto outcome(double contact::PointOutcome::*member) {
  return [member](const ZoneView& zone) { return numbers_of(zone, zone.zone().outcomes, member); };
}

auto history(double contact::FrictionHistory::*member) {
  return [member](const ZoneView& zone) { return numbers_of(zone, zone.zone().friction_history, member); };
}

void bind_zone(py::module_& module) {
  using contact::PointOutcome;
  py::class_<ZoneView>(module, "ZoneState",
                       "A contact zone in a state: an entry a contact point, in the order of "
                       "Model.contact_points(). Arrays are views.")
      .def_property_readonly(
          "status",
          [](const ZoneView& zone) {
            const auto& status = zone.zone().status;
            return view(reinterpret_cast<const std::uint8_t*>(status.data()),
                        {static_cast<py::ssize_t>(status.size())}, py::cast(zone.state));
          },
          "0 open, 1 sticking, 2 slipping: uint8, a view.")
      .def_property_readonly(
          "multipliers",
          [](const ZoneView& zone) { return view(zone.zone().multipliers, py::cast(zone.state)); },
          "Unknowns of exact methods, node after node of the slave surface [pressure], a view.")
      .def_property_readonly("gap", outcome(&PointOutcome::gap),
                             "Infinite where nothing faces the point [length].")
      .def_property_readonly("pressure", outcome(&PointOutcome::pressure),
                             "[pressure]; of nodal methods the force over the node's area.")
      .def_property_readonly("area", outcome(&PointOutcome::area),
                             "Undeformed, of the part of the point's share that faces the master [area].")
      .def_property_readonly(
          "slip", [](const ZoneView& zone) { return vectors_of(zone, &PointOutcome::slip); },
          "Of the last step along the two tangents: points x 2 [length].")
      .def_property_readonly(
          "normal_force", [](const ZoneView& zone) { return vectors_of(zone, &PointOutcome::normal); },
          "Of the master on the slave: points x 3 [force].")
      .def_property_readonly(
          "tangential_force",
          [](const ZoneView& zone) { return vectors_of(zone, &PointOutcome::tangential); },
          "Of the master on the slave: points x 3 [force].")
      .def_property_readonly("cumulated_slip", history(&contact::FrictionHistory::slip),
                             "Since the run began, while closed [length].")
      .def_property_readonly("friction_work", history(&contact::FrictionHistory::work),
                             "Taken by friction since the run began [force length].")
      .def("__len__", [](const ZoneView& zone) { return zone.zone().status.size(); });
}

/// What is at the nodes: nodes × 3, zero where there is no dof.
py::array at_nodes(const model::Model& model, const Eigen::VectorXd& values) {
  py::array_t<double> result({static_cast<py::ssize_t>(model.mesh.node_count()), py::ssize_t{3}});
  std::fill_n(result.mutable_data(), result.size(), 0.0);
  for (const auto node : model.dofs.nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      result.mutable_at(node, i) = values[model.dofs.dof(node, i)];
  return result;
}

auto of_motion(Eigen::VectorXd time::Motion::*part) {
  return [part](const State& state, const model::Model& model) {
    check_fits(model, state);
    return at_nodes(model, state.motion.*part);
  };
}

template <class Get> auto viewed(const Get& get) {
  return [get](const py::object& self) { return view(get(self.cast<const State&>()), self); };
}

} // namespace

void bind_state(py::module_& module) {
  bind_zone(module);
  py::class_<State, SharedState>(module, "State",
                                 "What steps change, at an instant. It does not change any more: an array of "
                                 "it stays what it is whatever steps "
                                 "follow. Vectors have an entry a degree of freedom, see Model.dofs; they "
                                 "are views that cannot be written.")
      .def_property_readonly(
          "t", [](const State& state) { return state.t; }, "Instant [time].")
      .def_property_readonly(
          "step", [](const State& state) { return state.step; },
          "Length of the step that ended here; 0 at the begin [time].")
      .def_property_readonly("u", viewed([](const State& s) -> auto& { return s.motion.u; }),
                             "Displacement [length].")
      .def_property_readonly("v", viewed([](const State& s) -> auto& { return s.motion.v; }),
                             "Velocity [length/time].")
      .def_property_readonly("a", viewed([](const State& s) -> auto& { return s.motion.a; }),
                             "Acceleration [length/time^2].")
      .def_property_readonly(
          "contact_force", viewed([](const State& s) -> auto& { return s.contact_force; }),
          "Contact and friction, on the side of the internal forces: minus what acts on the bodies "
          "[force].")
      .def_property_readonly("external_force",
                             viewed([](const State& s) -> auto& { return s.external_force; }),
                             "Loads [force].")
      .def_property_readonly("reaction", viewed([](const State& s) -> auto& { return s.reaction; }),
                             "Of the supports on the bodies, 0 elsewhere [force].")
      .def_property_readonly("zones", &zones_of, "Contact zones of the model, a ZoneState each.")
      .def("displacement", of_motion(&time::Motion::u), py::arg("model"),
           "At the nodes: nodes x 3, 0 where a node has no degree of freedom [length].")
      .def("velocity", of_motion(&time::Motion::v), py::arg("model"),
           "The same of the velocity [length/time].")
      .def("acceleration", of_motion(&time::Motion::a), py::arg("model"),
           "The same of the acceleration [length/time^2].")
      .def("__repr__", [](const State& state) {
        return fmt::format("<rubato.State: t = {:g}, {} degrees of freedom>", state.t, state.motion.u.size());
      });
}

} // namespace rubato::python
