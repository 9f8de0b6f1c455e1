// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/recorder.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/vtu.hpp"
#include "rubato/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace rubato::results {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view axes = "xyz";
constexpr double same_instant = 1e-9;

std::filesystem::path created(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError(
        fmt::format("{}: the folder of results cannot be made ({})", folder.string(), error.message()));
  return folder;
}

mesh::NodeIndex nearest_node(const model::Model& model, const std::array<double, 3>& point) {
  const Eigen::Vector3d x(point[0], point[1], point[2]);
  return *std::ranges::min_element(model.dofs.nodes, {}, [&](mesh::NodeIndex node) {
    return (model.mesh.points[static_cast<std::size_t>(node)] - x).squaredNorm();
  });
}

mesh::NodeIndex node_of(const model::Model& model, const deck::Probe& probe) {
  if (probe.point)
    return nearest_node(model, *probe.point);
  const auto nodes = mesh::nodes_named(model.mesh, probe.node.text);
  if (nodes.empty()) {
    const auto nearest = nearest_word(probe.node.text, mesh::group_names(model.mesh));
    throw InputError(fmt::format("probe '{}': found '{}', expected a node ('N90') or a group of one node{}",
                                 probe.name, probe.node.text,
                                 nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)),
                     probe.node.at);
  }
  if (nodes.size() > 1)
    throw InputError(fmt::format("probe '{}': group '{}' has {} nodes, expected one", probe.name,
                                 probe.node.text, nodes.size()),
                     probe.node.at);
  if (!model.dofs.has(nodes.front()))
    throw InputError(fmt::format("probe '{}': node {} belongs to no cell that deforms", probe.name,
                                 model::node_label(model.mesh, nodes.front())),
                     probe.node.at);
  return nodes.front();
}

const Eigen::VectorXd& field_of(const step::State& state, deck::ProbeField field) {
  switch (field) {
  case deck::ProbeField::displacement:
    return state.motion.u;
  case deck::ProbeField::velocity:
    return state.motion.v;
  case deck::ProbeField::acceleration:
    return state.motion.a;
  case deck::ProbeField::reaction:
    break;
  }
  return state.reaction;
}

ordered_json to_json(const CheckResult& r) {
  ordered_json json{{"quantity", r.quantity},
                    {"at", r.at},
                    {"reference", r.reference},
                    {"value", nullptr},
                    {"deviation", nullptr},
                    {"tolerance", r.tolerance},
                    {"kind", r.relative ? "relative" : "absolute"},
                    {"holds", r.holds},
                    {"source", r.source},
                    {"note", r.note}};
  if (r.value) {
    json["value"] = *r.value;
    json["deviation"] = r.deviation;
  }
  return json;
}

} // namespace

class Recorder::Impl {
public:
  Impl(const model::Model& model, std::filesystem::path folder)
      : model_(model), folder_(created(std::move(folder))), probe_nodes_(find_probes()),
        probes_(folder_ / "probes.csv", probe_columns()), steps_(folder_ / "steps.jsonl", std::ios::trunc),
        series_(folder_ / "fields.pvd") {
    history_.columns = probe_columns();
    std::vector<std::string> columns{"t", "in_contact", "sticking"};
    for (int i = 0; i < model_.dofs.components; ++i)
      columns.push_back(fmt::format("force.{}", axes[static_cast<std::size_t>(i)]));
    columns.insert(columns.end(), {"normal", "friction", "largest_pressure", "smallest_gap"});
    for (const auto& zone : model_.zones)
      resultants_.emplace_back(folder_ / fmt::format("resultants_{}.csv", zone.settings.name), columns);
    if (model_.study.fields.vtu)
      created(folder_ / "fields");
    if (model_.study.fields.med)
      mesh::write_med(folder_ / "fields.med", model_.mesh, mesh_name);
  }

  void start(const step::State& state) {
    write_probes(state);
    if (wants_fields(state.t, 0, false))
      write_fields(state, state);
  }

  void step(const step::State& before, const step::State& now, const Attempt& attempt,
            const step::StepReport& report, bool last) {
    ++steps_done_;
    write_probes(now);
    write_resultants(before, now);
    write_attempt(attempt, report);
    if (wants_fields(now.t, now.t - before.t, last))
      write_fields(before, now);
  }

  void failed(const Attempt& attempt, const step::StepReport& report) { write_attempt(attempt, report); }

  std::vector<CheckResult> finish(const Ending& ending) {
    const auto checks = evaluate_checks(model_.study.checks, history_);
    ordered_json json{{"run", model_.study.name},
                      {"rubato", std::string(version)},
                      {"complete", ending.complete},
                      {"reason", ending.reason},
                      {"steps", ending.steps},
                      {"iterations", ending.iterations},
                      {"cuts", ending.cuts},
                      {"setup_seconds", ending.setup_seconds},
                      {"loop_seconds", ending.loop_seconds},
                      {"nodes", model_.mesh.node_count()},
                      {"unknowns", model_.free_dofs.size()},
                      {"checks", ordered_json::array()},
                      {"study", ordered_json::parse(deck::to_json(model_.study))}};
    for (const auto& check : checks)
      json["checks"].push_back(to_json(check));
    std::ofstream file(folder_ / "run.json");
    file << json.dump(2) << '\n';
    if (!file)
      throw std::runtime_error(fmt::format("{}: cannot be written", (folder_ / "run.json").string()));
    return checks;
  }

private:
  static constexpr const char* mesh_name = "mesh";

  std::vector<mesh::NodeIndex> find_probes() const {
    std::vector<mesh::NodeIndex> nodes;
    for (const auto& probe : model_.study.probes)
      nodes.push_back(node_of(model_, probe));
    return nodes;
  }

  std::vector<std::string> probe_columns() const {
    std::vector<std::string> columns{"t"};
    for (const auto& probe : model_.study.probes)
      for (int i = 0; i < model_.dofs.components; ++i)
        columns.push_back(fmt::format("{}.{}", probe.name, axes[static_cast<std::size_t>(i)]));
    return columns;
  }

  void write_probes(const step::State& state) {
    std::vector<double> row{state.t};
    for (std::size_t p = 0; p < probe_nodes_.size(); ++p)
      for (int i = 0; i < model_.dofs.components; ++i)
        row.push_back(field_of(state, model_.study.probes[p].field)[model_.dofs.dof(probe_nodes_[p], i)]);
    probes_.row(row);
    history_.rows.push_back(std::move(row));
  }

  void write_resultants(const step::State& before, const step::State& now) {
    for (std::size_t z = 0; z < model_.zones.size(); ++z) {
      const auto r = contact_resultants(model_, z, before, now);
      std::vector<double> row{now.t, static_cast<double>(r.in_contact), static_cast<double>(r.sticking)};
      for (int i = 0; i < model_.dofs.components; ++i)
        row.push_back(r.force[i]);
      row.insert(row.end(), {r.normal, r.friction, r.largest_pressure, r.smallest_gap});
      resultants_[z].row(row);
    }
  }

  void write_attempt(const Attempt& attempt, const step::StepReport& report) {
    ordered_json json{{"begin", attempt.begin},
                      {"end", attempt.end},
                      {"cut_level", attempt.cut_level},
                      {"accepted", attempt.accepted},
                      {"outcome", step::to_string(report.outcome)},
                      {"iterations", report.iterations},
                      {"residual", report.residual},
                      {"status_changes", report.status_changes},
                      {"friction_continuation", report.friction_continuation},
                      {"seconds", attempt.seconds}};
    if (!attempt.accepted && report.worst_node >= 0)
      json["worst_node"] = model::node_label(model_.mesh, report.worst_node);
    steps_ << json.dump() << '\n' << std::flush;
  }

  bool wants_fields(double t, double step, bool last) const {
    const auto& wanted = model_.study.fields;
    if (!wanted.vtu && !wanted.med)
      return false;
    if (last && wanted.last)
      return true;
    if (wanted.every > 0 && steps_done_ % wanted.every == 0)
      return true;
    return std::ranges::any_of(wanted.at, [&](double at) {
      return std::abs(t - at) <= std::max(step * 1e-6, same_instant * std::abs(at));
    });
  }

  void write_fields(const step::State& before, const step::State& now) {
    const auto owned = nodal_fields(model_, before, now);
    std::vector<NodalField> fields;
    std::ranges::transform(owned, std::back_inserter(fields), &OwnedField::view);
    if (model_.study.fields.vtu) {
      const auto file = std::filesystem::path("fields") / fmt::format("{:06}.vtu", steps_done_);
      write_vtu(folder_ / file, model_.mesh, fields);
      series_.add(now.t, folder_ / file);
    }
    if (model_.study.fields.med)
      append_med_fields(folder_ / "fields.med", mesh_name, {steps_done_, now.t}, fields);
  }

  const model::Model& model_;
  std::filesystem::path folder_;
  std::vector<mesh::NodeIndex> probe_nodes_;
  CsvWriter probes_;
  std::ofstream steps_;
  PvdSeries series_;
  std::vector<CsvWriter> resultants_;
  Table history_;
  int steps_done_ = 0;
};

Recorder::Recorder(const model::Model& model, std::filesystem::path folder)
    : impl_(std::make_unique<Impl>(model, std::move(folder))) {}
Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

void Recorder::start(const step::State& state) {
  impl_->start(state);
}
void Recorder::step(const step::State& before, const step::State& now, const Attempt& attempt,
                    const step::StepReport& report, bool last) {
  impl_->step(before, now, attempt, report, last);
}
void Recorder::failed(const Attempt& attempt, const step::StepReport& report) {
  impl_->failed(attempt, report);
}
std::vector<CheckResult> Recorder::finish(const Ending& ending) {
  return impl_->finish(ending);
}

} // namespace rubato::results
