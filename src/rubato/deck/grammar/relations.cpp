// SPDX-License-Identifier: LGPL-3.0-or-later
// Relations between displacements.
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {
namespace {

Forms axes() {
  const auto axis = word({study::axis_words.begin(), study::axis_words.end()});
  return either(axis, list(axis, 1));
}

Forms equation() {
  return map(
      "coefficients times displacements add up to a value",
      {{"terms", "nodes and the coefficients of their displacements",
        list(map("a node in an equation", joined({{"on", "a node, or a group of one", name(), true}},
                                                 components("coefficient of the displacement", number()))),
             1),
        true},
       {"value", "of the sum; 0 when not given", varying(field_value())}});
}

Forms equal() {
  return map("the nodes of a group have the same displacement",
             {{"on", "group of nodes or cells", name(), true},
              {"in", "components that are the same; all when not given", axes()}});
}

Forms pairs() {
  return map("the nodes of two groups move alike, each with its partner",
             {{"on", "group of nodes or cells", name(), true},
              {"with", "group of as many nodes in the same arrangement, shifted", name(), true},
              {"in", "components; all when not given", axes()},
              {"difference", "displacement of 'on' less that of 'with'; 0 when not given [length]",
               map("differences of displacements",
                   components("difference of displacements [length]", varying(field_value())))}});
}

Forms reference(const std::string& meaning) {
  return map(meaning, {{"on", "group of nodes or cells", name(), true},
                       {"at", "place of the reference; the mean of the nodes when not given [length]",
                        coordinates()}});
}

Forms embedded() {
  return map("nodes, or a reference, move with the cells they lie in",
             {{"on", "group of nodes or cells; each node follows the cell it lies in", name()},
              {"at", "instead of 'on': a place, to which the relation's name refers [length]", coordinates()},
              {"in", "group of the cells; all when not given", name()}});
}

Forms form_of(study::RelationKind kind) {
  switch (kind) {
  case study::RelationKind::equation:
    return equation();
  case study::RelationKind::equal:
    return equal();
  case study::RelationKind::pairs:
    return pairs();
  case study::RelationKind::rigid:
    return reference("a group that moves as a rigid body, by small rotations");
  case study::RelationKind::distributed:
    return reference("a reference that moves as a group does in the mean");
  case study::RelationKind::embedded:
    return embedded();
  }
  return {};
}

std::string meaning_of(study::RelationKind kind) {
  switch (kind) {
  case study::RelationKind::equation:
    return "an equation between displacements";
  case study::RelationKind::equal:
    return "the nodes of a group have the same displacement";
  case study::RelationKind::pairs:
    return "two groups node by node, as opposite faces of a periodic cell";
  case study::RelationKind::rigid:
    return "a rigid body, whose reference can be held, moved and loaded by the relation's name";
  case study::RelationKind::distributed:
    return "a reference that follows a group and hands its forces and moments on to it, without stiffening "
           "it";
  case study::RelationKind::embedded:
    return "nodes within cells of another body, or a place in a cell that can be held, moved and loaded by "
           "the "
           "relation's name";
  }
  return {};
}

} // namespace

Forms relations() {
  std::vector<Key> kinds;
  kinds.reserve(study::relation_words.size());
  for (const auto& kind : study::relation_words)
    kinds.push_back({std::string(kind.text), meaning_of(kind.value), form_of(kind.value)});
  auto entry = map("one relation", std::move(kinds));
  entry.front().least = 1;
  entry.front().most = 1;
  return named(std::move(entry));
}

} // namespace rubato::deck::grammar
