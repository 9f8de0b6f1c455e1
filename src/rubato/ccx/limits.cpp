// SPDX-License-Identifier: LGPL-3.0-or-later
// Keys of a study that CalculiX has no counterpart of.
#include "rubato/ccx/draft.hpp"

#include <fmt/format.h>

namespace rubato::ccx {
namespace {

void check_materials(Run& run) {
  for (const auto& material : run.study().materials)
    for (const auto& [key, value] : material.in_place)
      run.refuse(
          fmt::format("materials.{}.{}", material.name, key),
          "found a value that depends on the place; CalculiX has one number for a material, expected one");
}

void check_supports(Run& run) {
  const auto& supports = run.study().supports;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const auto path = fmt::format("supports.{}", i);
    if (supports[i].until)
      run.refuse(path + ".until",
                 "found the end of a support within a run; supports of CalculiX end with a step, "
                 "expected another run that starts from this one");
    if (supports[i].rotate && !run.nonlinear)
      run.refuse(path + ".rotate",
                 "found a rotation of bodies with small strains; expected 'strain: green_lagrange'");
  }
}

void check_time(Run& run) {
  const auto& time = run.study().time;
  if (time.arc_length)
    run.refuse("time.arc_length",
               "found steps along the path of equilibrium; CalculiX has none, expected steps by time");
  if (study::is_explicit(time.scheme))
    run.refuse("time.scheme",
               "found central_difference; explicit steps of CalculiX have lumped masses and contact of "
               "another kind, expected an implicit scheme");
  if (time.start == study::StartKind::at_rest_unloaded)
    add_note(run.draft,
             "time.start: CalculiX finds the first accelerations from equilibrium, as with 'consistent'; "
             "the first step differs");
}

} // namespace

void check_limits(Run& run) {
  const auto& study = run.study();
  if (study.base_motion)
    run.refuse("base_motion",
               "found a moving base; CalculiX has it in modal steps alone, expected supports that move");
  if (!study.preload.empty())
    run.refuse("preload",
               "found a preload, which cuts a body through; expected none: the mesh that is written has no "
               "cut");
  if (study.modal_damping && !run.modes)
    run.refuse("modal_damping",
               "found damping of modes; steps of CalculiX in time have none, expected 'rayleigh'");
  check_materials(run);
  if (run.modes)
    return;
  check_supports(run);
  check_time(run);
}

} // namespace rubato::ccx
