// SPDX-License-Identifier: LGPL-3.0-or-later
/// Models of decks and of studies.
#pragma once

#include "rubato/deck/setting.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/fwd.hpp"

#include "support/model_parts.hpp"
#include <memory>
#include <string_view>
#include <vector>

namespace rubato::study {
struct Study;
} // namespace rubato::study

namespace rubato::test {

/// A model and its parts; copies share the model.
class BuiltModel : public ModelParts {
public:
  explicit BuiltModel(const study::Study& study);
  BuiltModel(const study::Study& study, mesh::Mesh mesh);

  operator const model::Model&() const { return whole; }
  /// A copy. Makes a Simulation of a temporary ambiguous, whose model would end before the simulation.
  operator model::Model() &&;

private:
  explicit BuiltModel(std::shared_ptr<const model::Model> model);

  std::shared_ptr<const model::Model> kept_;
};

/// The first run of a deck.
study::Study study_of(std::string_view deck, const std::vector<deck::Setting>& changes = {});

/// The model of that run.
BuiltModel model_of(std::string_view deck, const std::vector<deck::Setting>& changes = {});

} // namespace rubato::test
