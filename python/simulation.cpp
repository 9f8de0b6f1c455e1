// SPDX-License-Identifier: LGPL-3.0-or-later
// Simulations. Steps are made without the interpreter's lock.
#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "model_class.hpp"
#include "running.hpp"
#include "values.hpp"
#include <pybind11/stl.h>

namespace rubato::python {
namespace {

using simulation::Attempt;
using simulation::Memento;
using step::EnergyLedger;

py::dict energy_dict(const EnergyLedger& energy) {
  py::dict result;
  result["kinetic"] = energy.kinetic;
  result["strain"] = energy.strain;
  result["external_work"] = energy.external_work;
  result["support_work"] = energy.support_work;
  result["overlap_work"] = energy.overlap_work;
  result["heat"] = energy.heat;
  result["damping"] = energy.damping;
  result["contact"] = energy.contact;
  result["friction"] = energy.friction;
  result["plastic"] = energy.plastic;
  result["back_stress"] = energy.back_stress;
  result["viscous"] = energy.viscous;
  result["hourglass"] = energy.hourglass;
  result["impact"] = energy.impact;
  result["numerical"] = energy.numerical;
  result["bulk_scheme"] = energy.bulk_scheme;
  result["unbalanced"] = energy.unbalanced;
  result["balance"] = energy.balance();
  return result;
}

void bind_energy(py::module_& module) {
  py::class_<EnergyLedger>(module, "EnergyLedger",
                           "What the bodies store, and what they were given and gave [force length].")
      .def_readonly("kinetic", &EnergyLedger::kinetic, "Stored in motion.")
      .def_readonly("strain", &EnergyLedger::strain, "Stored in strains.")
      .def_readonly("contact", &EnergyLedger::contact, "Stored in penalty springs.")
      .def_readonly("external_work", &EnergyLedger::external_work, "Of the loads, since the begin.")
      .def_readonly("support_work", &EnergyLedger::support_work,
                    "Of supports and obstacles that move, since the begin.")
      .def_readonly("overlap_work", &EnergyLedger::overlap_work,
                    "Of pressures that close what overlapped at the begin.")
      .def_readonly("heat", &EnergyLedger::heat, "Put into bodies that expand by their temperature.")
      .def_readonly("damping", &EnergyLedger::damping, "Dissipated by damping.")
      .def_readonly("friction", &EnergyLedger::friction, "Dissipated by friction.")
      .def_readonly("plastic", &EnergyLedger::plastic, "Dissipated by plastic strain.")
      .def_readonly("back_stress", &EnergyLedger::back_stress, "Stored in back stresses of plasticity.")
      .def_readonly("viscous", &EnergyLedger::viscous, "Dissipated by viscoelastic materials.")
      .def_readonly("hourglass", &EnergyLedger::hourglass,
                    "Stored in what keeps cells of reduced integration in shape.")
      .def_readonly("impact", &EnergyLedger::impact, "Taken by contact pressures and not stored.")
      .def_readonly("numerical", &EnergyLedger::numerical, "Dissipated by the time scheme; < 0 gained.")
      .def_readonly("bulk_scheme", &EnergyLedger::bulk_scheme,
                    "Of finite strain: neither stored nor dissipated by the bodies; < 0 gained.")
      .def_readonly("rounding", &EnergyLedger::rounding,
                    "What the rounding of forces may have put into all of these.")
      .def_readonly("unbalanced", &EnergyLedger::unbalanced, "Work of what iterations left unbalanced.")
      .def_readonly("start", &EnergyLedger::start, "Stored when the run began.")
      .def_property_readonly("stored", &EnergyLedger::stored,
                             "kinetic + strain + contact + back_stress + hourglass.")
      .def_property_readonly("balance", &EnergyLedger::balance, "What the ledger has no entry for: rounding.")
      .def("as_dict", &energy_dict, "The columns of energy.csv.")
      .def("__repr__", [](const EnergyLedger& energy) {
        return fmt::format("<rubato.EnergyLedger: kinetic {:g}, strain {:g}, balance {:g}>", energy.kinetic,
                           energy.strain, energy.balance());
      });
}

void bind_values(py::module_& module) {
  using simulation::Counters;
  py::class_<Attempt>(module, "Attempt", "One attempt at a step.")
      .def_readonly("begin", &Attempt::begin, "[time]")
      .def_readonly("end", &Attempt::end, "[time]")
      .def_readonly("cut_level", &Attempt::cut_level, "How often the step was cut.")
      .def_readonly("accepted", &Attempt::accepted, "Whether it counts.")
      .def_readonly("seconds", &Attempt::seconds, "Processor time.")
      .def_readonly("steps", &Attempt::steps, "Made in it: 1 or 0; explicit: all up to the record.")
      .def("__repr__", [](const Attempt& attempt) {
        return fmt::format("<rubato.Attempt: {:g} to {:g}>", attempt.begin, attempt.end);
      });
  py::class_<Counters>(module, "Counters", "What a simulation has spent since its beginning.")
      .def_readonly("steps", &Counters::steps, "Accepted; explicit: made.")
      .def_readonly("iterations", &Counters::iterations,
                    "Linear solves, those of rejected attempts included.")
      .def_readonly("cuts", &Counters::cuts, "Of steps.")
      .def("__eq__", [](const Counters& a, const Counters& b) { return a == b; })
      .def("__repr__", [](const Counters& counters) {
        return fmt::format("<rubato.Counters: {} steps, {} iterations, {} cuts>", counters.steps,
                           counters.iterations, counters.cuts);
      });
  py::class_<Memento, std::shared_ptr<Memento>>(
      module, "Memento",
      "All that steps change: a simulation of the same model that is given it "
      "goes on to the same bits.")
      .def_property_readonly(
          "t", [](const Memento& memento) { return memento.state.t; }, "Instant [time].")
      .def_readonly("counters", &Memento::counters, "What was spent until then.");
}

std::string verdict_word(simulation::Verdict verdict) {
  using simulation::Verdict;
  switch (verdict) {
  case Verdict::accepted:
    return "accepted";
  case Verdict::cut:
    return "cut";
  case Verdict::not_converged:
    return "not_converged";
  case Verdict::interrupted:
    break;
  }
  return "interrupted";
}

void bind_steps(py::module_& module) {
  py::class_<Told, std::shared_ptr<Told>>(module, "Told",
                                          "An attempt that observers are told of, before it counts.")
      .def_readonly("attempt", &Told::attempt, "When, and how deep it is cut.")
      .def_readonly("iterations", &Told::iterations, "Linear solves.")
      .def_readonly("last", &Told::last,
                    "Accepted: whether it ends at the last instant. Rejected: whether no cut is left.")
      .def_readonly("report", &Told::report,
                    "Rejected: which criterion is not met, by how much and where; else empty.")
      .def_property_readonly(
          "energy", [](const Told& told) { return told.energy; }, "Accepted: with this step; rejected: None.")
      .def_property_readonly(
          "before", [](const Told& told) { return told.before; }, "State where the attempt began.")
      .def_property_readonly("now", &Told::now,
                             "State where it ended, a copy; can be asked for while the observer is told.");
  py::class_<Step>(module, "Step", "How an attempt ended.")
      .def_property_readonly(
          "accepted", [](const Step& step) { return step.result.accepted(); }, "Whether it counts.")
      .def_property_readonly(
          "verdict", [](const Step& step) { return verdict_word(step.result.verdict); },
          "\"accepted\", \"cut\" (attempt() only), \"not_converged\" or \"interrupted\".")
      .def_property_readonly(
          "attempt", [](const Step& step) { return step.result.attempt; }, "When it was made.")
      .def_property_readonly(
          "iterations", [](const Step& step) { return step.result.report.iterations; }, "Linear solves.")
      .def_property_readonly(
          "residual", [](const Step& step) { return step.result.report.residual; },
          "Relative, of the last iterate.")
      .def_property_readonly(
          "bulk_iterations", [](const Step& step) { return step.result.report.bulk_iterations; },
          "Motions from which nonlinear bodies were solved for; 0 of linear ones.")
      .def_property_readonly(
          "factorisations", [](const Step& step) { return step.result.report.factorisations; },
          "Effective matrices of nonlinear bodies that were factored; 0 of linear ones.")
      .def_property_readonly(
          "bulk_residuals", [](const Step& step) { return step.result.report.bulk_residuals; },
          "Of nonlinear bodies: the largest unbalanced force at the start and at each of these motions "
          "[force].")
      .def_property_readonly(
          "indefinite", [](const Step& step) { return step.result.report.indefinite; },
          "Whether one of them was not positive definite.")
      .def_property_readonly(
          "exact_tangent", [](const Step& step) { return step.result.report.exact_tangent; },
          "Whether the scheme energy_momentum needed the exact tangent of its forces.")
      .def_property_readonly(
          "energy", [](const Step& step) { return step.result.energy; },
          "Of the state that the simulation has after it.")
      .def_readonly(
          "report", &Step::report,
          "Which criterion is not met, by how much and where, and what may help; empty when accepted.")
      .def("__repr__", [](const Step& step) {
        return fmt::format("<rubato.Step: {} at t = {:g}>", verdict_word(step.result.verdict),
                           step.result.attempt.end);
      });
  py::class_<Where>(module, "Where", "Where an attempt stands that is being made.")
      .def_readonly("attempt", &Where::attempt, "Which one.")
      .def_readonly("iterations", &Where::iterations, "Linear solves so far.")
      .def_readonly("contact_points", &Where::contact_points, "In contact.")
      .def_readonly("residual", &Where::residual, "Relative; not a number where it is not known yet.");
}

constexpr const char* advance_doc = R"(One accepted step: attempts until one is accepted or no cut is left.

callback(where) is called at least once an iteration, explicit every few steps; when it returns False the attempt ends
as interrupted. What it raises ends the attempt, too, and is raised here. So is KeyboardInterrupt. An implicit attempt
that ended so leaves nothing; an explicit one that the callback ended keeps what it has come towards the record.
Other threads of Python run meanwhile. Raises RuntimeError when finished, InputError, and what observers raise.)";

void bind_class(py::module_& module) {
  py::class_<Running> type(
      module, "Simulation", py::custom_type_setup(&Running::set_up_type),
      "Time integration of a study or a model. A for loop over it makes its accepted steps, and "
      "raises StepError when no cut is left.");
  type.def(py::init(&Running::make), py::arg("study"), py::arg("previous") = py::none(),
           py::arg("memento") = py::none(), py::arg("threads") = 1,
           "study: Study or Model. previous: the State that a study with start \"from_run\" begins with. "
           "memento: to go "
           "on from, instead of the begin. threads: of a study; a Model has its own. Raises InputError.")
      .def(
          "advance",
          [](Running& running, const py::object& callback) { return running.step(callback, true); },
          py::arg("callback") = py::none(), advance_doc)
      .def(
          "attempt",
          [](Running& running, const py::object& callback) { return running.step(callback, false); },
          py::arg("callback") = py::none(),
          "One attempt: for who wants to act between cuts. Else as advance().")
      .def("observe", &Running::observe, py::arg("accepted") = py::none(), py::arg("rejected") = py::none(),
           py::arg("take_back") = py::none(),
           "Functions that are told of each attempt from now on, while the simulation still stands where it "
           "began. When "
           "one raises, take_back(state) of all that were told is called, the simulation stays as it was and "
           "the "
           "exception is raised by advance().")
      .def("memento", &Running::memento, "All that steps change, without observers.")
      .def("restore", &Running::restore, py::arg("memento"),
           "Goes back, or on, to what a simulation of the same model had. Raises InputError for another one.")
      .def_property_readonly(
          "finished", [](Running& running) { return running.read().finished(); },
          "Whether the last instant is reached.")
      .def_property_readonly(
          "t", [](Running& running) { return running.read().state().t; },
          "Instant after the last accepted step [time].")
      .def_property_readonly(
          "end", [](Running& running) { return running.read().end(); }, "The last instant [time].")
      .def_property_readonly("state", &Running::state, "State after the last accepted step, without a copy.")
      .def_property_readonly(
          "energy", [](Running& running) { return running.read().energy(); }, "Of that state.")
      .def_property_readonly(
          "counters", [](Running& running) { return running.read().counters(); }, "Steps, iterations, cuts.")
      .def_property_readonly("next", &Running::next, "The Attempt that comes next; None when finished.")
      .def_property_readonly(
          "method", [](Running& running) { return running.read().method(); }, "How steps are made, and why.")
      .def_property_readonly(
          "model", [](Running& running) { return running.model(); }, "Model")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &Running::next_accepted)
      .def("__repr__", [](Running& running) {
        const auto& simulation = running.read();
        return fmt::format("<rubato.Simulation: t = {:g} of {:g}>", simulation.state().t, simulation.end());
      });
}

} // namespace

void bind_simulation(py::module_& module) {
  bind_energy(module);
  bind_values(module);
  bind_steps(module);
  bind_class(module);
}

} // namespace rubato::python
