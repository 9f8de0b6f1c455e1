// SPDX-License-Identifier: LGPL-3.0-or-later
#include "running.hpp"

#include "rubato/model/model.hpp"
#include "rubato/run/failure.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

namespace rubato::python {

using simulation::Simulation;

namespace {

/// Between two looks for Ctrl-C while a step is made.
constexpr std::chrono::milliseconds patience(20);

/// What is asked inside an attempt: the callback if there is one, now and then whether a signal has come.
class Asked {
public:
  explicit Asked(const py::object& callback) : callback_(callback) {}

  bool operator()(const simulation::Moment& moment) {
    const auto now = std::chrono::steady_clock::now();
    const bool looks = now - looked_ >= patience;
    if (callback_.is_none() && !looks)
      return true;
    const py::gil_scoped_acquire lock;
    looked_ = now;
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
    if (callback_.is_none())
      return true;
    const auto answer = callback_(Where{moment.attempt, moment.progress.iterations,
                                        moment.progress.contact_points, moment.progress.residual});
    return !answer.is(py::bool_(false));
  }

private:
  const py::object& callback_; // the caller's, who holds it
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

Running& running_of(PyObject* self) {
  return py::cast<Running&>(py::handle(self));
}

/// Whether the constructor has made it; an object may be visited before.
bool is_made(PyObject* self) {
  return reinterpret_cast<py::detail::instance*>(self)->get_value_and_holder().holder_constructed();
}

} // namespace

/// A thread advances the simulation. Made and ended with the interpreter's lock.
class Running::Turn {
public:
  explicit Turn(Running& running) : running_(running) {
    if (running.stepped_by_ != 0)
      throw std::runtime_error(
          "the simulation is being advanced, expected to be asked for another step after that");
    running.stepped_by_ = PyThread_get_thread_ident();
  }
  ~Turn() { running_.stepped_by_ = 0; }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

private:
  Running& running_;
};

SharedState Told::now() const {
  if (reached == nullptr)
    throw std::runtime_error("the state is no more: it can be asked for while the observer is told");
  return std::make_shared<step::State>(*reached);
}

Running::Running(SharedModel model, const simulation::Start& start)
    : model_(std::move(model)), simulation_(*model_, start) {
  simulation_.observe({.rejected = [this](const simulation::RejectedStep& step) {
    report_ = run::explain(*model_, run::failure_of(*model_, step));
  }});
}

std::unique_ptr<Running> Running::make(const py::object& study, const step::State* previous,
                                       const simulation::Memento* memento, int threads) {
  auto model = py::isinstance<model::Model>(study) ? study.cast<SharedModel>()
                                                   : make_model(study, std::nullopt, threads);
  const py::gil_scoped_release unlocked;
  return std::unique_ptr<Running>(new Running(std::move(model), {.previous = previous, .memento = memento}));
}

Step Running::step(const py::object& callback, bool whole) {
  const Turn turn(*this);
  Asked asked(callback);
  const auto goes_on = [&](const simulation::Moment& moment) { return asked(moment); };
  Step step;
  {
    const py::gil_scoped_release unlocked;
    step.result = whole ? simulation_.advance(goes_on) : simulation_.attempt(goes_on);
  }
  if (step.result.report.failed())
    step.report = std::exchange(report_, {});
  return step;
}

Step Running::next_accepted() {
  if (read().finished())
    throw py::stop_iteration();
  auto step = this->step(py::none(), true);
  if (!step.result.accepted()) {
    const auto type = py::module_::import("rubato._errors").attr("StepError");
    PyErr_SetObject(type.ptr(), type(step.report, py::cast(step)).ptr());
    throw py::error_already_set();
  }
  return step;
}

void Running::tell_accepted(const Functions& functions, const simulation::AcceptedStep& step) const {
  const py::gil_scoped_acquire lock;
  if (functions.accepted.is_none())
    return;
  auto told = std::make_shared<Told>(Told{step.attempt, step.report.iterations, step.last, "", step.energy,
                                          std::const_pointer_cast<step::State>(simulation_.shared_state()),
                                          &step.now});
  const py::object shown = py::cast(told);
  struct End {
    Told& told;
    ~End() { told.reached = nullptr; }
  } const end{*told};
  functions.accepted(shown);
}

void Running::tell_rejected(const Functions& functions, const simulation::RejectedStep& step) const {
  const py::gil_scoped_acquire lock;
  if (functions.rejected.is_none())
    return;
  auto told = std::make_shared<Told>(
      Told{step.attempt, step.report.iterations, step.final, report_, std::nullopt,
           std::const_pointer_cast<step::State>(simulation_.shared_state()), &step.reached});
  const py::object shown = py::cast(told);
  struct End {
    Told& told;
    ~End() { told.reached = nullptr; }
  } const end{*told};
  functions.rejected(shown);
}

void Running::observe(const py::object& accepted, const py::object& rejected, const py::object& take_back) {
  const Turn turn(*this);
  observers_.push_back(std::make_shared<Functions>(Functions{accepted, rejected, take_back}));
  const auto* functions = observers_.back().get();
  simulation_.observe(
      {.accepted = [this,
                    functions](const simulation::AcceptedStep& step) { tell_accepted(*functions, step); },
       .rejected = [this,
                    functions](const simulation::RejectedStep& step) { tell_rejected(*functions, step); },
       .take_back =
           [this, functions](const step::State&) {
             const py::gil_scoped_acquire lock;
             if (functions->take_back.is_none())
               return;
             try {
               functions->take_back(std::const_pointer_cast<step::State>(simulation_.shared_state()));
             } catch (py::error_already_set& error) {
               error.discard_as_unraisable("take_back of an observer");
             }
           }});
}

void Running::restore(const simulation::Memento& memento) {
  const Turn turn(*this);
  const py::gil_scoped_release unlocked;
  simulation_.restore(memento);
}

std::shared_ptr<simulation::Memento> Running::memento() {
  return std::make_shared<simulation::Memento>(read().memento());
}

const Simulation& Running::read() const {
  if (stepped_by_ != 0 && stepped_by_ != PyThread_get_thread_ident())
    throw std::runtime_error("the simulation is being advanced by another thread");
  return simulation_;
}

std::optional<simulation::Attempt> Running::next() const {
  return read().finished() ? std::nullopt : std::optional(read().next());
}

void Running::set_up_type(PyHeapTypeObject* type) {
  auto& slots = type->ht_type;
  slots.tp_flags |= Py_TPFLAGS_HAVE_GC;
  slots.tp_traverse = [](PyObject* self, visitproc visit, void* arg) -> int {
    Py_VISIT(Py_TYPE(self));
    if (!is_made(self))
      return 0;
    for (const auto& functions : running_of(self).observers_) {
      Py_VISIT(functions->accepted.ptr());
      Py_VISIT(functions->rejected.ptr());
      Py_VISIT(functions->take_back.ptr());
    }
    return 0;
  };
  slots.tp_clear = [](PyObject* self) -> int {
    if (is_made(self))
      for (const auto& functions : running_of(self).observers_)
        *functions = {py::none(), py::none(), py::none()};
    return 0;
  };
}

} // namespace rubato::python
