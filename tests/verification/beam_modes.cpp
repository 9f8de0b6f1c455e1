// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/beam_modes.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/modes/modal_study.hpp"
#include "rubato/results/csv.hpp"

#include <fmt/format.h>

#include "support/model_of.hpp"
#include "support/shared_files.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::verification {
namespace {

std::string deck_of(const BeamModes& beam) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: beam, box: {{from: [0, 0, 0], to: [1, 0.1, 0.1]}}, divisions: [20, 2, 1], cells: {}, sides: {{left: clamp}}}}
  convert: {}
physics: solid
materials: {{steel: {{young: 200e9, poisson: {}, density: 7800}}}}
supports: [{{on: clamp, fix: [x, y, z]}}]
time: {{scheme: static, step: 1, end: 1}}
)",
                     beam.deck_cells, beam.convert, beam.poisson);
}

} // namespace

std::vector<BeamModes> beams_with_modes() {
  return {{"c_nu0", "HEXA8", "hexa8", "none", 0},
          {"c_nu03", "HEXA8", "hexa8", "none", 0.3},
          {"d20_nu0", "HEXA20", "hexa20", "none", 0},
          {"d20_nu03", "HEXA20", "hexa20", "none", 0.3},
          {"d27_nu0", "HEXA27", "hexa20", "full_quadratic", 0},
          {"d27_nu03", "HEXA27", "hexa20", "full_quadratic", 0.3}};
}

modes::Modes computed_modes(const BeamModes& beam) {
  const auto study = deck::parse_deck(deck_of(beam), "beam.yaml").runs.front();
  return modes::modes_of(test::BuiltModel(modes::modal_study(study)), {.number = 10});
}

std::optional<std::vector<double>> reference_frequencies(const BeamModes& beam) {
  const auto file = test::shared_file("oracle/modes_" + beam.name + ".csv");
  if (!std::filesystem::exists(file))
    return std::nullopt;
  const auto table = results::read_csv(file);
  const auto column = static_cast<std::size_t>(table.column("freq_hz"));
  std::vector<double> frequencies;
  for (const auto& row : table.rows)
    frequencies.push_back(row[column]);
  return frequencies;
}

double largest_deviation(const modes::Modes& modes, const std::vector<double>& reference) {
  double largest = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
    largest = std::max(largest, std::abs(modes.frequencies[static_cast<Eigen::Index>(i)] / reference[i] - 1));
  return largest;
}

} // namespace rubato::verification
