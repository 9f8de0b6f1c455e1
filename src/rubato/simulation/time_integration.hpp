// SPDX-License-Identifier: LGPL-3.0-or-later
/// The class Simulation for sources that need few parts of a model; simulation.hpp is for other programs.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/simulation/attempt.hpp"
#include "rubato/simulation/memento.hpp"
#include "rubato/simulation/observer.hpp"
#include "rubato/simulation/start.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/state.hpp"

#include <memory>
#include <string>

namespace rubato::study {
struct Study;
} // namespace rubato::study

namespace rubato::simulation {

/// Implicit and explicit alike. An attempt of an implicit simulation is one attempt at a step to the next
/// listed instant, or to the end of a part where that step was cut. An attempt of an explicit one is all
/// steps to the next record.
///
/// Only accepted steps change state and energy. Results of contact are in state().zones, a zone of the model
/// each: multipliers [pressure], and of every contact point its status, gap [length] and pressure.
class Simulation {
public:
  /// Builds mesh and model. Throws InputError with every rule that the study breaks, with every fault that
  /// shows against its mesh, and for all that the others throw for.
  explicit Simulation(const study::Study& study, const Start& start = {});
  /// The model must outlive this. Throws InputError for an end of another run that does not fit, a memento
  /// that does not fit, masses that do not allow motion, an explicit step that is not stable, `solver:
  /// condensed` where the matrix does not allow it, and a matrix too large for the memory;
  /// std::invalid_argument when the study starts from another run whose end is not given.
  explicit Simulation(const model::Model& model, const Start& start = {});
  /// The same with a model of its own.
  explicit Simulation(model::Model&& model, const Start& start = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// One accepted step: attempts until one is accepted, none is left or one is interrupted; never ends with
  /// Verdict::cut. `goes_on` is asked at least once an iteration (step/progress.hpp), in explicit simulations
  /// every few steps. An interrupted implicit attempt leaves nothing; an explicit one keeps what it has come
  /// towards the record, so that the next attempt goes on from there, to the same bits.
  /// Throws what observers and `goes_on` throw, and InputError when the matrix of a shorter step does not fit
  /// into the memory; the attempt leaves nothing then. Throws std::logic_error when finished.
  StepResult advance(const GoesOn& goes_on = {});
  /// One attempt: for who wants to act between cuts.
  StepResult attempt(const GoesOn& goes_on = {});

  /// Whether the last instant is reached.
  bool finished() const;
  const model::Model& model() const;
  /// After the last accepted step. While nobody holds a shared_state(), it stays at its address.
  const step::State& state() const;
  /// The same, without a copy: it stays as it is whatever steps follow, and when the simulation is gone.
  std::shared_ptr<const step::State> shared_state() const;
  /// Of that state.
  const step::EnergyLedger& energy() const;
  const Counters& counters() const;
  /// The attempt that comes next: when it begins and ends, and how deep it is cut. Call only while not
  /// finished.
  Attempt next() const;
  /// The last instant.
  double end() const;
  /// How steps are made, and why, in a sentence for the log. Implicit: empty when built finished.
  std::string method() const;

  /// Tells whoever it is of all attempts from now on, after those that are told already.
  void observe(Observer observer);

  /// All that steps change. Observers are not part of it.
  Memento memento() const;
  /// Goes back, or on, to what a simulation of the same model had. Throws InputError for a memento of another
  /// one; nothing is changed then.
  void restore(const Memento& memento);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace rubato::simulation
