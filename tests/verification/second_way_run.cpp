// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>

#include "support/scratch_folder.hpp"
#include "verification/second_way.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::verification {
namespace {

/// Attempts and iterations that a run may have for each of its steps, on average.
constexpr int most_attempts = 10, most_iterations = 300;

using Place = std::array<double, 2>;

/// How far the bottom rises at the part a of the width.
double rise_of(const Forming& forming, double a) {
  const double width = forming.to[0] - forming.from[0];
  switch (forming.form) {
  case Form::ski:
    return forming.amount * width * std::max(0., a - 2. / 3);
  case Form::wedge:
    return forming.amount * width * (std::max(0., a - 0.5) + 0.5 * std::max(0., 0.5 - a));
  case Form::crown:
    return forming.amount * std::pow(2 * a - 1, 2);
  default:
    return 0;
  }
}

Place rounded_place(const Forming& forming, double a, double b) {
  const double x = 2 * a - 1, y = 2 * b - 1;
  const double disc_x = x * std::sqrt(1 - y * y / 2), disc_y = y * std::sqrt(1 - x * x / 2);
  const auto at = [&](std::size_t axis, double part) {
    return 0.5 * (forming.from[axis] + forming.to[axis]) +
           0.5 * (forming.to[axis] - forming.from[axis]) * part;
  };
  return {at(0, x + forming.amount * (disc_x - x)), at(1, y + forming.amount * (disc_y - y))};
}

Place formed_place(const Forming& forming, double x, double y) {
  const double width = forming.to[0] - forming.from[0], height = forming.to[1] - forming.from[1];
  const double a = (x - forming.from[0]) / width, b = (y - forming.from[1]) / height;
  switch (forming.form) {
  case Form::tilt:
    return {x * std::cos(forming.amount) - y * std::sin(forming.amount),
            x * std::sin(forming.amount) + y * std::cos(forming.amount)};
  case Form::crown_top:
    return {x, y - b * forming.amount * std::pow(2 * a - 1, 2)};
  case Form::slant:
    return {x + forming.amount * a * b * height, y};
  case Form::slant_back:
    return {x + forming.amount * (1 - a) * b * height, y};
  case Form::polar:
    return {y * std::cos(x / forming.amount), -y * std::sin(x / forming.amount)};
  case Form::rounded:
    return rounded_place(forming, a, b);
  default:
    return {x, y + (1 - b) * rise_of(forming, a)};
  }
}

/// The columns of a table whose values are means over steps are so by the default scheme.
struct History {
  std::vector<double> times;
  std::vector<double> values;
  bool of_steps = false; ///< values are means over the steps
};

double value_between(const History& history, std::size_t i, double t) {
  if (history.of_steps)
    return history.values[i];
  const double begin = history.times[i - 1], end = history.times[i];
  return history.values[i - 1] + (history.values[i] - history.values[i - 1]) * (t - begin) / (end - begin);
}

double mean_over(const History& history, double begin, double end) {
  double sum = 0;
  for (std::size_t i = 1; i < history.times.size(); ++i) {
    const double from = std::max(begin, history.times[i - 1]), to = std::min(end, history.times[i]);
    if (to > from)
      sum += 0.5 * (to - from) * (value_between(history, i, from) + value_between(history, i, to));
  }
  return sum / (end - begin);
}

Quantity quantity_of(std::string name, const History& history, double sign) {
  Quantity quantity{std::move(name), {}};
  const double end = history.times.back();
  for (std::size_t q = 0; q < quantity.mean.size(); ++q)
    quantity.mean[q] =
        sign * mean_over(history, end * static_cast<double>(q) / 4, end * static_cast<double>(q + 1) / 4);
  return quantity;
}

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values)
    largest = std::max(largest, std::abs(value));
  return largest;
}

struct Tables {
  results::Table probes, energy;
};

void add_column(const results::Table& table, const std::string& name, bool of_steps, double sign,
                QuantityKind& kind) {
  const auto column = static_cast<std::size_t>(table.column(name));
  History history;
  history.of_steps = of_steps;
  for (const auto& row : table.rows) {
    history.times.push_back(row.front());
    history.values.push_back(row[column]);
  }
  kind.scale = std::max(kind.scale, largest_of(history.values));
  kind.quantities.push_back(quantity_of(name, history, sign));
}

bool is_moment(const std::string& column) {
  return column.substr(column.find('.') + 1).starts_with('m');
}

/// Forces first: moments are measured by force and arm.
std::vector<QuantityKind> measured(const Tables& tables, const WayStudy& study, bool swapped, bool of_steps,
                                   bool is_static) {
  QuantityKind force{"force", 0, {}}, moment{"moment", 0, {}}, energy{"energy", 0, {}},
      displacement{"displacement", 0, {}};
  for (const auto& column : tables.probes.columns) {
    const double sign = swapped && column.starts_with("zone_") ? -1 : 1;
    if (column.starts_with("d_"))
      add_column(tables.probes, column, false, 1, displacement);
    else if (column != "t")
      add_column(tables.probes, column, of_steps, sign, is_moment(column) ? moment : force);
  }
  moment.scale = force.scale * study.arm;
  for (const auto* name :
       {"kinetic", "strain", "external_work", "support_work", "friction", "plastic", "impact"})
    if (is_static || std::string(name) != "impact")
      add_column(tables.energy, name, false, 1, energy);
  energy.scale = std::max(energy.scale, 0.5 * force.scale * displacement.scale);
  return {force, moment, energy, displacement};
}

/// A friction that dissipates less than nothing, over the largest stored or dissipated energy.
double friction_given(const results::Table& energy) {
  double least = 0, largest = 0;
  for (const auto& row : energy.rows) {
    const auto at = [&](const char* name) { return row[static_cast<std::size_t>(energy.column(name))]; };
    least = std::min(least, at("friction"));
    largest =
        std::max({largest, at("kinetic"), at("strain"), std::abs(at("friction")), std::abs(at("impact"))});
  }
  return largest > 0 ? -least / largest : 0;
}

study::Study study_at(const WayStudy& study, const Way& way, int level) {
  auto changes = way.changes;
  const auto step = std::ranges::find(changes, "time.step", &deck::Setting::path);
  const bool automatic = step != changes.end() && step->value == "~";
  const double given = step != changes.end() && !automatic ? std::stod(step->value) : study.step;
  if (!automatic)
    changes.push_back({"time.step", fmt::format("{:.12g}", given / level)});
  changes.push_back({"mesh.refine", std::to_string(level)});
  return deck::parse_deck(study.deck, fmt::format("{}.yaml", study.number), changes).runs.front();
}

} // namespace

void form(mesh::Mesh& mesh, const std::vector<Forming>& forms) {
  for (const auto& forming : forms) {
    const auto nodes = mesh::nodes_named(mesh, forming.body);
    double lowest = INFINITY;
    for (const auto node : nodes) {
      auto& point = mesh.points[static_cast<std::size_t>(node)];
      const auto [x, y] = formed_place(forming, point.x(), point.y());
      point.x() = x;
      point.y() = y;
      lowest = std::min(lowest, y);
    }
    if (forming.form == Form::tilt)
      for (const auto node : nodes)
        mesh.points[static_cast<std::size_t>(node)].y() += forming.from[1] - lowest;
  }
}

WayResult run_way(const WayStudy& way_study, const Way& way, int level) {
  const test::ScratchFolder folder;
  WayResult result;
  try {
    auto study = study_at(way_study, way, level);
    auto mesh = model::load_mesh(study.mesh);
    study.mesh.groups.clear(); // made already
    form(mesh, way_study.forms);
    int attempts = 0, iterations = 0;
    const bool is_explicit = way.name == "explicit";
    const int wanted =
        is_explicit ? 0
                    : static_cast<int>(std::lround((study.time.end - study.time.begin) / study.time.step));
    run::Watch watch;
    watch.progress = [&](const run::Progress&) { ++attempts; };
    watch.within = [&](const run::Progress&) { ++iterations; };
    watch.stop = [&] {
      return !is_explicit && (attempts > most_attempts * wanted || iterations > most_iterations * wanted);
    };
    watch.warn = [&](const std::string& warning) {
      if (warning.find("too stiff in bending") == std::string::npos)
        result.warnings.push_back(warning);
    };
    const auto run = run::run_study(study, std::move(mesh), folder / "run", watch);
    result.seconds = run.setup_seconds + run.loop_seconds;
    if (run.status != run::Status::complete) {
      result.failure = run.status == run::Status::interrupted
                           ? fmt::format("given up after {} attempts and {} iterations", attempts, iterations)
                           : run.message;
      return result;
    }
    result.friction_given = friction_given(results::read_csv(folder / "run/energy.csv"));
    result.kinds =
        measured({results::read_csv(folder / "run/probes.csv"), results::read_csv(folder / "run/energy.csv")},
                 way_study, way.swapped, study.time.scheme == study::SchemeKind::moreau_jean,
                 study.time.scheme == study::SchemeKind::static_steps);
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  return result;
}

} // namespace rubato::verification
