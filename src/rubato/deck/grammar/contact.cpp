// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {
namespace {

/// A word, or a map of a rule's name and its order.
Forms integration() {
  std::vector<std::string> words;
  std::vector<Key> orders;
  for (const auto& rule : study::contact_integrations)
    if (rule.most_order > 0)
      orders.push_back({std::string(rule.name), std::string(rule.summary),
                        whole_number(study::from_to(1, rule.most_order))});
    else
      words.emplace_back(rule.name);
  return either(word(std::move(words)), map("where contact points stand", std::move(orders)));
}

Forms coefficients() {
  auto keys = numbers_of(study::contact_methods);
  keys.push_back({"tangential",
                  "augmentation or stiffness of friction [1/length; nodal methods force/length]; chosen at "
                  "each point when not given",
                  number(study::bounds::tangential)});
  keys.push_back({"curve", "exponential: whose law the pressures follow; abaqus when not given",
                  word_of(study::exponential_curve_words)});
  return map("coefficients of contact and friction", std::move(keys));
}

/// A loop of the status has no tolerance.
Forms level(const Forms& tolerance) {
  return either(word_of(study::iteration_words),
                map("a level of iteration",
                    {{"by", "part of every Newton iteration, or a loop around them",
                      word_of(study::iteration_words), true},
                     {"tolerance", "of the loop, relative", tolerance},
                     {"max_loops", "rounds of the loop", whole_number(study::bounds::max_loops)}}));
}

Forms iterations() {
  const auto tolerance = number(study::bounds::loop_tolerance);
  return map("how each level is solved",
             {{"geometry", "what faces what, and along which normals", level(tolerance)},
              {"friction", "the limits of friction", level(tolerance)},
              {"status", "open or closed, stick or slip", level({})}});
}

std::vector<Key> surfaces() {
  return {{"master", "group of one surface", name()},
          {"slave", "group of the other surface, which has the contact points", name()},
          {"obstacle", "rigid surface instead of a master", obstacle()},
          {"between", "two groups instead of master and slave: rubato chooses the slave", names()},
          {"self", "group of one surface that touches itself, instead of master and slave", name()},
          {"all", "true: every two surfaces of different bodies that can touch", truth()}};
}

std::vector<Key> laws() {
  return {
      {"friction", "Coulomb's coefficient, a number, an expression or a table of the place; 0 when not given",
       field_value()},
      {"method", "how contact is enforced; augmented_lagrangian when not given",
       word_of(study::contact_method_words)},
      {"friction_method", "how friction is enforced; the usual one of the method when not given",
       word_of(study::friction_method_words)},
      {"coefficients", "numbers of the methods", coefficients()},
      {"restitution",
       "part of the approach velocity that comes back, for moreau_jean and energy_momentum; 0 when not given",
       number(study::bounds::restitution)},
      {"tie", "true: the surfaces move together in every direction", truth()},
      {"bilateral", "true: points that have touched do not part any more", truth()}};
}

std::vector<Key> geometry() {
  return {
      {"interference", "overlap that is taken from every gap [length], a number, an expression or a table",
       varying(field_value())},
      {"gap", "added to every gap of the mesh [length], a number, an expression or a table",
       varying(field_value())},
      {"normal", "surface that gives the normal; master when not given",
       word_of(study::contact_normal_words)},
      {"clamped_normal", "tangents where the projection lies outside the face; projection when not given",
       word_of(study::clamped_normal_words)},
      {"smoothing", "true: normals are averaged at the nodes of their surface; nodes and gauss only",
       truth()},
      {"integration", "where contact points stand; mortar where it is possible when not given",
       integration()},
      {"projection_tolerance",
       "how far outside a master face points still face it, in reference lengths of the face; a quarter of "
       "it when not given",
       number(study::bounds::projection_tolerance)},
      {"freeze", "true: geometry of the undeformed bodies", truth()},
      {"nodal_pairs", "true: slave nodes face the nearest node of the master; nodal methods only", truth()},
      {"exclude_nodes", "slave nodes that are always open: nodes or groups", names()},
      {"initially_active", "whether all points start closed where there is no prediction", truth()},
      {"iterate", "how each level is solved", iterations()},
      {"history_force", "whether forces at the start of a step enter its equilibrium; true when not given",
       truth()}};
}

Key radius() {
  return {"radius", "[length]", number(study::bounds::radius), true};
}
Key side() {
  return {"side", "where the bodies are; outside when not given", word_of(study::obstacle_side_words)};
}

} // namespace

Forms obstacle() {
  return map("a rigid surface",
             {{"plane", "a plane; in 2D a line",
               map("a plane", {{"point", "any point of it [length]", coordinates(), true},
                               {"normal", "out of the obstacle, towards the bodies, of any length",
                                coordinates(), true}})},
              {"cylinder", "a cylinder; in plane physics a circle",
               map("a cylinder", {{"point", "a point of its axis [length]", coordinates()},
                                  {"axis", "direction of its axis, of any length; solid only", coordinates()},
                                  radius(),
                                  side()})},
              {"sphere", "a sphere",
               map("a sphere", {{"point", "its centre [length]", coordinates(), true}, radius(), side()})},
              {"move", "displacement from there; at rest when not given",
               map("a motion", components("displacement [length]", varying(number())))},
              {"rotate", "as a rigid body, by any angle; move is added", rotation()}});
}

Forms contact() {
  return named(map("a contact zone", joined(joined(surfaces(), laws()), geometry())));
}

} // namespace rubato::deck::grammar
