// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/modes/modal_study.hpp"

#include "rubato/core/error.hpp"

#include <utility>
#include <vector>

namespace rubato::modes {
namespace {

void require_densities(const study::Study& study) {
  std::vector<Fault> faults;
  for (const auto& material : study.materials)
    if (!material.density && !material.in_place.contains("density"))
      faults.push_back(
          fault_at("materials." + material.name, "'density' is missing: vibrations move masses"));
  if (!faults.empty())
    throw InputError(std::move(faults));
}

/// The surfaces of a zone, their distance, and its friction, of which modes warn. Its law plays no part.
study::ContactZone geometry_of(const study::ContactZone& asked) {
  study::ContactZone zone;
  zone.name = asked.name;
  zone.master = asked.master;
  zone.obstacle = asked.obstacle;
  zone.slave = asked.slave;
  zone.between = asked.between;
  zone.self = asked.self;
  zone.all = asked.all;
  zone.interference = asked.interference;
  zone.gap = asked.gap;
  zone.tie = asked.tie;
  zone.normal = asked.normal;
  zone.clamped_normal = asked.clamped_normal;
  zone.smoothing = asked.smoothing;
  zone.nodal_pairs = asked.nodal_pairs;
  zone.integration = asked.integration;
  zone.exclude_nodes = asked.exclude_nodes;
  zone.friction = asked.friction;
  zone.friction_in_place = asked.friction_in_place;
  return zone;
}

/// Files in CalculiX's layout, which have shapes too.
study::FieldOutput outputs_of(const study::FieldOutput& asked) {
  study::FieldOutput output;
  output.frd = asked.frd;
  output.frd_binary = asked.frd_binary;
  output.step = asked.step;
  output.only = asked.only;
  output.also = asked.also;
  output.tables = asked.tables;
  return output;
}

} // namespace

study::Study modal_study(const study::Study& asked) {
  require_densities(asked);
  study::Study study = asked;
  study.loads.clear();
  study.modal_damping.reset();
  study.temperatures.clear(); // strains without stress leave stiffness and mass as they are
  for (auto& connector : study.connectors) {
    if (connector.force && !connector.rotates) // a force at rest stiffens those that rotate
      connector.stiffness = slope_at(*std::exchange(connector.force, std::nullopt), 0);
    connector.damper.reset();
  }
  study.initial.clear();
  study.probes.clear();
  study.checks.clear();
  for (auto& zone : study.contact)
    zone = geometry_of(zone);
  study.time = {};
  study.time.scheme = study::SchemeKind::newmark;
  study.time.contact_mass = study::ContactMass::consistent;
  study.time.begin = asked.time.begin;
  study.time.step = 1;
  study.time.end = asked.time.begin + 1;
  study.newton = {};
  study.solver = study::Solver::automatic;
  study.fields = outputs_of(asked.fields);
  study.checkpoint = {};
  return study;
}

} // namespace rubato::modes
