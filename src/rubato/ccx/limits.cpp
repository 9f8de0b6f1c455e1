// SPDX-License-Identifier: LGPL-3.0-or-later
// Keys of a study that CalculiX has no counterpart of.
#include "rubato/ccx/draft.hpp"

#include <fmt/format.h>

#include <algorithm>

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

bool has_linear_cells(const model::Model& model) {
  return std::ranges::any_of(model.bulk.cells, [&](mesh::CellIndex cell) {
    return cell::topology(model.mesh.type_of(cell)).order == 1;
  });
}

/// CalculiX makes solids of elements of the plane, and equations hold their thickness.
void check_plane(Run& run) {
  if (run.study().physics == study::Physics::plane_stress)
    add_note(run.draft,
             "plane stress: elements of CalculiX are solids whose thickness changes alike all over; they are "
             "stiffer where they are thick (3 % of a bar as thick as it is high) or linear (0.4 to 3 %)");
  if (run.modes || run.is_static())
    return;
  if (has_linear_cells(run.model))
    run.refuse("time.scheme",
               "found motions of linear cells in the plane, which CalculiX computes with errors of 5 to 100 "
               "%; expected 'convert: quadratic' of the mesh, or physics: solid");
  if (run.model.initial.velocity.cwiseAbs().maxCoeff() > 0)
    run.refuse(
        "initial",
        "found velocities in the plane, which CalculiX gives to a part of the nodes of its solids alone; "
        "expected physics: solid");
}

void check_motion(Run& run) {
  if (run.modes || run.is_static())
    return;
  if (run.model.initial.displacement.cwiseAbs().maxCoeff() > 0)
    run.refuse("initial",
               "found displacements at the begin of a motion, from which CalculiX finds other accelerations; "
               "expected velocities alone, or a start from a static run");
  if (run.is_plane() && run.study().time.scheme != study::SchemeKind::hht)
    add_note(run.draft,
             "time.scheme: without numerical damping high modes of elements of the plane ring in CalculiX: "
             "sudden loads differ by up to 8 %, with hht by 0.1 %");
  const double begin = run.study().time.begin;
  for (const auto& prescribed : run.model.reduction.prescribed())
    if (run.model.reduction.displacement(prescribed, begin) != 0)
      return add_note(run.draft,
                      "supports that jump at the begin of a motion differ: by 1 % with hht, by 10 % without "
                      "numerical damping");
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
  if (run.is_plane())
    check_plane(run);
  check_motion(run);
  if (run.modes)
    return;
  check_supports(run);
  check_time(run);
}

} // namespace rubato::ccx
