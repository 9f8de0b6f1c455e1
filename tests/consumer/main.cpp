// SPDX-License-Identifier: LGPL-3.0-or-later
// A program of its own against the installed package: a bar that is pulled, from the study to its length.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <rubato/core/error.hpp>
#include <rubato/model/build_model.hpp>
#include <rubato/run/time_loop.hpp>

namespace {

using namespace rubato;

study::Study pulled_bar() {
  study::Study study;
  study.name = "bar";
  study.physics = study::Physics::plane_stress;
  auto& bar = study.mesh.bodies.emplace_back();
  bar.name = "bar";
  bar.dimension = 2;
  bar.to = {2, 1, 0};
  bar.divisions = {4, 2, 1};
  bar.cells = CellType::quad4;
  bar.sides = {{"left", "held"}, {"right", "end"}, {"bottom", "floor"}};
  auto& steel = study.materials.emplace_back();
  steel.name = "steel";
  steel.young = 200;
  steel.poisson = 0.3;
  study.supports = {{"held", {study::Amplitude{}, {}, {}}},
                    {"floor", {std::nullopt, study::Amplitude{}, {}}}};
  study.loads = {{study::LoadKind::surface_force, "end", {1, 0, 0}, ""}};
  study.time.scheme = study::SchemeKind::static_steps;
  study.time.contact_mass = study::ContactMass::consistent;
  study.time.step = study.time.end = 1;
  return study;
}

/// The length of the bar grows by F l / (E A) = 2 / 200.
bool stretches() {
  const auto folder = std::filesystem::temp_directory_path() / "rubato_consumer";
  const auto result = run::run_study(pulled_bar(), folder, {});
  std::filesystem::remove_all(folder);
  return result.status == run::Status::complete &&
         std::abs(result.end.motion.u.maxCoeff() - 2.0 / 200) < 1e-12;
}

/// A study that a program builds meets the rules of a deck.
bool is_refused() {
  auto study = pulled_bar();
  study.materials[0].young = -1;
  try {
    model::build_model(study);
    return false;
  } catch (const InputError& error) {
    return error.faults().front().path == "materials.steel.young";
  }
}

} // namespace

int main() {
  const bool works = stretches() && is_refused();
  std::puts(works ? "rubato works as installed" : "rubato does not work as installed");
  return works ? 0 : 1;
}
