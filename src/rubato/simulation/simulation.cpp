// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/simulation/explicit_integrator.hpp"
#include "rubato/simulation/implicit_integrator.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/told_state.hpp"

#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace rubato::simulation {
namespace {

using Integrator = std::variant<std::unique_ptr<ImplicitIntegrator>, std::unique_ptr<ExplicitIntegrator>>;

Integrator make_integrator(const model::Model& model, const Start& start) {
  if (start.memento != nullptr)
    check_fits(model, *start.memento);
  if (study::is_explicit(model.study.time.scheme))
    return std::make_unique<ExplicitIntegrator>(model, start);
  return std::make_unique<ImplicitIntegrator>(model, start);
}

/// What a function gives for the integrator, whichever it is.
template <class Function> decltype(auto) ask(Integrator& integrator, const Function& function) {
  return std::visit([&](auto& any) -> decltype(auto) { return function(*any); }, integrator);
}
template <class Function> decltype(auto) ask(const Integrator& integrator, const Function& function) {
  return std::visit([&](const auto& any) -> decltype(auto) { return function(std::as_const(*any)); },
                    integrator);
}

Verdict verdict_on(const Trial& trial) {
  if (trial.attempt.accepted)
    return Verdict::accepted;
  return trial.final ? Verdict::not_converged : Verdict::cut;
}

void tell(const Observer& observer, const step::State& before, const Trial& trial) {
  if (trial.attempt.accepted)
    observer.accepted({before, trial.state, trial.attempt, trial.report, trial.energy, trial.last});
  else
    observer.rejected({trial.state, trial.attempt, trial.report, trial.final});
}

} // namespace

class Simulation::Impl {
public:
  Impl(const model::Model& model, const Start& start)
      : model_(model), integrator_(make_integrator(model_, start)) {
    if (start.memento != nullptr)
      counters_ = start.memento->counters;
  }
  Impl(std::unique_ptr<const model::Model> model, const Start& start) : Impl(*model, start) {
    owned_ = std::move(model);
  }

  StepResult attempt(const GoesOn& goes_on) {
    return ask(integrator_, [&](auto& integrator) { return attempt(integrator, goes_on); });
  }

  const model::Model& model() const { return model_; }
  const Counters& counters() const { return counters_; }
  bool finished() const {
    return ask(integrator_, [](const auto& integrator) { return integrator.finished(); });
  }
  const step::State& state() const {
    return ask(
        integrator_, [](const auto& integrator) -> auto& { return integrator.state(); });
  }
  std::shared_ptr<const step::State> shared_state() const {
    return ask(integrator_, [](const auto& integrator) { return integrator.shared_state(); });
  }
  const step::EnergyLedger& energy() const {
    return ask(
        integrator_, [](const auto& integrator) -> auto& { return integrator.energy(); });
  }
  Attempt next() const {
    return ask(integrator_, [](const auto& integrator) { return integrator.next(); });
  }
  double end() const {
    return ask(integrator_, [](const auto& integrator) { return integrator.end(); });
  }
  std::string method() const {
    return ask(integrator_, [](const auto& integrator) { return integrator.method(); });
  }

  void observe(Observer observer) { observers_.push_back(std::move(observer)); }

  Memento memento() const {
    return ask(integrator_, [&](const auto& integrator) {
      return Memento{step::kept_state(model_, integrator.state()), counters_, integrator.progress()};
    });
  }

  void restore(const Memento& memento) {
    check_fits(model_, memento);
    ask(integrator_, [&](auto& integrator) { integrator.restore(memento); });
    counters_ = memento.counters;
  }

private:
  template <class AnyIntegrator> StepResult attempt(AnyIntegrator& integrator, const GoesOn& goes_on) {
    if (integrator.finished())
      throw std::logic_error("a finished simulation has no next step");
    auto trial = integrator.make(goes_on);
    if (trial.report.outcome == step::Outcome::interrupted) {
      count(trial.spent);
      return {Verdict::interrupted, trial.attempt, std::move(trial.report), integrator.energy()};
    }
    StepResult result;
    try {
      result = {verdict_on(trial), trial.attempt, trial.report, {}};
      tell_all(integrator.state(), trial);
    } catch (...) {
      integrator.go_back();
      throw;
    }
    // Told; from here on nothing fails.
    count(trial.spent);
    if (result.accepted())
      integrator.accept(std::move(trial));
    else
      integrator.reject(trial);
    result.energy = integrator.energy();
    return result;
  }

  void tell_all(const step::State& before, const Trial& trial) const {
    for (std::size_t told = 0; told < observers_.size(); ++told) {
      try {
        tell(observers_[told], before, trial);
      } catch (...) {
        for (auto any = told + 1; any-- > 0;)
          observers_[any].take_back(before);
        throw;
      }
    }
  }

  void count(const Counters& spent) {
    counters_.steps += spent.steps;
    counters_.iterations += spent.iterations;
    counters_.cuts += spent.cuts;
  }

  std::unique_ptr<const model::Model> owned_; ///< on the heap: it stays where it is when this is moved
  const model::Model& model_;
  Integrator integrator_;
  std::vector<Observer> observers_;
  Counters counters_;
};

Simulation::Simulation(const study::Study& study, const Start& start)
    : Simulation(model::build_model(study, start.workers), start) {}
Simulation::Simulation(const model::Model& model, const Start& start)
    : impl_(std::make_unique<Impl>(model, start)) {}
Simulation::Simulation(model::Model&& model, const Start& start)
    : impl_(std::make_unique<Impl>(std::make_unique<const model::Model>(std::move(model)), start)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

StepResult Simulation::advance(const GoesOn& goes_on) {
  auto result = attempt(goes_on);
  while (result.verdict == Verdict::cut)
    result = attempt(goes_on);
  return result;
}

StepResult Simulation::attempt(const GoesOn& goes_on) {
  return impl_->attempt(goes_on);
}
bool Simulation::finished() const {
  return impl_->finished();
}
const model::Model& Simulation::model() const {
  return impl_->model();
}
const step::State& Simulation::state() const {
  return impl_->state();
}
std::shared_ptr<const step::State> Simulation::shared_state() const {
  return impl_->shared_state();
}
const step::EnergyLedger& Simulation::energy() const {
  return impl_->energy();
}
const Counters& Simulation::counters() const {
  return impl_->counters();
}
Attempt Simulation::next() const {
  return impl_->next();
}
double Simulation::end() const {
  return impl_->end();
}
std::string Simulation::method() const {
  return impl_->method();
}
void Simulation::observe(Observer observer) {
  impl_->observe(std::move(observer));
}
Memento Simulation::memento() const {
  return impl_->memento();
}
void Simulation::restore(const Memento& memento) {
  impl_->restore(memento);
}

} // namespace rubato::simulation
