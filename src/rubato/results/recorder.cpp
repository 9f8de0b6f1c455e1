// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/recorder.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/attempt_json.hpp"
#include "rubato/results/ccx_files.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/contact_table.hpp"
#include "rubato/results/growing_file.hpp"
#include "rubato/results/history.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/probe_values.hpp"
#include "rubato/results/resultants.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/stored_run.hpp"
#include "rubato/results/summary_json.hpp"
#include "rubato/results/vtkhdf.hpp"
#include "rubato/results/vtu.hpp"
#include "rubato/step/massless_motion.hpp"
#include "rubato/study/echo.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

namespace rubato::results {
namespace {

using nlohmann::ordered_json;

std::filesystem::path prepared(std::filesystem::path folder) {
  prepare_run_folder(folder);
  return folder;
}

std::ofstream opened(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::trunc);
  if (!file)
    throw InputError(fmt::format("{}: cannot be written", path.string()));
  return file;
}

} // namespace

class Recorder::Impl {
public:
  Impl(const model::Model& model, std::filesystem::path folder)
      : model_(model), folder_(prepared(std::move(folder))), probes_(folder_ / probes_file, probe_columns()),
        steps_(folder_ / steps_file), energy_(folder_ / energy_file, energy_columns()),
        series_(folder_ / pvd_file) {
    write_summary(running, {});
    history_.columns = probe_columns();
    const auto columns = resultant_columns();
    for (std::size_t z = 0; z < model_.zones.size(); ++z) {
      resultants_.emplace_back(folder_ / resultants_file(model_.zones[z].settings.name), columns);
      contact_.emplace_back(model_, z, folder_);
    }
    if (model_.study.fields.vtu)
      std::filesystem::create_directories(folder_ / vtu_folder);
    place_growing_files({}, {});
    if (med_)
      mesh::write_med(med_->path(), model_.mesh, mesh_name);
    if (vtkhdf_)
      start_vtkhdf(vtkhdf_->path(), model_.mesh);
    if (model_.study.fields.frd || !model_.study.fields.tables.empty())
      ccx_.emplace(model_, folder_);
  }

  Impl(const model::Model& model, std::filesystem::path folder, const RecorderPosition& position)
      : model_(model), folder_(std::move(folder)), probes_(folder_ / probes_file, position.probes),
        steps_(folder_ / steps_file, position.attempts), energy_(folder_ / energy_file, position.energy),
        energy_places_(places_of_energies(read_csv(folder_ / energy_file).columns)),
        series_(folder_ / pvd_file, series_of(position)), history_(read_csv(folder_ / probes_file)),
        unwritten_(position.unwritten), steps_done_(position.steps), warnings_(stored_warnings(folder_)) {
    place_growing_files(position.med_copy, position.vtkhdf_copy);
    vtkhdf_instants_ = position.vtkhdf_instants;
    for (std::size_t z = 0; z < model_.zones.size(); ++z) {
      resultants_.emplace_back(folder_ / resultants_file(model_.zones[z].settings.name),
                               position.resultants.at(z));
      contact_.emplace_back(model_, z, folder_, position.contact.at(z));
    }
    restore_fields();
    if (!position.ccx.empty())
      ccx_.emplace(model_, folder_, position.ccx);
    write_summary(running, {});
  }

  void needs_memory(std::size_t bytes) {
    factor_bytes_ = bytes;
    write_summary(running, {});
  }

  void takes_steps_by(const std::string& method) {
    method_ = method;
    write_summary(running, {});
  }

  void warn(const std::string& text) {
    if (std::ranges::find(warnings_, text) != warnings_.end())
      return;
    warnings_.push_back(text);
    try {
      write_summary(running, {});
    } catch (const WriteError&) {
      return; // finish() writes it
    }
  }

  /// What needs most room comes first: when the disk is full, no table has begun.
  void start(const step::State& state) {
    if (wants_fields(state.t, 0, false))
      write_fields(state);
    write_probes(state);
  }

  void step(const step::State& before, const step::State& now, const simulation::Attempt& attempt,
            const step::StepReport& report, bool last) {
    mark();
    ++steps_done_;
    std::optional<step::State> other_motion;
    if (!model_.massless_nodes.empty())
      other_motion = step::with_massless_motion(model_, before, now);
    const auto& told = other_motion ? *other_motion : now;
    write_probes(told);
    write_resultants(told);
    if (ccx_)
      ccx_->write_tables(told, steps_done_, last);
    write_attempt(attempt, report);
    const bool wanted = wants_fields(now.t, now.t - before.t, last);
    unwritten_ = !wanted && model_.study.fields.last;
    if (wanted)
      write_chosen(told);
    unwritten_state_ = unwritten_ ? std::move(other_motion) : std::nullopt;
  }

  void failed(const simulation::Attempt& attempt, const step::StepReport& report) {
    mark();
    write_attempt(attempt, report);
  }

  void energy(double t, const step::EnergyLedger& e) {
    const std::array<double, study::energy_quantities.size()> all{
        e.kinetic,   e.strain,  e.external_work, e.support_work, e.overlap_work, e.heat,
        e.damping,   e.contact, e.friction,      e.plastic,      e.back_stress,  e.viscous,
        e.hourglass, e.impact,  e.numerical,     e.bulk_scheme,  e.unbalanced,   e.balance()};
    std::vector<double> row{t};
    for (const auto place : energy_places_)
      row.push_back(all[place]);
    energy_.row(row);
  }

  /// A .vtu file that was written whole stays; the next one of that number takes its place.
  void take_back() {
    if (!mark_)
      return;
    const auto mark = *std::exchange(mark_, std::nullopt);
    probes_.cut(mark.probes);
    steps_.cut(mark.attempts);
    energy_.cut(mark.energy);
    for (std::size_t z = 0; z < resultants_.size(); ++z)
      resultants_[z].cut(mark.resultants[z]);
    for (std::size_t z = 0; z < contact_.size(); ++z)
      contact_[z].cut(mark.contact[z]);
    if (ccx_)
      ccx_->cut(mark.ccx);
    auto entries = series_.entries();
    entries.resize(mark.fields);
    series_ = PvdSeries(folder_ / pvd_file, std::move(entries));
    vtkhdf_instants_ = mark.vtkhdf;
    history_.rows.resize(mark.history);
    steps_done_ = mark.steps_done;
    unwritten_ = mark.unwritten;
    unwritten_state_.reset();
  }

  RecorderPosition position() {
    RecorderPosition position;
    position.steps = steps_done_;
    position.probes = probes_.bytes();
    position.attempts = steps_.bytes();
    position.energy = energy_.bytes();
    for (const auto& table : resultants_)
      position.resultants.push_back(table.bytes());
    for (const auto& table : contact_)
      position.contact.push_back(table.bytes());
    for (const auto& entry : series_.entries()) {
      position.field_times.push_back(entry.time);
      position.field_files.push_back(entry.file.generic_string());
    }
    if (med_)
      position.med_copy = med_->name_copy(steps_done_);
    if (vtkhdf_)
      position.vtkhdf_copy = vtkhdf_->name_copy(steps_done_);
    position.vtkhdf_instants = vtkhdf_instants_;
    position.unwritten = unwritten_;
    if (ccx_)
      position.ccx = ccx_->position();
    return position;
  }

  std::vector<CheckResult> finish(const Ending& ending, const step::State& last) {
    std::exception_ptr unwritten_fields; // the summary needs less room than they do
    try {
      if (unwritten_ && ending.status != RunStatus::complete)
        write_chosen(unwritten_state_ ? *unwritten_state_ : last);
    } catch (const WriteError&) {
      unwritten_fields = std::current_exception();
    }
    auto checks = evaluate_checks(model_.study.checks, history_, folder_);
    write_summary(ending, checks);
    if (unwritten_fields)
      std::rethrow_exception(unwritten_fields);
    return checks;
  }

private:
  static constexpr const char* mesh_name = "mesh";
  inline static const Ending running{.reason = "the run did not come to its end"};

  /// How far the files had come before the last attempt was written.
  struct Mark {
    std::uintmax_t probes = 0;
    std::uintmax_t attempts = 0;
    std::uintmax_t energy = 0;
    std::vector<std::uintmax_t> resultants;
    std::vector<std::uintmax_t> contact;
    std::size_t fields = 0;
    int vtkhdf = 0;
    std::size_t history = 0;
    int steps_done = 0;
    bool unwritten = false;
    std::string ccx;
  };

  void mark() {
    mark_ = {probes_.bytes(),
             steps_.bytes(),
             energy_.bytes(),
             {},
             {},
             series_.entries().size(),
             vtkhdf_instants_,
             history_.rows.size(),
             steps_done_,
             unwritten_,
             ccx_ ? ccx_->position() : ""};
    for (const auto& table : resultants_)
      mark_->resultants.push_back(table.bytes());
    for (const auto& table : contact_)
      mark_->contact.push_back(table.bytes());
  }

  static std::vector<PvdSeries::Entry> series_of(const RecorderPosition& position) {
    std::vector<PvdSeries::Entry> entries;
    for (std::size_t i = 0; i < position.field_times.size(); ++i)
      entries.push_back({position.field_times[i], position.field_files.at(i)});
    return entries;
  }

  void restore_fields() {
    if (model_.study.fields.vtu) {
      std::vector<std::string> kept;
      for (const auto& entry : series_.entries())
        kept.push_back(entry.file.filename().string());
      remove_vtu_files_but(folder_, kept);
      series_.rewrite();
    }
    if (med_)
      med_->restore();
    if (vtkhdf_)
      vtkhdf_->restore();
  }

  void place_growing_files(const std::string& med_copy, const std::string& vtkhdf_copy) {
    if (model_.study.fields.med)
      med_.emplace(folder_, med_file, med_copy);
    if (model_.study.fields.vtkhdf)
      vtkhdf_.emplace(folder_, vtkhdf_file, vtkhdf_copy);
  }

  /// Written beside and then renamed: whoever reads it meanwhile finds a whole one.
  void write_summary(const Ending& ending, const std::vector<CheckResult>& checks) const {
    ordered_json json{{"run", model_.study.name},
                      {"rubato", std::string(version)},
                      {"status", to_string(ending.status)},
                      {"reason", ending.reason},
                      {"steps", ending.steps},
                      {"iterations", ending.iterations},
                      {"cuts", ending.cuts},
                      {"setup_seconds", ending.setup_seconds},
                      {"loop_seconds", ending.loop_seconds},
                      {"elapsed_seconds", ending.elapsed_seconds},
                      {"ranks", model_.ranks.count()},
                      {"sent_bytes", static_cast<std::uint64_t>(ending.sent_bytes)},
                      {"threads", model_.threads.count()},
                      {"nodes", model_.mesh.node_count()},
                      {"unknowns", model_.reduction.unknown_count()},
                      {"method", method_},
                      {"factor_bytes", factor_bytes_},
                      {"checks", ordered_json::array()},
                      {"plausibility", plausibility_json(ending.plausibility)},
                      {"warnings", warnings_},
                      {"contact_sides", sides_json(model_)},
                      {"tolerances", tolerances_json()},
                      {"study", ordered_json::parse(study::to_json(model_.study))}};
    if (ending.failure)
      json["failure"] = to_json(model_, *ending.failure);
    for (const auto& check : checks)
      json["checks"].push_back(check_json(check));
    write_whole(folder_ / summary_file, [&](const std::filesystem::path& beside) {
      auto file = opened(beside);
      file << json.dump(2) << '\n';
      finish_writing(file, beside);
    });
  }

  static std::vector<std::string> after_instant(std::vector<std::string> columns) {
    columns.insert(columns.begin(), "t");
    return columns;
  }

  std::vector<std::string> resultant_columns() const {
    return after_instant(study::resultant_quantities(model_.dofs.components));
  }

  static std::vector<std::string> energy_columns() {
    return after_instant({study::energy_quantities.begin(), study::energy_quantities.end()});
  }

  /// In energy_quantities, of the columns after the instant. A table that an older program began goes on with
  /// the columns that it has.
  static std::vector<std::size_t> places_of_energies(const std::vector<std::string>& columns) {
    std::vector<std::size_t> places;
    for (std::size_t column = 1; column < columns.size(); ++column) {
      const auto found = std::ranges::find(study::energy_quantities, columns[column]);
      if (found == study::energy_quantities.end())
        throw InputError(fmt::format("{}: found the column '{}', expected energies that this program knows",
                                     energy_file, columns[column]));
      places.push_back(static_cast<std::size_t>(found - study::energy_quantities.begin()));
    }
    return places;
  }

  std::vector<std::string> probe_columns() const { return after_instant(results::probe_columns(model_)); }

  void write_probes(const step::State& state) {
    std::vector<double> row;
    row.reserve(history_.columns.size());
    row.push_back(state.t);
    add_probe_values(model_, state, row);
    probes_.row(row);
    history_.rows.push_back(std::move(row));
  }

  void write_resultants(const step::State& now) {
    for (std::size_t z = 0; z < model_.zones.size(); ++z) {
      const auto r = contact_resultants(now.zones[z]);
      std::vector<double> row{now.t, static_cast<double>(r.in_contact), static_cast<double>(r.sticking)};
      for (int i = 0; i < model_.dofs.components; ++i)
        row.push_back(r.force[i]);
      row.insert(row.end(), {r.normal, r.friction, r.largest_pressure, r.smallest_gap});
      resultants_[z].row(row);
    }
  }

  void write_attempt(const simulation::Attempt& attempt, const step::StepReport& report) {
    steps_.add(to_json(model_, attempt, report).dump());
  }

  bool wants_fields(double t, double step, bool last) const {
    const auto& wanted = model_.study.fields;
    if (last && wanted.last)
      return true;
    if (wanted.every > 0 && steps_done_ % wanted.every == 0)
      return true;
    return is_named_instant(wanted.at, t, step);
  }

  /// All that is written at chosen instants. Before the first step nothing is known of contact.
  void write_chosen(const step::State& now) {
    for (auto& table : contact_)
      table.write(now);
    write_fields(now);
  }

  void write_fields(const step::State& now) {
    const auto& output = model_.study.fields;
    if (!output.vtu && !output.med && !output.vtkhdf && !output.frd)
      return;
    const auto owned = nodal_fields(model_, now, output);
    const auto in_cells = cell_fields(model_, now, output);
    std::vector<NodalField> fields;
    std::ranges::transform(owned, std::back_inserter(fields), &OwnedField::view);
    if (output.vtu) {
      const auto file = std::filesystem::path(vtu_folder) / vtu_file(steps_done_);
      write_vtu(folder_ / file, model_.mesh, fields, {.cell_fields = in_cells, .digits = output.digits});
      series_.add(now.t, folder_ / file);
    }
    if (vtkhdf_) {
      vtkhdf_->keep_copy();
      append_vtkhdf(vtkhdf_->path(), model_.mesh, {vtkhdf_instants_++, now.t}, fields, in_cells,
                    output.digits);
    }
    if (ccx_ && steps_done_ > 0)
      ccx_->write_fields(now, steps_done_, owned);
    if (med_) {
      med_->keep_copy();
      append_med_fields(med_->path(), mesh_name, {steps_done_, now.t}, fields, "", in_cells);
    }
  }

  const model::Model& model_;
  std::filesystem::path folder_;
  CsvWriter probes_;
  LineFile steps_;
  CsvWriter energy_;
  std::vector<std::size_t> energy_places_ = places_of_energies(energy_columns());
  PvdSeries series_;
  std::vector<CsvWriter> resultants_;
  std::vector<ContactTable> contact_;
  Table history_;
  bool unwritten_ = false;                     // whether the last step has no fields that it may still get
  std::optional<step::State> unwritten_state_; // it, where its surfaces have no mass
  std::optional<GrowingFile> med_;
  std::optional<GrowingFile> vtkhdf_;
  std::optional<CcxFiles> ccx_;
  int vtkhdf_instants_ = 0;
  std::optional<Mark> mark_; // before the attempt that was written last
  int steps_done_ = 0;
  std::string method_;
  std::size_t factor_bytes_ = 0;
  std::vector<std::string> warnings_;
};

Recorder::Recorder(const model::Model& model, std::filesystem::path folder)
    : impl_(std::make_unique<Impl>(model, std::move(folder))) {}
Recorder::Recorder(const model::Model& model, std::filesystem::path folder, const RecorderPosition& position)
    : impl_(std::make_unique<Impl>(model, std::move(folder), position)) {}
Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

void Recorder::takes_steps_by(const std::string& method) {
  impl_->takes_steps_by(method);
}

void Recorder::needs_memory(std::size_t bytes) {
  impl_->needs_memory(bytes);
}
void Recorder::warn(const std::string& text) {
  impl_->warn(text);
}
void Recorder::start(const step::State& state) {
  impl_->start(state);
}
void Recorder::step(const step::State& before, const step::State& now, const simulation::Attempt& attempt,
                    const step::StepReport& report, bool last) {
  impl_->step(before, now, attempt, report, last);
}
void Recorder::energy(double t, const step::EnergyLedger& ledger) {
  impl_->energy(t, ledger);
}
void Recorder::take_back() {
  impl_->take_back();
}
void Recorder::failed(const simulation::Attempt& attempt, const step::StepReport& report) {
  impl_->failed(attempt, report);
}
RecorderPosition Recorder::position() {
  return impl_->position();
}
std::vector<CheckResult> Recorder::finish(const Ending& ending, const step::State& last) {
  return impl_->finish(ending, last);
}

} // namespace rubato::results
