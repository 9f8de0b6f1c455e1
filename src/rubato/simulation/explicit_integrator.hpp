// SPDX-License-Identifier: LGPL-3.0-or-later
/// Explicit steps from one instant of results to the next, as a simulation makes them: the functions of
/// ImplicitIntegrator.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/simulation/attempt.hpp"
#include "rubato/simulation/kept_state.hpp"
#include "rubato/simulation/memento.hpp"
#include "rubato/simulation/stages.hpp"
#include "rubato/simulation/start.hpp"
#include "rubato/simulation/trial.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"
#include "rubato/step/state.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rubato::simulation {

class ExplicitIntegrator {
public:
  /// The model must outlive this. Throws InputError when the study's step is longer than the stable one.
  ExplicitIntegrator(const model::Model& model, const Start& start);

  Attempt next() const { return {.begin = state_->t, .end = instants_[next_]}; }
  bool finished() const { return next_ >= instants_.size(); }
  double end() const { return time_.end; }
  std::string method() const;
  const step::State& state() const { return *state_; }
  std::shared_ptr<const step::State> shared_state() const { return state_.shared(); }
  const step::EnergyLedger& energy() const { return energy_; }

  /// Goes to the next record in equal stable steps; one of accept, reject or go_back follows unless it was
  /// interrupted: then it keeps the way it has come.
  Trial make(const GoesOn& goes_on);
  void accept(Trial trial);
  void reject(const Trial&) { go_back(); }
  /// To where the attempt began.
  void go_back();

  ExplicitProgress progress() const;
  /// The memento must fit the model.
  void restore(const Memento& memento);

private:
  void limit_step(const step::Spectrum& spectrum);
  step::Outcome go_to(const Attempt& attempt, const GoesOn& goes_on, domain::Failed& failed);
  bool goes_on_from_here(const Attempt& attempt, const GoesOn& goes_on);
  std::size_t first_record_ahead() const;
  void take_stage_of(const ExplicitProgress& progress);

  const study::TimeStepping& time_;
  step::ExplicitMotion motion_;
  KeptState state_; ///< at the last record
  step::EnergyLedger energy_;
  int equal_records_ = 1;
  std::vector<double> instants_; ///< of the records, the begin first; stops among the equal ones
  Stages stages_;
  std::size_t next_ = 1;                   ///< of the instants
  double limit_ = INFINITY;                ///< of the step [time]
  std::optional<ExplicitProgress> before_; ///< where the attempt began, until it is judged
  int points_in_contact_ = 0;              ///< as they were counted last
  std::chrono::steady_clock::time_point counted_;
};

} // namespace rubato::simulation
