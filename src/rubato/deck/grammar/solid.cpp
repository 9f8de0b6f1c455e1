// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials, supports, loads, springs, and how the bodies begin.
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {
namespace {

/// What each kind of load is, and its unit.
std::string meaning_of(study::LoadKind kind) {
  switch (kind) {
  case study::LoadKind::nodal_force:
    return "force on each node of the group, or on a reference [force]";
  case study::LoadKind::moment:
    return "moment on the reference of a rigid or distributed relation [force · length]";
  case study::LoadKind::line_force:
    return "force on edges [force/length]";
  case study::LoadKind::surface_force:
    return "force on faces, in 2D on edges times the thickness [force/length²]";
  case study::LoadKind::pressure:
    return "pressure on faces, positive pushes into the body [force/length²]";
  case study::LoadKind::gravity:
    return "acceleration of the mass [length/time²]";
  }
  return {};
}

Forms load(study::LoadKind kind) {
  const auto everywhere = kind == study::LoadKind::gravity;
  std::vector<Key> keys{
      {"on", everywhere ? "group of cells; every cell when not given" : "group", name(), !everywhere}};
  if (kind == study::LoadKind::pressure)
    keys = joined(
        std::move(keys),
        {{"value", "pressure [force/length²], a number, an expression or a table", field_value(), true},
         {"follower", "whether it turns and grows with the faces; false when not given", truth()}});
  else
    keys =
        joined(std::move(keys), components("component, a number, an expression or a table,", field_value()));
  keys.push_back({"function", "name of a function of time that multiplies it", name()});
  return map(meaning_of(kind), std::move(keys));
}

Forms connector_law(const std::string& title, const std::string& key, const std::string& meaning) {
  return map(title, {{key, meaning + ", ascending", list(number(), 2), true},
                     {"forces", "a force for each, > 0 against it [force]", list(number(), 2), true},
                     {"outside", "beyond both ends; linear when not given", word_of(study::outside_words)}});
}

/// Numbers that no law takes in place are numbers alone.
std::vector<Key> numbers_of_laws() {
  std::vector<Key> keys;
  for (const auto& law : study::material_laws)
    for (const auto& entry : law.numbers)
      add_number(keys, entry.key, entry.meaning, entry.range, law.in_place ? field_value : number);
  return keys;
}

} // namespace

Forms materials() {
  auto keys = joined(
      {{"law", "what gives stresses from strains; elastic when not given", word_of(study::law_words)},
       {"density", "[mass/length³]; not needed by the scheme static", field_value(study::bounds::density)}},
      joined(numbers_of_laws(), material_words()));
  keys.push_back(
      {"axes", "of orthotropy where they turn with the place, before the angles turn them",
       map("axes that turn with the place",
           {{"cylindrical", "x' away from a line, y' around it, z' along it",
             map("cylindrical axes",
                 {{"point", "of the line, in the plane where it stands [length]", coordinates(), true},
                  {"direction", "of the line, along z'; in the plane none", coordinates()}}),
             true}})});
  keys.push_back({"rayleigh", "damping matrix from stiffness and mass",
                  map("Rayleigh damping",
                      {{"stiffness", "factor of the stiffness [time]", number(study::bounds::rayleigh)},
                       {"mass", "factor of the mass [1/time]", number(study::bounds::rayleigh)}})});
  keys.push_back({"damping", "Rayleigh damping by its ratios at two frequencies, instead of 'rayleigh'",
                  map("damping ratios", {{"ratio", "two damping ratios, parts of critical damping",
                                          list(number(study::bounds::damping_ratio), 2, 2), true},
                                         {"at", "the frequencies at which they hold [1/time]",
                                          list(number(study::bounds::frequency), 2, 2), true}})});
  keys.push_back({"expansion",
                  "thermal expansion [1/temperature], or three along x', y', z' of an orthotropic material",
                  either(number(), list(number(), 3, 3))});
  keys.push_back({"reference_temperature", "at which nothing is expanded; 0 when not given", number()});
  keys.push_back({"cells", "all, or groups of cells", names()});
  return named(map("a material", std::move(keys)));
}

Forms supports() {
  std::vector<std::string> axes(study::axis_words.begin(), study::axis_words.end());
  const auto axis = word(std::move(axes));
  auto keys = joined({{"on", "group of nodes or cells, or a reference", name(), true},
                      {"fix", "axes held at 0", either(axis, list(axis))}},
                     components("imposed displacement [length]", motion(field_value())));
  keys.push_back({"along", "a direction across the axes, or normal: that of the group's faces",
                  either(word({std::string(study::normal_word)}), coordinates())});
  keys.push_back(
      {"value", "with along: the displacement along it; 0 when not given [length]", motion(field_value())});
  keys.push_back(
      {"turn", "rotations of a reference, small [radians]",
       map("rotations of a reference",
           components("rotation of a reference [radians], about the axis", motion(field_value())))});
  keys.push_back(
      {"rotate", "every node of a group as a rigid body, by any angle; x, y and z are added", rotation()});
  keys.push_back(
      {"until", "instant at which it lets go; the end of the run when not given [time]", number()});
  return list(map("a support", std::move(keys)));
}

Forms rotation() {
  return map("a rotation about a line that stays where it is",
             {{"about", "a place on the line; in the plane the point [length]", coordinates(), true},
              {"axis", "direction of the line; in the plane none", coordinates()},
              {"angle", "by the right-hand rule [radians], a number or an expression of t",
               motion(expression()), true}});
}

Forms base_motion() {
  auto keys = components("motion of the base, a number or an expression of t,", motion(expression()));
  keys.push_back({"frame", "what displacements are counted from; relative when not given",
                  word_of(study::base_frame_words)});
  return map("a motion of the ground", std::move(keys));
}

Forms loads() {
  std::vector<Key> kinds;
  kinds.reserve(study::load_words.size());
  for (const auto& kind : study::load_words)
    kinds.push_back({std::string(kind.text), meaning_of(kind.value), load(kind.value)});
  auto entry = map("one load", std::move(kinds));
  entry.front().least = 1;
  entry.front().most = 1;
  return list(std::move(entry));
}

Forms temperatures() {
  return list(map("the temperature of nodes; where entries share nodes, the last one counts",
                  {{"on", "group of nodes or cells, a node, or all", name(), true},
                   {"value", "[temperature]", field_value(), true},
                   {"function", "of time, which multiplies it; 1 when not given", name()}}));
}

Forms modal_damping() {
  const auto ratio = number(study::bounds::damping_ratio);
  return map("damping of the lowest natural modes, as they are without contact",
             {{"modes", "how many of the lowest ones", whole_number(study::bounds::damped_modes), true},
              {"ratio", "part of critical damping, of all modes or a list of one each",
               either(ratio, list(ratio, 1)), true}});
}

Forms springs() {
  return list(map(
      "springs between nodes and the ground",
      joined({{"on", "group of nodes or cells, or a node", name(), true}},
             components("stiffness of each node's spring [force/length]", number(study::bounds::spring)))));
}

Forms connectors() {
  return list(map(
      "a spring and a dashpot side by side",
      {{"on", "a node or a reference; without 'to' also a group, node by node", name(), true},
       {"to", "a node or a reference; the ground when not given", name()},
       {"along", "direction; from 'on' to 'to' when not given", coordinates()},
       {"rotates", "whether it acts along the current line between its ends; false when not given", truth()},
       {"anchor", "place of the end at the ground where it rotates [length]", coordinates()},
       {"stiffness", "of the spring [force/length]; 0 when not given", number(study::bounds::connector)},
       {"damping", "of the dashpot [force · time/length]; 0 when not given",
        number(study::bounds::connector)},
       {"force", "of the spring by a table, instead of 'stiffness'",
        connector_law("a spring by a table", "elongations",
                      "displacement of 'to' less that of 'on', to the ground that of 'on' [length]")},
       {"damper", "of the dashpot by a table, instead of 'damping'",
        connector_law("a dashpot by a table", "rates", "rates of the elongation [length/time]")}}));
}

Forms masses() {
  return list(map(
      "masses at nodes, or of a reference",
      {{"on", "group of nodes or cells, a node, or a reference", name(), true},
       {"mass", "of each node, or of the reference [mass]", number(study::bounds::point_mass), true},
       {"inertia", "moments of inertia of a reference about x, y and z; 0 when not given [mass · length²]",
        list(number(study::bounds::inertia), 3, 3)}}));
}

Forms initial() {
  return list(map("how a part of the bodies begins",
                  {{"on", "group of nodes or cells, a node, or all", name(), true},
                   {"displacement", "at the first instant [length]",
                    map("an initial displacement", components("displacement [length]", number()))},
                   {"velocity", "at the first instant [length/time]",
                    map("an initial velocity", components("velocity [length/time]", number()))}}));
}

} // namespace rubato::deck::grammar
