// SPDX-License-Identifier: LGPL-3.0-or-later
// `exchange` lists what a checkpoint holds; an archive writes each entry or replaces it by what it reads.
#include "rubato/results/checkpoint.hpp"

#include "rubato/contact/explicit_penalty.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/domain/point_numbers.hpp"
#include "rubato/results/hdf5_file.hpp"
#include "rubato/results/seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <exception>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

namespace rubato::results {
namespace {

using contact::PointOutcome;
using contact::Status;
using Spring = contact::ExplicitPenalty::Spring;

/// Shows every number of a record of a table, in the same order always.
template <class Visit> void each_number(PointOutcome& outcome, const Visit& visit) {
  for (auto* x : {&outcome.gap, &outcome.pressure, &outcome.activation_gap, &outcome.area})
    visit(*x);
  for (auto& x : outcome.slip)
    visit(x);
  for (auto* force : {&outcome.normal, &outcome.tangential})
    for (auto& x : *force)
      visit(x);
}

template <class Visit> void each_number(contact::FrictionHistory& history, const Visit& visit) {
  visit(history.slip);
  visit(history.work);
}

template <class Visit> void each_number(Spring& spring, const Visit& visit) {
  auto status = static_cast<double>(spring.status);
  double paired = spring.paired ? 1 : 0;
  visit(status);
  visit(paired);
  spring.status = static_cast<Status>(static_cast<int>(status));
  spring.paired = paired != 0;
  for (auto* x : {&spring.gap_offset, &spring.gap, &spring.pressure, &spring.tangential_stiffness})
    visit(*x);
  for (auto* v : {&spring.slip, &spring.traction, &spring.normal})
    for (auto& x : *v)
      visit(x);
  for (auto& x : spring.slip_on_tangents)
    visit(x);
}

template <class Visit> void each_number(time::StepControl::End& end, const Visit& visit) {
  double level = end.level;
  visit(end.instant);
  visit(level);
  end.level = static_cast<int>(level);
}

using domain::each_number;

template <class Record> std::size_t numbers_in() {
  Record record{};
  std::size_t count = 0;
  each_number(record, [&](double&) { ++count; });
  return count;
}

/// What a step control keeps a status by, or a count.
template <class T>
concept Whole = std::integral<T> || std::is_enum_v<T>;

class Writer {
public:
  explicit Writer(Hdf5File& file) : file_(&file) {}

  void text(const std::string& name, std::string& value) { file_->write(name, value); }
  void text_if(const std::string& name, std::string& value) {
    if (!value.empty())
      text(name, value);
  }
  void number(const std::string& name, double& value) { file_->write(name, std::span(&value, 1)); }
  /// Left out where it is 0, as in files from before there was such a number.
  void number_if(const std::string& name, double& value) {
    if (value != 0)
      number(name, value);
  }
  template <Whole T> void whole(const std::string& name, T& value) {
    const auto integer = static_cast<std::int64_t>(value);
    file_->write(name, std::span(&integer, 1));
  }
  template <class Vector> void numbers(const std::string& name, const Vector& values) {
    file_->write(name, std::span<const double>(values.data(), static_cast<std::size_t>(values.size())));
  }
  /// Left out where there is nothing: files from before there was such a thing have none.
  void few_numbers(const std::string& name, Eigen::VectorXd& values) {
    if (values.size() > 0)
      numbers(name, values);
  }
  void tangent(const std::string& name, step::Tangent& values) {
    if (values)
      numbers(name, *values);
  }
  void states(const std::string& name, domain::QuadratureStates& states) {
    if (!states.values.empty())
      numbers(name, states.values);
    if (states.records.empty())
      return;
    table(name + "_records", states.records);
    number(name + "_mode_force", states.mode_force);
  }
  template <class Record> void few_in_table(const std::string& name, std::vector<Record>& records) {
    if (!records.empty())
      table(name, records);
  }
  template <Whole T> void wholes(const std::string& name, std::vector<T>& values) {
    std::vector<std::int64_t> integers;
    std::ranges::transform(values, std::back_inserter(integers),
                           [](T value) { return static_cast<std::int64_t>(value); });
    file_->write(name, integers);
  }
  template <class Record> void table(const std::string& name, std::vector<Record>& records) {
    std::vector<double> flat;
    for (auto& record : records)
      each_number(record, [&](double& x) { flat.push_back(x); });
    file_->write(name, flat);
  }
  /// How many parts follow.
  template <class Part> void parts(const std::string& name, std::vector<Part>& parts) {
    auto count = parts.size();
    whole(name, count);
  }

private:
  Hdf5File* file_;
};

/// Counts what Writer would write.
class Sizer {
public:
  /// With what HDF5 tells about each array.
  std::uintmax_t bytes() const { return of_file + bytes_; }

  void text(const std::string&, const std::string& value) { add(value.size()); }
  void text_if(const std::string& name, const std::string& value) { text(name, value); }
  void number(const std::string&, double&) { add(sizeof(double)); }
  void number_if(const std::string& name, double& value) { number(name, value); }
  template <Whole T> void whole(const std::string&, T&) { add(sizeof(std::int64_t)); }
  template <class Vector> void numbers(const std::string&, const Vector& values) {
    add(static_cast<std::size_t>(values.size()) * sizeof(double));
  }
  void few_numbers(const std::string& name, Eigen::VectorXd& values) { numbers(name, values); }
  void tangent(const std::string& name, step::Tangent& values) {
    if (values)
      numbers(name, *values);
  }
  void states(const std::string& name, domain::QuadratureStates& states) {
    numbers(name, states.values);
    if (states.records.empty())
      return;
    table(name, states.records);
    number(name, states.mode_force);
  }
  template <class Record> void few_in_table(const std::string& name, std::vector<Record>& records) {
    table(name, records);
  }
  template <Whole T> void wholes(const std::string&, std::vector<T>& values) {
    add(values.size() * sizeof(std::int64_t));
  }
  template <class Record> void table(const std::string&, std::vector<Record>& records) {
    add(records.size() * numbers_in<Record>() * sizeof(double));
  }
  template <class Part> void parts(const std::string&, std::vector<Part>&) { add(sizeof(std::int64_t)); }

private:
  static constexpr std::uintmax_t of_file = 8192;
  static constexpr std::uintmax_t of_array = 512;
  void add(std::size_t bytes) { bytes_ += of_array + bytes; }
  std::uintmax_t bytes_ = 0;
};

class Reader {
public:
  explicit Reader(const Hdf5File& file) : file_(&file) {}

  void text(const std::string& name, std::string& value) { value = file_->text(name); }
  void text_if(const std::string& name, std::string& value) {
    value = file_->has(name) ? file_->text(name) : "";
  }
  void number(const std::string& name, double& value) { value = file_->numbers(name).at(0); }
  void number_if(const std::string& name, double& value) {
    value = file_->has(name) ? file_->numbers(name).at(0) : 0;
  }
  template <Whole T> void whole(const std::string& name, T& value) {
    value = static_cast<T>(file_->integers(name).at(0));
  }
  void numbers(const std::string& name, std::vector<double>& values) { values = file_->numbers(name); }
  void numbers(const std::string& name, Eigen::VectorXd& values) {
    const auto read = file_->numbers(name);
    values = Eigen::Map<const Eigen::VectorXd>(read.data(), static_cast<Eigen::Index>(read.size()));
  }
  void few_numbers(const std::string& name, Eigen::VectorXd& values) {
    values.resize(0);
    if (file_->has(name))
      numbers(name, values);
  }
  void tangent(const std::string& name, step::Tangent& values) {
    Eigen::VectorXd read;
    few_numbers(name, read);
    values = read.size() > 0 ? std::make_shared<const Eigen::VectorXd>(std::move(read)) : nullptr;
  }
  void states(const std::string& name, domain::QuadratureStates& states) {
    states.values = file_->has(name) ? file_->numbers(name) : std::vector<double>();
    states.records.clear();
    states.mode_force = 0;
    if (!file_->has(name + "_records"))
      return;
    table(name + "_records", states.records);
    number(name + "_mode_force", states.mode_force);
  }
  template <class Record> void few_in_table(const std::string& name, std::vector<Record>& records) {
    records.clear();
    if (file_->has(name))
      table(name, records);
  }
  template <Whole T> void wholes(const std::string& name, std::vector<T>& values) {
    values.clear();
    for (const auto integer : file_->integers(name))
      values.push_back(static_cast<T>(integer));
  }
  template <class Record> void table(const std::string& name, std::vector<Record>& records) {
    const auto flat = file_->numbers(name);
    records.assign(flat.size() / numbers_in<Record>(), {});
    std::size_t next = 0;
    for (auto& record : records)
      each_number(record, [&](double& x) { x = flat.at(next++); });
  }
  template <class Part> void parts(const std::string& name, std::vector<Part>& parts) {
    std::size_t count = 0;
    whole(name, count);
    parts.resize(count);
  }

private:
  const Hdf5File* file_;
};

template <class Archive> void exchange(Archive& archive, simulation::Counters& spent) {
  archive.whole("spent/steps", spent.steps);
  archive.whole("spent/iterations", spent.iterations);
  archive.whole("spent/cuts", spent.cuts);
}

template <class Archive>
void exchange(Archive& archive, const std::string& at, contact::PointForces& forces) {
  forces.exchange([&]<class Values>(const std::string& name, Values& values) {
    if constexpr (std::is_same_v<Values, std::vector<double>>)
      archive.numbers(at + name, values);
    else
      archive.wholes(at + name, values);
  });
}

template <class Archive> void exchange(Archive& archive, step::State& state) {
  archive.number("state/t", state.t);
  archive.number("state/step", state.step);
  archive.numbers("state/u", state.motion.u);
  archive.numbers("state/v", state.motion.v);
  archive.numbers("state/a", state.motion.a);
  archive.numbers("state/unbalance", state.residual_force);
  archive.numbers("state/contact_force", state.contact_force);
  archive.numbers("state/reaction", state.reaction);
  archive.number("state/force_scale", state.force_scale);
  archive.numbers("state/friction_force", state.friction_force);
  archive.numbers("state/external_force", state.external_force);
  archive.number("state/load_factor", state.load_factor);
  archive.few_numbers("state/shortening", state.shortening);
  archive.numbers("state/bulk/internal", state.bulk.internal);
  archive.numbers("state/bulk/viscous", state.bulk.viscous);
  archive.numbers("state/bulk/momentum", state.bulk.momentum);
  archive.numbers("state/bulk/inertia", state.bulk.inertia);
  archive.states("state/bulk_points", state.bulk_points);
  archive.few_numbers("state/moved", state.moved);
  archive.tangent("state/tangent", state.tangent);
  double indefinite = state.indefinite ? 1 : 0;
  archive.number_if("state/indefinite", indefinite);
  state.indefinite = indefinite != 0;
  archive.parts("state/zones", state.zones);
  for (std::size_t z = 0; z < state.zones.size(); ++z) {
    const auto at = fmt::format("state/zone_{}/", z);
    archive.numbers(at + "multipliers", state.zones[z].multipliers);
    archive.wholes(at + "status", state.zones[z].status);
    archive.table(at + "outcomes", state.zones[z].outcomes);
    archive.table(at + "friction_history", state.zones[z].friction_history);
    archive.numbers(at + "lifts", state.zones[z].lifts);
    archive.few_numbers(at + "of_receivers", state.zones[z].of_receivers);
    exchange(archive, at + "friction_forces/", state.zones[z].friction_forces);
    exchange(archive, at + "pressing_forces/", state.zones[z].pressing_forces);
    archive.number(at + "obstacle_work/normal", state.zones[z].obstacle_work.normal);
    archive.number(at + "obstacle_work/tangential", state.zones[z].obstacle_work.tangential);
  }
}

template <class Archive> void exchange(Archive& archive, time::StepControl::Place& place) {
  archive.number("place/now", place.now);
  archive.table("place/ends", place.ends);
  archive.whole("place/finished", place.finished);
  archive.number_if("place/wanted", place.wanted);
}

template <class Archive> void exchange(Archive& archive, const std::string& at, step::EnergyLedger& energy) {
  archive.number(at + "kinetic", energy.kinetic);
  archive.number(at + "strain", energy.strain);
  archive.number(at + "contact", energy.contact);
  archive.number(at + "external_work", energy.external_work);
  archive.number(at + "support_work", energy.support_work);
  archive.number(at + "overlap_work", energy.overlap_work);
  archive.number(at + "heat", energy.heat);
  archive.number(at + "held_heat", energy.held_heat);
  archive.number(at + "damping", energy.damping);
  archive.number(at + "friction", energy.friction);
  archive.number(at + "impact", energy.impact);
  archive.number(at + "numerical", energy.numerical);
  archive.number(at + "unbalanced", energy.unbalanced);
  archive.number(at + "start", energy.start);
  archive.number(at + "rounding", energy.rounding);
  archive.number_if(at + "plastic", energy.plastic);
  archive.number_if(at + "back_stress", energy.back_stress);
  archive.number_if(at + "viscous", energy.viscous);
  archive.number_if(at + "hourglass", energy.hourglass);
  archive.number_if(at + "bulk_scheme", energy.bulk_scheme);
}

template <class Archive> void exchange(Archive& archive, step::EnergyRecord& record) {
  archive.number("energy_record/largest", record.largest);
  archive.number("energy_record/largest_balance", record.largest_balance);
  archive.number("energy_record/gain", record.gain);
  archive.number("energy_record/gained_at", record.gained_at);
  archive.number("energy_record/by_impact", record.by_impact);
  archive.number("energy_record/by_scheme", record.by_scheme);
  archive.number_if("energy_record/by_bulk_scheme", record.by_bulk_scheme);
}

template <class Archive> void exchange(Archive& archive, std::vector<Plausibility>& checks) {
  auto text = plausibility_text(checks);
  archive.text_if("plausibility", text);
  checks = plausibility_of(text);
}

template <class Archive> void exchange(Archive& archive, RecorderPosition& position) {
  archive.whole("files/steps", position.steps);
  archive.whole("files/probes", position.probes);
  archive.whole("files/attempts", position.attempts);
  archive.whole("files/energy", position.energy);
  archive.wholes("files/resultants", position.resultants);
  archive.wholes("files/contact", position.contact);
  archive.numbers("files/field_times", position.field_times);
  archive.parts("files/field_files", position.field_files);
  for (std::size_t i = 0; i < position.field_files.size(); ++i)
    archive.text(fmt::format("files/field_file_{}", i), position.field_files[i]);
  archive.text("files/med_copy", position.med_copy);
  archive.text("files/vtkhdf_copy", position.vtkhdf_copy);
  archive.whole("files/vtkhdf_instants", position.vtkhdf_instants);
  archive.whole("files/unwritten", position.unwritten);
  archive.text_if("files/ccx", position.ccx);
}

template <class Archive> void exchange(Archive& archive, simulation::ExplicitProgress& progress) {
  auto& motion = progress.motion;
  archive.number("explicit/limit", progress.limit);
  archive.number("explicit/t", motion.t);
  archive.number("explicit/step", motion.step);
  archive.whole("explicit/steps", motion.steps);
  archive.numbers("explicit/u", motion.u);
  archive.numbers("explicit/v", motion.v);
  archive.numbers("explicit/unbalance", motion.residual_force);
  archive.numbers("explicit/contact_force", motion.contact_force);
  archive.numbers("explicit/damping_force", motion.damping_force);
  archive.numbers("explicit/load_factors", motion.load_factors);
  archive.numbers("explicit/load_displacements", motion.load_displacements);
  archive.numbers("explicit/reactions", motion.reactions);
  archive.states("explicit/bulk_points", motion.bulk_points);
  archive.few_in_table("explicit/path_points", motion.path.points);
  archive.few_numbers("explicit/path_forces", motion.path.forces);
  archive.number("explicit/path_stored", motion.path.stored);
  archive.number("explicit/path_elsewhere", motion.path.elsewhere);
  archive.number("explicit/growth", motion.survey.growth);
  archive.whole("explicit/survey_interval", motion.survey.interval);
  archive.whole("explicit/steps_since_survey", motion.survey.made);
  archive.parts("explicit/zones", motion.zones);
  for (std::size_t z = 0; z < motion.zones.size(); ++z) {
    const auto at = fmt::format("explicit/zone_{}/", z);
    archive.table(at + "springs", motion.zones[z].springs);
    archive.table(at + "friction_history", motion.zones[z].friction_history);
  }
  exchange(archive, "explicit/energy/", motion.energy);
}

template <class Archive> void exchange(Archive& archive, simulation::ImplicitProgress& progress) {
  exchange(archive, progress.place);
  exchange(archive, "energy/", progress.energy);
  archive.parts("energy/overlaps", progress.overlaps);
  for (std::size_t z = 0; z < progress.overlaps.size(); ++z)
    archive.numbers(fmt::format("energy/overlaps_{}", z), progress.overlaps[z]);
}

template <class Archive> void exchange(Archive& archive, Checkpoint& checkpoint) {
  auto& memento = checkpoint.memento;
  archive.text("study", checkpoint.study);
  archive.whole("mesh", checkpoint.mesh);
  archive.whole("start", checkpoint.start);
  exchange(archive, memento.counters);
  archive.number("spent/setup_seconds", checkpoint.setup_seconds);
  archive.number("spent/loop_seconds", checkpoint.loop_seconds);
  exchange(archive, memento.state);
  auto* const is_explicit_now = std::get_if<simulation::ExplicitProgress>(&memento.progress);
  simulation::ImplicitProgress of_explicit; // the file has a place and a ledger in any case
  of_explicit.place.now = memento.state.t;
  exchange(archive, is_explicit_now ? of_explicit : std::get<simulation::ImplicitProgress>(memento.progress));
  exchange(archive, checkpoint.record);
  exchange(archive, checkpoint.plausibility);
  exchange(archive, checkpoint.recorder);
  bool is_explicit = is_explicit_now != nullptr;
  archive.whole("is_explicit", is_explicit);
  if (!is_explicit)
    return;
  if (!is_explicit_now)
    memento.progress = simulation::ExplicitProgress();
  exchange(archive, std::get<simulation::ExplicitProgress>(memento.progress));
}

template <class T> std::uint32_t crc_of(std::span<const T> values, std::uint32_t before) {
  return crc(values.data(), values.size_bytes(), before);
}

std::uint32_t crc_of(const std::vector<mesh::Group>& groups, std::uint32_t sum) {
  for (const auto& group : groups) {
    sum = crc_of(std::span<const char>(group.name), sum);
    sum = crc_of(std::span(group.items), sum);
  }
  return sum;
}

} // namespace

void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint) {
  Sizer sizer;
  exchange(sizer, checkpoint);
  write_whole(path, [&](const std::filesystem::path& beside) {
    require_room(beside, sizer.bytes()); // HDF5 does not survive a full disk
    Hdf5File file(beside, Hdf5File::Access::create, seal_size);
    Writer writer(file);
    exchange(writer, checkpoint);
    file.close();
    seal(beside);
  });
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  check_seal(path);
  try {
    const Hdf5File file(path, Hdf5File::Access::read);
    Reader reader(file);
    Checkpoint checkpoint;
    exchange(reader, checkpoint);
    return checkpoint;
  } catch (const std::exception& error) { // sealed, but by a program that meant something else
    throw InputError(error.what());
  }
}

std::uint32_t fingerprint(const mesh::Mesh& mesh) {
  std::uint32_t sum = 0;
  for (const auto& point : mesh.points)
    sum = crc(point.data(), 3 * sizeof(double), sum);
  for (const auto& block : mesh.blocks) {
    sum = crc(&block.type, sizeof block.type, sum);
    sum = crc_of(std::span(block.nodes), sum);
  }
  return crc_of(mesh.cell_groups, crc_of(mesh.node_groups, sum));
}

std::uint32_t fingerprint(const step::State& state) {
  std::uint32_t sum = crc(&state.t, sizeof state.t);
  for (const auto* vector : {&state.motion.u, &state.motion.v, &state.motion.a})
    sum = crc(vector->data(), static_cast<std::size_t>(vector->size()) * sizeof(double), sum);
  const auto& remembered = state.bulk_points.values;
  return remembered.empty() ? sum : crc_of(std::span(remembered), sum); // of nothing zlib's is 0
}

} // namespace rubato::results
