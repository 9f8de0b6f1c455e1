// SPDX-License-Identifier: LGPL-3.0-or-later
// Probes, fields, checkpoints and checks.
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/table_words.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {

std::vector<Key> cut() {
  return {{"point", "of the plane of the cut; moments are about it [length]", coordinates(), true},
          {"normal", "of the plane, out of the part that the forces act on", coordinates(), true},
          {"cells", "the group of cells that is cut; all when not given", name()}};
}

namespace {

std::vector<Key> section() {
  return joined(cut(),
                {{"on", "the group whose nodes are the cut; the plane itself when not given", name()}});
}

} // namespace

Forms probes() {
  return named(map(
      "a history of nodes",
      {{"node", "a node, or a group of one node", name()},
       {"point", "coordinates: the nearest node [length]", coordinates()},
       {"on", "a group, with 'take'", name()},
       {"take", "the value over the nodes or cells of 'on', for each component; of forces sum when not given",
        word_of(study::probe_take_words)},
       {"field", "displacement when not given", word_of(study::probe_field_words)},
       {"about", "with a sum of forces: their moment about this place, too [length]", coordinates()},
       {"place", "of stress, strain and what else cells have; nodes when not given",
        word_of(study::probe_place_words)},
       {"section", "a cut through bodies: force and moment that they transmit there",
        map("a cut, and what is cut", section())},
       {"contact", "the force of a contact zone's master on its slave, and its moment",
        map("a contact zone and a point", {{"zone", "name of the contact zone", name(), true},
                                           {"about", "moments are about it [length]", coordinates(), true}})},
       {"minus", "two other probes: the first minus the second", list(name(), 2, 2)}}));
}

Forms preload() {
  return named(
      map("a bolt that is tightened",
          {{"cut", "the plane that cuts it", map("a cut, and what is cut", cut()), true},
           {"force", "tension that the cut transmits [force]", number()},
           {"displacement", "instead: shortening of the bolt at the cut, > 0 tightens [length]", number()},
           {"function", "name of a function of time that multiplies it", name()},
           {"lock", "instant from which on the shortening stays as it is [time]", number()}}));
}

Forms table() {
  const auto quantity = word(study::all_table_words());
  return map(
      "a table of tables.dat, in the layout of CalculiX's .dat file",
      {{"nodes", "a group of nodes or a node; 'all'", name()},
       {"cells", "instead: a group of cells; 'all'", name()},
       {"faces", "instead: a group of faces", name()},
       {"zones", "instead: a contact zone; 'all'", name()},
       {"quantities",
        "what it lists; nodes: U, V, A, RF, NT, UR, RM; cells: S, E, ME, PEEQ, ENER, ELSE, ELKE, EVOL, "
        "COORD; faces: "
        "SOF, "
        "SOM, SOAREA; zones: CDIS, CSTR, CNUM, CF, CFN, CFS",
        either(quantity, list(quantity, 1)), true},
       {"label", "name in its heading; that of the group when not given", text()},
       {"totals", "sums of RF, ELSE, ELKE and EVOL; none when not given", word_of(study::table_totals_words)},
       {"every", "every n-th step, and the last one; 1 when not given, 0 for none",
        whole_number(study::bounds::every)}});
}

Forms fields() {
  const auto format = word({study::field_formats.begin(), study::field_formats.end()});
  const auto field = word(study::stored_field_names());
  return map(
      "whole fields that are stored",
      {{"formats",
        "vtu (ParaView), med (Salome, and comparisons), vtkhdf (ParaView, one file), frd "
        "(CalculiX GraphiX, PrePoMax); vtu when not given",
        either(format, list(format))},
       {"only", "the fields that are written, instead of the usual ones", either(field, list(field, 1))},
       {"also", "fields that are written beside the usual ones", either(field, list(field))},
       {"digits", "that vtu and vtkhdf keep of values; 9 when not given",
        whole_number(study::bounds::digits)},
       {"at", "instants, ascending [time]", list(number())},
       {"every", "and every n-th step, 0 for none", whole_number(study::bounds::every)},
       {"last", "and the last step; true when not given", truth()},
       {"frd", "how .frd files have numbers; ascii when not given", word_of(study::frd_words)},
       {"step", "number of the step in .frd files; 1 when not given",
        whole_number(study::bounds::step_number)},
       {"tables", "tables of nodes, cells, faces and contact in tables.dat", list(table())}});
}

Forms checkpoint() {
  return map("when the state is stored that --resume continues from",
             {{"every", "every n-th step, of an explicit run every n-th record; 0 for none",
               whole_number(study::bounds::every)},
              {"at", "instants, ascending [time]", list(number())},
              {"last", "and when the run ends; true when not given", truth()}});
}

Forms checks() {
  return list(map(
      "a number that must come out",
      {{"probe", "a probe and its component, tip.y; a scalar's name alone", name()},
       {"energy", "a column of the energy ledger, friction", name()},
       {"resultant", "a contact zone and a column of its resultants, interface.normal", name()},
       {"field", "a field at the nodes and a component, displacement.y; with 'run'", name()},
       {"on", "a group or a node where the field is compared; every node when not given", name()},
       {"at", "instant [time]", number()},
       {"over", "instead of an instant: of the whole history", word_of(study::checked_time_words)},
       {"reference", "the number", number()},
       {"run", "earlier run of the deck whose value is subtracted", name()},
       {"tolerance", "largest permitted deviation", number(study::bounds::check_tolerance), true},
       {"kind", "what the tolerance is; relative when not given", word_of(study::check_kind_words)},
       {"source", "where the number comes from; external when not given", word_of(study::check_source_words)},
       {"note", "more about the source", text()}}));
}

} // namespace rubato::deck::grammar
