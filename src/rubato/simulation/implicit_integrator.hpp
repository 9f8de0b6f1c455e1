// SPDX-License-Identifier: LGPL-3.0-or-later
/// Implicit steps with cuts, as a simulation makes them: the functions of ExplicitIntegrator.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/simulation/attempt.hpp"
#include "rubato/simulation/kept_state.hpp"
#include "rubato/simulation/memento.hpp"
#include "rubato/simulation/stages.hpp"
#include "rubato/simulation/start.hpp"
#include "rubato/simulation/trial.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/state.hpp"
#include "rubato/step/system_cache.hpp"
#include "rubato/time/scheme.hpp"
#include "rubato/time/step_control.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace rubato::simulation {

class ImplicitIntegrator {
public:
  /// The model must outlive this. Factors the matrix of the first step.
  ImplicitIntegrator(const model::Model& model, const Start& start);
  ImplicitIntegrator(const ImplicitIntegrator&) = delete; // parts refer to others
  ImplicitIntegrator& operator=(const ImplicitIntegrator&) = delete;

  Attempt next() const {
    return {.begin = control_.now(), .end = control_.target(), .cut_level = control_.level()};
  }
  bool finished() const { return control_.finished(); }
  double end() const { return end_; }
  std::string method() const { return method_; }
  const step::State& state() const { return *state_; }
  std::shared_ptr<const step::State> shared_state() const { return state_.shared(); }
  const step::EnergyLedger& energy() const { return account_.ledger(); }

  /// Makes an attempt; one of accept, reject or go_back follows unless it was interrupted.
  Trial make(const GoesOn& goes_on);
  void accept(Trial trial);
  void reject(const Trial& trial);
  /// As if the attempt had not been made.
  void go_back() {}

  ImplicitProgress progress() const { return {control_.place(), account_.ledger(), account_.overlaps()}; }
  /// The memento must fit the model.
  void restore(const Memento& memento);

private:
  void prepare();
  void begin_stage();
  void take_model();
  const model::Model& model() const { return stages_.model(); }

  Stages stages_;
  time::Scheme scheme_;
  std::function<void(std::size_t)> tell_memory_;
  std::optional<step::SystemCache> systems_; ///< of the stage; there is one
  KeptState state_;
  step::State spare_; ///< storage for the next attempt: that of the state before, unless others hold it
  time::StepControl control_;
  step::EnergyAccount account_;
  step::EnergyAccount next_account_; ///< with the step that make() has made
  double end_ = 0;
  std::string method_;
};

} // namespace rubato::simulation
