// SPDX-License-Identifier: LGPL-3.0-or-later
/// The simulation of a deck, everything that a step leaves behind at hand.
#pragma once

#include "rubato/deck/setting.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/results/resultants.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace rubato::test {

/// Implicit.
class Walk {
  /// Stays where it is when the walk moves.
  struct Told {
    step::State before;
    std::vector<step::StepReport> reports;
    int deepest_cut = 0;
  };
  std::unique_ptr<Told> told_ = std::make_unique<Told>();
  std::optional<BuiltModel> given_; ///< unless the simulation owns the model

public:
  explicit Walk(std::string_view deck, const std::vector<deck::Setting>& changes = {});
  /// `previous`: the end of the run that the study starts from, when it does.
  explicit Walk(const study::Study& study, const step::State* previous = nullptr);
  Walk(const study::Study& study, mesh::Mesh mesh);
  explicit Walk(model::Model given, const step::State* previous = nullptr);
  explicit Walk(BuiltModel given);

  /// Steps to the next instant of the list, cutting when it must; false when that doesn't help.
  bool advance();
  bool to_end();
  /// Goes on from there.
  void stand_at(step::State now);

  bool finished() const { return simulation.finished(); }
  /// The last accepted one.
  const step::State& state() const { return simulation.state(); }
  /// The end of the next step, and its length.
  double target() const { return simulation.next().end; }
  double length() const;

  double displacement(mesh::NodeIndex node, int component) const;
  mesh::NodeIndex node_at(double x, double y, double z = 0) const;
  results::Resultants resultants(std::size_t zone = 0) const;
  /// λ of the i-th slave node.
  double pressure(std::size_t i, std::size_t zone = 0) const;
  const Eigen::Vector3d& slave_point(std::size_t i, std::size_t zone = 0) const;
  std::size_t slave_count(std::size_t zone = 0) const;

  simulation::Simulation simulation;
  const ModelParts model;
  time::Scheme scheme;
  const step::State& before = told_->before;                     ///< the state before the last step
  const std::vector<step::StepReport>& reports = told_->reports; ///< of every attempt
  const int& deepest_cut = told_->deepest_cut;                   ///< halvings of the shortest accepted step
  std::function<void()> accepted; ///< called after every accepted step, cut ones too

private:
  void observe();
};

} // namespace rubato::test
