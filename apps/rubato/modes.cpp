// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/modes/modes.hpp"

#include "rubato/core/naming.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/modes/modal_study.hpp"
#include "rubato/results/mode_files.hpp"
#include "rubato/results/mode_tables.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "read_deck.hpp"
#include "show_modes.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace rubato::app {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using rubato::modes::Contact;
using rubato::modes::Modes;

Contact contact_named(const std::string& name) {
  static const std::map<std::string, Contact> words{
      {"open", Contact::open}, {"stuck", Contact::stuck}, {"sliding", Contact::sliding}};
  const auto found = words.find(name);
  if (found == words.end())
    throw InputError(fmt::format("--contact: found {}, expected open, stuck or sliding", shown(name)));
  return found->second;
}

std::filesystem::path modes_output_of(const ModesArguments& arguments) {
  if (!arguments.output.empty())
    return arguments.output;
  return is_standard_input(arguments.deck) ? "stdin" : arguments.deck.stem();
}

/// Without --only the first run alone: runs of a deck mostly differ in what modes do not depend on.
bool is_asked(const ModesArguments& arguments, const deck::Deck& deck, const study::Study& study) {
  if (arguments.only.empty())
    return &study == &deck.runs.front();
  return std::ranges::find(arguments.only, study.name) != arguments.only.end();
}

void print_heading(const Modes& modes) {
  auto line = fmt::format("{:>5} {:>20} {:>14}", "mode", "frequency [1/time]", "period [time]");
  for (const auto* sum : {"", "sum "})
    for (const int direction : modes.directions)
      line +=
          fmt::format(" {:>7}", sum + std::string(study::axis_words.at(static_cast<std::size_t>(direction))));
  fmt::print("{}  {:>8}\n", line, "residual");
}

void print_table(const Modes& modes) {
  fmt::print("effective masses are parts of the whole mass, {:.6g}\n", modes.mass);
  print_heading(modes);
  VectorXd sum = VectorXd::Zero(modes.effective_masses.cols());
  for (Index k = 0; k < modes.frequencies.size(); ++k) {
    const double frequency = modes.frequencies[k];
    auto line = fmt::format("{:>5} {:>20.10g} {:>14}", k + 1, frequency,
                            frequency > 0 ? fmt::format("{:.6g}", 1 / frequency) : "-");
    const VectorXd masses = modes.effective_masses.row(k);
    sum += masses;
    for (const auto& values : {masses, sum})
      for (const double value : values)
        line += fmt::format(" {:>7.4f}", value);
    fmt::print("{}  {:>8.1e}\n", line, modes.residuals[k]);
  }
}

/// `count` modes from `first` on.
Modes part_of(const Modes& modes, Index first, Index count) {
  auto part = modes;
  part.frequencies = modes.frequencies.segment(first, count);
  part.shapes = modes.shapes.middleCols(first, count);
  part.generalised_masses = modes.generalised_masses.segment(first, count);
  part.effective_masses = modes.effective_masses.middleRows(first, count);
  part.residuals = modes.residuals.segment(first, count);
  return part;
}

Index count_below(const Modes& modes, double frequency) {
  return std::lower_bound(modes.frequencies.begin(), modes.frequencies.end(), frequency) -
         modes.frequencies.begin();
}

/// The lowest modes of the range: more and more are computed until the range ends or has as many as asked
/// for.
Modes modes_in(const model::Model& model, const inp::ModesAsked& asked, Contact contact) {
  constexpr int usual_number = 10;
  const int wanted = asked.number.value_or(usual_number);
  const bool all = !asked.number && asked.highest;
  const double highest = asked.highest.value_or(std::numeric_limits<double>::infinity());
  for (int number = wanted;; number *= 2) {
    const auto modes = rubato::modes::modes_of(model, {number, contact});
    const Index count = modes.frequencies.size(), first = count_below(modes, asked.lowest);
    const Index end = count_below(modes, std::nextafter(highest, std::numeric_limits<double>::infinity()));
    if (count == number && end == count && (all || count - first < wanted))
      continue;
    const Index found = all ? end - first : std::min<Index>(end - first, wanted);
    if (found <= 0)
      throw InputError(
          fmt::format("found no natural frequency from {} to {}, expected one; the lowest one is {}",
                      asked.lowest, highest, modes.frequencies[0]));
    return part_of(modes, first, found);
  }
}

} // namespace

int show_modes(const study::Study& study, const inp::ModesAsked& asked, Contact contact,
               const std::filesystem::path& folder) {
  const auto model = model::build_model(rubato::modes::modal_study(study));
  results::FolderClaim claim(folder);
  const auto modes = modes_in(model, asked, contact);
  claim.make();
  results::write_modes(folder, model, modes);
  results::write_mode_tables(folder, model, modes);
  fmt::print("{}: {} modes of {} unknowns; {} and {} in {}\n", study.name, modes.frequencies.size(),
             model.reduction.unknown_count(), results::modes_file, results::mode_shapes_file,
             folder.string());
  for (const auto& note : modes.notes)
    fmt::print("{}\n", note);
  for (const auto& warning : modes.warnings)
    fmt::print(stderr, "warning: {}: {}\n", study.name, warning);
  print_table(modes);
  if (modes.converged)
    return done;
  fmt::print(
      stderr,
      "error: {}: a residual is above 1e-7, or modes below the last one may be missing; expected fewer "
      "modes (--number) or a better shaped mesh\n",
      study.name);
  return no_convergence;
}

int modes(const ModesArguments& arguments) {
  if (arguments.number && *arguments.number < 1)
    throw InputError(fmt::format("--number: found {}, expected 1 or more", *arguments.number));
  const auto contact = contact_named(arguments.contact);
  const auto [deck, steps] = read_modes_deck(arguments.deck, arguments.settings, arguments.only);
  if (is_inp(arguments.deck))
    for (const auto& note : deck.notes)
      fmt::print(stderr, "{}\n", note);
  int worst = done;
  for (std::size_t i = 0; i < deck.runs.size(); ++i) {
    const auto& study = deck.runs[i];
    if (!is_asked(arguments, deck, study))
      continue;
    try {
      auto asked = steps.contains(study.name) ? steps.at(study.name) : inp::ModesAsked{};
      if (arguments.number)
        asked.number = arguments.number;
      worst = std::max(worst, show_modes(study, asked, contact, modes_output_of(arguments) / study.name));
    } catch (const InputError& error) {
      throw deck.places[i].located(error);
    }
  }
  return worst;
}

} // namespace rubato::app
