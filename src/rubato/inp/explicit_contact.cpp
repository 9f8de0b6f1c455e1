// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact in files with explicit steps.
#include "rubato/inp/steps.hpp"
#include "rubato/study/contact_methods.hpp"

#include <fmt/format.h>

namespace rubato::inp {
namespace {

/// Explicit steps with massless contact: slave surfaces have no mass, and contact is exact.
void take_massless_contact(Reading& reading, study::Study& study, const Step& step) {
  study.time.scheme = study::SchemeKind::moreau_jean;
  study.time.contact_mass = study::ContactMass::redistributed;
  study.time.step = step.time.step > 0 ? step.time.step : step.time.record;
  study.time.record = 0;
  for (auto& zone : study.contact)
    if (!zone.tie) { // a law of velocities has no springs
      zone.method = study::ContactMethod::augmented_lagrangian;
      zone.friction_method = study::FrictionMethod::augmented_lagrangian;
    }
  note(reading, step.procedure_at,
       fmt::format("explicit steps with massless contact are Moreau-Jean steps of {}: velocities jump where "
                   "bodies hit, and the inside of bodies is integrated implicitly",
                   study.time.step));
}

} // namespace

void fit_contact(Reading& reading, study::Study& study, const History& history, const Step& step) {
  if (reading.massless_contact && step.procedure == Procedure::explicit_steps)
    return take_massless_contact(reading, study, step);
  for (auto& zone : study.contact) {
    if (zone.tie || !history.explicit_steps)
      continue;
    if (zone.integration.by != study::ContactIntegration::nodes || zone.freeze)
      note(reading, step.procedure_at,
           "contact of files with explicit steps is on the nodes, with large sliding");
    zone.integration = {study::ContactIntegration::nodes, 0};
    zone.freeze = false;
    if (step.procedure != Procedure::explicit_steps)
      continue;
    if (study::entry_of(zone.method).exact) {
      zone.method = study::ContactMethod::penalty;
      note(reading, step.procedure_at, "contact of explicit steps is by penalty on the nodes");
    }
    zone.friction_method = study::FrictionMethod::penalty;
  }
}

} // namespace rubato::inp
