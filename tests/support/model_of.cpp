// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/model_of.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <utility>

namespace rubato::test {

BuiltModel::BuiltModel(std::shared_ptr<const model::Model> model)
    : ModelParts(*model), kept_(std::move(model)) {}

BuiltModel::BuiltModel(const study::Study& input)
    : BuiltModel(std::make_shared<const model::Model>(model::build_model(input))) {}

BuiltModel::BuiltModel(const study::Study& input, mesh::Mesh bodies)
    : BuiltModel(std::make_shared<const model::Model>(model::build_model(input, std::move(bodies)))) {}

BuiltModel::operator model::Model() && {
  return whole;
}

study::Study study_of(std::string_view deck, const std::vector<deck::Setting>& changes) {
  return deck::parse_deck(deck, "deck.yaml", changes).runs.front();
}

BuiltModel model_of(std::string_view deck, const std::vector<deck::Setting>& changes) {
  return BuiltModel(study_of(deck, changes));
}

} // namespace rubato::test
