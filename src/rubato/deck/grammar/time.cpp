// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {
namespace {

Forms start() {
  return either(word_of(study::start_words),
                map("a start from another run", {{"from", "earlier run of the deck", name(), true}}));
}

} // namespace

Forms time() {
  const auto keys =
      joined({{"scheme", "time scheme; moreau_jean when not given", word_of(study::scheme_words)}},
             numbers_of(study::schemes));
  return map(
      "the course of time",
      joined(
          keys,
          {{"record", "central_difference: time between results [time]", number(study::bounds::record)},
           {"mass_scaling",
            "central_difference: cells that make steps short get more mass; none when not given",
            map("mass scaling",
                {{"step", "that every cell shall allow [time]", number(study::bounds::scaled_step), true}})},
           {"contact_mass",
            "mass of the slave surfaces; redistributed with moreau_jean and energy_momentum when not given",
            word_of(study::contact_mass_words)},
           {"begin", "first instant [time]; 0 when not given", number()},
           {"step", "length of a step [time]; auto with central_difference",
            either(number(study::bounds::step), word({std::string(study::automatic_step)}))},
           {"end", "last instant [time]", number()},
           {"instants", "all instants after begin, ascending, instead of step and end [time]",
            list(number(), 1)},
           {"max_step",
            "nonlinear bodies: steps grow and shrink with their iterations, up to this one [time]",
            number(study::bounds::max_step)},
           {"max_plastic_step", "nonlinear bodies: steps in which plastic strain grows by more are cut",
            number(study::bounds::max_plastic_step)},
           {"arc_length",
            "static, nonlinear bodies: loads without a function get a factor by how far bodies move",
            map("path of equilibrium",
                {{"length", "of the whole run, root mean square over the nodes [length]",
                  number(study::bounds::arc_length), true},
                 {"on", "group whose nodes are measured; all when not given", name()}})},
           {"start", "how the run begins; consistent when not given", start()},
           {"on_failure", "what is done with a step that fails",
            map("cutting of steps", {{"cut", "parts a failed step is cut into; 2 when not given",
                                      whole_number(study::bounds::cut_parts)},
                                     {"levels", "how often in a row; 12 when not given",
                                      whole_number(study::bounds::cut_levels)}})}}));
}

Forms newton() {
  return map(
      "Newton's method",
      {{"max_iterations", "of one solve; 40 when not given", whole_number(study::bounds::max_iterations)},
       {"residual", "largest residual force over the largest force; 1e-8 when not given",
        number(study::bounds::residual)},
       {"tangent", "when nonlinear bodies have their matrix factored anew; auto when not given",
        word_of(study::tangent_words)}});
}

} // namespace rubato::deck::grammar
