// SPDX-License-Identifier: LGPL-3.0-or-later
/// A simulation that Python holds: it is advanced without the interpreter's lock, by one thread at a time.
#pragma once

#include "rubato/simulation/time_integration.hpp"

#include "model_class.hpp"
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace rubato::python {

namespace py = pybind11;

/// How an attempt ended.
struct Step {
  simulation::StepResult result;
  std::string report; ///< why it was not accepted
};

/// Where an attempt stands.
struct Where {
  simulation::Attempt attempt;
  int iterations = 0;
  int contact_points = 0;
  double residual = 0;
};

/// What observers of Python are told.
struct Told {
  simulation::Attempt attempt;
  int iterations = 0;
  bool last = false;
  std::string report;
  std::optional<step::EnergyLedger> energy;
  SharedState before;
  const step::State* reached = nullptr; ///< while it is told

  SharedState now() const;
};

class Running {
public:
  static std::unique_ptr<Running> make(const py::object& study, const step::State* previous,
                                       const simulation::Memento* memento, int threads);
  /// Python's collector is told of the functions of observers, which may refer to the simulation.
  static void set_up_type(PyHeapTypeObject* type);

  /// An accepted step, or an attempt. Throws what a callback or an observer raises.
  Step step(const py::object& callback, bool whole);
  /// Throws StopIteration when finished, StepError when the step is not accepted.
  Step next_accepted();
  void observe(const py::object& accepted, const py::object& rejected, const py::object& take_back);
  void restore(const simulation::Memento& memento);
  std::shared_ptr<simulation::Memento> memento();

  /// To look at. Throws RuntimeError while another thread advances it.
  const simulation::Simulation& read() const;
  SharedState state() const { return std::const_pointer_cast<step::State>(read().shared_state()); }
  std::optional<simulation::Attempt> next() const;
  const SharedModel& model() const { return model_; }

private:
  struct Functions {
    py::object accepted;
    py::object rejected;
    py::object take_back;
  };
  class Turn;

  Running(SharedModel model, const simulation::Start& start);
  void tell_accepted(const Functions& functions, const simulation::AcceptedStep& step) const;
  void tell_rejected(const Functions& functions, const simulation::RejectedStep& step) const;

  SharedModel model_;
  simulation::Simulation simulation_;
  std::vector<std::shared_ptr<Functions>> observers_;
  std::string report_; ///< of the last attempt that was rejected
  /// The thread that advances it, 0: none. Read and written with the interpreter's lock held.
  unsigned long stepped_by_ = 0;
};

} // namespace rubato::python
