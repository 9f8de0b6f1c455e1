// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {
namespace {

Forms whole() {
  return map("a deck",
             {{"title", "free text, repeated in the results", text()},
              {"units", "free text that names the units; SI when not given", text()},
              {"physics", "3D (solid), or what a 2D mesh stands for", word_of(study::physics_words), true},
              {"thickness", "of plane_stress and plane_strain [length]; 1 when not given",
               number(study::bounds::thickness)},
              {"mesh", "a mesh file, or bodies that are generated", mesh(), true},
              {"materials", "materials by name", materials(), true},
              {"functions", "functions of time by name", functions()},
              {"supports", "displacements that are held or imposed", supports()},
              {"base_motion", "how the ground moves that everything stands on", base_motion()},
              {"preload", "bolts that are tightened, by name", preload()},
              {"relations", "displacements that depend on one another, by name", relations()},
              {"springs", "springs between nodes and the ground", springs()},
              {"connectors", "springs and dashpots between places, or to the ground", connectors()},
              {"masses", "masses at nodes", masses()},
              {"loads", "forces, pressures and gravity", loads()},
              {"temperature", "temperatures of the bodies, by which they expand", temperatures()},
              {"initial", "displacement and velocity at the first instant", initial()},
              {"modal_damping", "damping of the lowest natural modes", modal_damping()},
              {"contact", "contact zones by name", contact()},
              {"time", "scheme and instants", time(), true},
              {"newton", "when an iteration ends", newton()},
              {"solver", "how systems are solved; auto when not given", word_of(study::solver_words)},
              {"probes", "histories by name, written at every step", probes()},
              {"fields", "whole fields at chosen instants", fields()},
              {"checkpoint", "when the state is stored that --resume continues from", checkpoint()},
              {"checks", "numbers that must come out", checks()}});
}

} // namespace

const Forms& deck() {
  static const auto forms = whole();
  return forms;
}

const Forms& runs() {
  static const auto forms = named(deck());
  return forms;
}

} // namespace rubato::deck::grammar
