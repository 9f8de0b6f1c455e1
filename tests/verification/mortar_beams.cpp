// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/mortar_beams.hpp"

#include <fmt/format.h>

#include "verification/case_runs.hpp"
#include "verification/mortar_runs.hpp"
#include <cmath>
#include <stdexcept>

namespace rubato::verification {
namespace {

constexpr double step = 2e-5;
constexpr std::array instants{0.001, 0.006, 0.012};

std::vector<deck::Setting> changes_of(const RefinedBeams& beams) {
  std::vector<deck::Setting> changes{{"runs.evol1.contact.interface.integration", beams.integration},
                                     {"mesh.refine", std::to_string(beams.fineness)},
                                     {"mesh.generate.0.cells", word_of(beams.cells)},
                                     {"mesh.generate.1.cells", word_of(beams.cells)},
                                     {"time.start", "~"},
                                     {"time.alpha", "-0.05"},
                                     {"time.step", fmt::format("{}", step)},
                                     {"fields", "~"}};
  if (!beams.matching)
    changes.push_back({"mesh.generate.1.divisions", beams.modeling == "c" ? "[17, 2, 1]" : "[17, 2]"});
  return changes;
}

double value_at(double instant, const std::vector<double>& t, const std::vector<double>& values) {
  for (std::size_t i = 0; i < t.size(); ++i)
    if (std::abs(t[i] - instant) < step / 100)
      return values[i];
  throw std::runtime_error(fmt::format("nothing was recorded at t = {}", instant));
}

} // namespace

Deflections deflect(const RefinedBeams& beams) {
  CaseRuns runs(fmt::format("sdnl140/{}.yaml", beams.modeling), changes_of(beams));
  const auto& run = runs["evol1"];
  const auto t = column(run.probes, "t");
  const auto y = column(run.probes, "tip.y");
  Deflections found{.steps = run.result.steps,
                    .cuts = run.result.cuts,
                    .iterations = run.result.iterations,
                    .seconds = run.result.setup_seconds + run.result.loop_seconds};
  for (std::size_t i = 0; i < instants.size(); ++i)
    found.y[i] = value_at(instants[i], t, y);
  return found;
}

} // namespace rubato::verification
