// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/step/report.hpp"

#include <fmt/format.h>

#include "support/scratch_folder.hpp"
#include "verification/solids_sweep.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::verification {
namespace {

/// Tries a step may cost, on average.
constexpr int patience = 10;

study::Study study_of(const SolidVariant& variant, const std::vector<deck::Setting>& changes) {
  return deck::parse_deck(variant.deck, fmt::format("{}.yaml", variant.number), changes).runs.front();
}

mesh::Mesh mesh_of(const SolidVariant& variant, study::Study& study) {
  auto mesh = model::load_mesh(study.mesh);
  study.mesh.groups.clear(); // made already
  for (auto& point : mesh.points) {
    const auto [x, y] = placed(variant.shape, point.x(), point.y());
    point.x() = x;
    point.y() = y;
  }
  return mesh;
}

double size_of(const mesh::Mesh& mesh) {
  double size = 0;
  for (const auto& point : mesh.points)
    size = std::max(size, (point - mesh.points.front()).norm());
  return size;
}

bool is_exact(const study::ContactZone& zone) {
  return zone.method == study::ContactMethod::augmented_lagrangian ||
         zone.method == study::ContactMethod::nodal_lagrange;
}

/// What contact must not do in the end. A law of velocities leaves the gaps that geometry opens or closes
/// within a step.
void note_contact(const study::Study& study, double size, SolidSurvival& survival) {
  double most = 0;
  double pull = 0;
  const auto& zones = survival.result.end.zones;
  for (std::size_t z = 0; z < zones.size(); ++z)
    for (const auto& outcome : zones[z].outcomes) {
      most = std::max(most, outcome.pressure);
      pull = std::max(pull, -outcome.pressure);
      if (study.time.scheme != study::SchemeKind::moreau_jean && is_exact(study.contact[z]) &&
          std::isfinite(outcome.gap))
        survival.penetration = std::max(survival.penetration, -outcome.gap / size);
    }
  survival.tension = most > 0 ? pull / most : pull;
}

void note_energy(const std::filesystem::path& file, SolidSurvival& survival) {
  const auto& energy = survival.result.energy;
  if (energy.largest == 0)
    return;
  survival.balance = energy.largest_balance / energy.largest;
  const auto table = results::read_csv(file);
  const auto plastic = static_cast<std::size_t>(table.column("plastic"));
  if (!table.rows.empty())
    survival.plastic = table.rows.back()[plastic] / energy.largest;
}

run::Watch watch_of(const SolidVariant& variant, int& attempts, SolidSurvival& survival) {
  run::Watch watch;
  watch.progress = [&](const run::Progress& progress) {
    ++attempts;
    if (progress.report == nullptr)
      return;
    survival.bulk_iterations += progress.report->bulk_iterations;
    survival.factorisations += progress.report->factorisations;
  };
  watch.stop = [&] { return attempts > patience * variant.steps; };
  return watch;
}

} // namespace

SolidSurvival survive(const SolidVariant& variant, const std::vector<deck::Setting>& changes) {
  const test::ScratchFolder folder;
  SolidSurvival survival;
  try {
    auto study = study_of(variant, changes);
    auto mesh = mesh_of(variant, study);
    const double size = size_of(mesh);
    int attempts = 0;
    const auto watch = watch_of(variant, attempts, survival);
    survival.result = run::run_study(study, std::move(mesh), folder / "run", watch);
    if (survival.result.status != run::Status::complete)
      survival.failure = survival.result.message;
    if (survival.result.status == run::Status::interrupted)
      survival.failure = fmt::format("given up after {} attempts, {}", attempts, survival.failure);
    note_energy(folder / "run/energy.csv", survival);
    note_contact(study, size, survival);
  } catch (const std::exception& error) {
    survival.failure = error.what();
  }
  return survival;
}

} // namespace rubato::verification
