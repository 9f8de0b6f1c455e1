// SPDX-License-Identifier: LGPL-3.0-or-later
#include "study.hpp"

#include "rubato/core/processor_time.hpp"
#include "rubato/linalg/direct_solver.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/full/linear_step.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "../sdnl140.hpp"
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <unistd.h>

namespace rubato::bench {
namespace {

/// C cut into smaller cells, the step in proportion.
Study refined(int refine, int full_steps) {
  return {.name = fmt::format("c-refined-{}", refine),
          .title = fmt::format("C refined {}", refine),
          .deck = "c.yaml",
          .refine = refine,
          .step = 1e-3 / refine,
          .end = 12e-3,
          .full_steps = full_steps,
          .quick = refine == 2,
          .fitted = true};
}

/// The same at the step of the coarse mesh.
Study refined_only(int refine, int full_steps) {
  auto study = refined(refine, full_steps);
  study.name += "-coarse-steps";
  study.title += ", h = 1e-3";
  study.step = 1e-3;
  study.quick = false;
  study.fitted = false;
  return study;
}

/// A folder that goes with the run.
class ScratchFolder {
public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() / fmt::format("rubato_bench_{}", getpid())) {}
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// What a run leaves for the table.
struct Timing {
  run::RunResult result;
  std::vector<double> steps; ///< [s]
  double active = 0;         ///< mean
};

/// Runs the first `most` steps, or all.
Timing run_steps(const study::Study& study, int most = 0) {
  Timing timing;
  const ScratchFolder folder;
  run::Watch watch;
  double before = 0;
  watch.say = [&](const std::string&) { before = processor_seconds(); };
  watch.stop = [&] {
    if (timing.steps.empty())
      before = processor_seconds();
    return most > 0 && static_cast<int>(timing.steps.size()) >= most;
  };
  watch.progress = [&](const run::Progress& progress) {
    const double now = processor_seconds();
    timing.steps.push_back(now - before);
    timing.active += progress.contact_points;
    before = now;
  };
  timing.result = run::run_study(study, folder.path(), watch);
  timing.active /= static_cast<double>(timing.steps.size());
  const auto status = timing.result.status;
  if (status != run::Status::complete && !(most > 0 && status == run::Status::interrupted))
    throw std::runtime_error(timing.result.message);
  return timing;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Of this process so far [bytes].
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      double kibibytes = 0;
      status >> kibibytes;
      return 1024 * kibibytes;
    }
  return 0;
}

/// [s] of one call, of as many as a fair figure needs.
template <class Call> double time_of(const Call& call) {
  constexpr double enough = 0.2;
  constexpr int fewest = 5;
  call();
  const double start = processor_seconds();
  int count = 0;
  while (count < fewest || processor_seconds() - start < enough) {
    call();
    ++count;
  }
  return (processor_seconds() - start) / count;
}

/// Forward and backward.
double time_solves(const linalg::SparseMatrix& matrix) {
  const auto factor = linalg::CholeskyFactor::of(matrix);
  if (!factor)
    throw std::runtime_error("the effective matrix is not positive definite");
  const Eigen::VectorXd force = Eigen::VectorXd::Ones(matrix.rows());
  Eigen::VectorXd x;
  return time_of([&] { x = factor->solve(force); });
}

/// Down to the surface, and back from it with forces there.
double time_halves(const step::Compliance& bulk, Eigen::Index size) {
  const Eigen::VectorXd force = Eigen::VectorXd::Ones(size);
  const Eigen::VectorXd touched = Eigen::VectorXd::Ones(bulk.size());
  Eigen::VectorXd x, half_way;
  return time_of([&] {
    half_way = bulk.forward(force);
    x = bulk.surface_of(half_way);
    bulk.load_surface(touched, half_way);
    x = bulk.backward(half_way);
  });
}

/// What takes the model itself.
void measure_model(study::Study study, Measurement& found) {
  const auto scheme = time::make_scheme(study.time);
  study.solver = study::Solver::full; // one factor at a time
  auto model = model::build_model(study);
  found.dofs = static_cast<int>(model.reduction.unknown_count());
  found.contact_dofs = static_cast<int>(step::surface_unknowns(model).size());
  found.solve = time_solves(step::make_effective_system(model, scheme, study.time.step).matrix);
  model.study.solver = study::Solver::condensed;
  const auto system = step::make_effective_system(model, scheme, study.time.step);
  found.halves = time_halves(*system.compliance, system.matrix.rows());
}

} // namespace

std::span<const Study> studies() {
  static const std::array all{
      Study{.name = "f", .title = "F", .deck = "f.yaml", .end = 0.15, .full_steps = 150, .quick = true},
      Study{.name = "f-fine-steps",
            .title = "F, h = 1e-5",
            .deck = "f.yaml",
            .step = 1e-5,
            .end = 0.015,
            .full_steps = 150},
      Study{.name = "c", .title = "C", .deck = "c.yaml", .end = 0.15, .full_steps = 150, .quick = true},
      Study{.name = "c-fine-steps",
            .title = "C, h = 1e-5",
            .deck = "c.yaml",
            .step = 1e-5,
            .end = 0.015,
            .full_steps = 150},
      refined(2, 24),
      refined(4, 4),
      refined(8, 1),
      refined(12, 0),
      refined_only(2, 12),
      refined_only(4, 4),
      refined_only(8, 0)};
  return all;
}

Measurement measure(const Study& study) {
  auto deck = sdnl140(study.deck, study.refine, study.step, study.end);
  Measurement found{.title = study.title, .fitted = study.fitted};
  {
    const auto timing = run_steps(deck);
    found.steps = timing.result.steps;
    found.active = timing.active;
    found.iterations = static_cast<double>(timing.result.iterations) / found.steps;
    found.setup = timing.result.setup_seconds;
    found.step = timing.result.loop_seconds / found.steps;
    found.middle_step = median(timing.steps);
  }
  found.memory = peak_memory();
  measure_model(deck, found);
  if (study.full_steps > 0) {
    deck.solver = study::Solver::full;
    const auto timing = run_steps(deck, study.full_steps);
    found.full_steps = timing.result.steps;
    found.full_step = timing.result.loop_seconds / found.full_steps;
  }
  return found;
}

std::string to_json(const Measurement& m) {
  return nlohmann::json{{"title", m.title},
                        {"fitted", m.fitted},
                        {"dofs", m.dofs},
                        {"contact_dofs", m.contact_dofs},
                        {"steps", m.steps},
                        {"active", m.active},
                        {"iterations", m.iterations},
                        {"setup", m.setup},
                        {"step", m.step},
                        {"middle_step", m.middle_step},
                        {"solve", m.solve},
                        {"halves", m.halves},
                        {"memory", m.memory},
                        {"full_step", m.full_step},
                        {"full_steps", m.full_steps}}
      .dump();
}

Measurement from_json(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  return {.title = json.at("title"),
          .fitted = json.at("fitted"),
          .dofs = json.at("dofs"),
          .contact_dofs = json.at("contact_dofs"),
          .steps = json.at("steps"),
          .active = json.at("active"),
          .iterations = json.at("iterations"),
          .setup = json.at("setup"),
          .step = json.at("step"),
          .middle_step = json.at("middle_step"),
          .solve = json.at("solve"),
          .halves = json.at("halves"),
          .memory = json.at("memory"),
          .full_step = json.at("full_step"),
          .full_steps = json.at("full_steps")};
}

} // namespace rubato::bench
