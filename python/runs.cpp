// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs with a folder of results.
#include "rubato/results/checks.hpp"
#include "rubato/run/run_study.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "model_class.hpp"
#include "values.hpp"
#include <chrono>
#include <exception>
#include <filesystem>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rubato::python {
namespace {

using results::CheckResult;
using run::Progress;
using run::RunResult;

/// What Python is told of a run, which is made without the interpreter's lock. What a function raises ends
/// the run as Ctrl-C does, and is raised when the run is over: its folder is that of an interrupted one.
class Listener {
public:
  Listener(py::object progress, py::object say, py::object warn)
      : progress_(std::move(progress)), say_(std::move(say)), warn_(std::move(warn)) {}

  run::Watch watch() {
    run::Watch watch;
    watch.progress = [this](const Progress& progress) { tell(progress_, progress); };
    watch.say = [this](const std::string& sentence) { tell(say_, sentence); };
    watch.warn = [this](const std::string& sentence) { tell(warn_, sentence); };
    watch.stop = [this] { return stops(); };
    return watch;
  }
  void raise_what_came() const {
    if (raised_)
      std::rethrow_exception(raised_);
  }

private:
  template <class Text> void tell(const py::object& function, const Text& text) {
    if (function.is_none() || raised_)
      return;
    const py::gil_scoped_acquire lock;
    try {
      function(text);
    } catch (...) {
      raised_ = std::current_exception();
    }
  }
  bool stops() {
    if (raised_)
      return true;
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ < patience)
      return false;
    looked_ = now;
    const py::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
    } catch (...) {
      raised_ = std::current_exception();
    }
    return raised_ != nullptr;
  }

  /// Between two looks for Ctrl-C.
  static constexpr std::chrono::milliseconds patience{20};

  py::object progress_;
  py::object say_;
  py::object warn_;
  std::exception_ptr raised_;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

/// What Python says of a run, beside its study and its folder.
struct Wishes {
  std::optional<mesh::Mesh> mesh;
  const step::State* previous = nullptr;
  run::Begin begin = run::Begin::anew;
  Threads threads;
};

/// Without the interpreter's lock.
RunResult run_as(const study::Study& study, const std::filesystem::path& folder, const run::Watch& watch,
                 Wishes wishes) {
  if (!wishes.mesh)
    return run::run_study(study, folder, watch, wishes.previous, wishes.begin, wishes.threads);
  return run::run_study(on_given_mesh(study), as_run(std::move(*wishes.mesh), study.mesh), folder, watch,
                        wishes.previous, wishes.begin, wishes.threads);
}

RunResult run_study(const py::object& record, const std::filesystem::path& folder, const py::object& progress,
                    bool resume, const step::State* previous, const mesh::Mesh* mesh, const py::object& say,
                    const py::object& warn, int threads) {
  const auto study = Codec<study::Study>::from(record, "");
  Listener listener(progress, say, warn);
  RunResult result;
  {
    const py::gil_scoped_release unlocked;
    Wishes wishes{{}, previous, resume ? run::Begin::resumed : run::Begin::anew, Threads(threads)};
    if (mesh != nullptr)
      wishes.mesh = *mesh;
    result = run_as(study, folder, listener.watch(), std::move(wishes));
  }
  listener.raise_what_came();
  return result;
}

void bind_progress(py::module_& module) {
  py::class_<Progress>(module, "Progress", "What a run tells after each attempt at a step.")
      .def_property_readonly(
          "run", [](const Progress& progress) { return std::string(progress.run); }, "Its name.")
      .def_readonly("t", &Progress::t, "Instant that is reached, or was to be [time].")
      .def_readonly("begin", &Progress::begin, "Of the run [time].")
      .def_readonly("end", &Progress::end, "Of the run [time].")
      .def_readonly("step", &Progress::step, "Length of the step [time].")
      .def_readonly("iterations", &Progress::iterations, "Linear solves of the attempt.")
      .def_readonly("contact_points", &Progress::contact_points, "In contact.")
      .def_readonly("cut_level", &Progress::cut_level, "How often the step is cut.")
      .def_readonly("accepted", &Progress::accepted, "Whether the attempt counts.");
}

void bind_results(py::module_& module) {
  py::class_<CheckResult>(module, "CheckResult", "A value of a run held against a reference.")
      .def_readonly("quantity", &CheckResult::quantity, "\"tip.y\"")
      .def_readonly("over", &CheckResult::over,
                    "\"max\" and the like of the whole history; empty at an instant.")
      .def_readonly("at", &CheckResult::at, "Instant [time].")
      .def_readonly("reference", &CheckResult::reference, "What must come out.")
      .def_readonly("value", &CheckResult::value, "What came out; None when there is none.")
      .def_readonly("deviation", &CheckResult::deviation, "From the reference, relative or absolute.")
      .def_readonly("tolerance", &CheckResult::tolerance, "Of the deviation.")
      .def_readonly("relative", &CheckResult::relative, "Whether the deviation is.")
      .def_readonly("holds", &CheckResult::holds, "Whether the deviation is within the tolerance.")
      .def_readonly("source", &CheckResult::source, "Of the reference.")
      .def_readonly("failure", &CheckResult::failure, "Why there is no value.")
      .def_readonly("note", &CheckResult::note, "Where the reference comes from.")
      .def("__repr__", [](const CheckResult& check) {
        return fmt::format("<rubato.CheckResult: {} {}>", check.quantity, check.holds ? "holds" : "fails");
      });
  py::class_<RunResult>(module, "RunResult", "How a run ended.")
      .def_property_readonly(
          "status", [](const RunResult& result) { return std::string(results::to_string(result.status)); },
          "\"complete\", \"not_converged\" or \"interrupted\".")
      .def_readonly("message", &RunResult::message, "Why it is not complete.")
      .def_readonly("steps", &RunResult::steps, "Accepted.")
      .def_readonly("iterations", &RunResult::iterations, "Linear solves.")
      .def_readonly("cuts", &RunResult::cuts, "Of steps.")
      .def_readonly("kept", &RunResult::kept, "Whether there is a checkpoint to resume from.")
      .def_readonly("setup_seconds", &RunResult::setup_seconds, "Processor time before the first step.")
      .def_readonly("loop_seconds", &RunResult::loop_seconds, "Processor time of the steps, of all threads.")
      .def_readonly("elapsed_seconds", &RunResult::elapsed_seconds,
                    "Of this process on the run, by the clock.")
      .def_readonly("checks", &RunResult::checks, "A CheckResult each of the study's checks.")
      .def_property_readonly("checks_hold", &RunResult::checks_hold, "Whether all do.")
      .def_property_readonly(
          "plausibility",
          [](const RunResult& result) {
            return py::module_::import("json").attr("loads")(
                result.plausibility.empty() ? "[]" : results::plausibility_text(result.plausibility));
          },
          "The checks of the run itself, a dict each, as run.json has them (docs/guide/results.md).")
      .def_property_readonly(
          "state", [](const RunResult& result) { return std::make_shared<step::State>(result.end); },
          "The last accepted one: a copy.")
      .def("__repr__", [](const RunResult& result) {
        return fmt::format("<rubato.RunResult: {}, {} steps>", results::to_string(result.status),
                           result.steps);
      });
}

} // namespace

void bind_runs(py::module_& module) {
  bind_progress(module);
  bind_results(module);
  module.def("run", &run_study, py::arg("study"), py::arg("folder"), py::arg("progress") = py::none(),
             py::arg("resume") = false, py::arg("previous") = py::none(), py::arg("mesh") = py::none(),
             py::arg("say") = py::none(), py::arg("warn") = py::none(), py::arg("threads") = 1,
             R"(Runs a study into a folder of its own, as the program does: open_run() reads it.

progress(Progress) is called after each attempt at a step; say(sentence) and warn(sentence) get what the program
prints. resume: go on from the checkpoint in the folder. previous: the State that a study with start "from_run" begins
with. mesh: instead of the one that the study names, as of Model. threads: that the run may use. What the functions raise ends the run as Ctrl-C does
and is raised here, with a folder that can be resumed.
Raises InputError, before the folder is made or touched, for a study that cannot be run, and OSError.)");
}

} // namespace rubato::python
