// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/predicted_start.hpp"

#include "rubato/model/model.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;

/// Frames that the prediction goes through.
constexpr int most_predictions = 10;
constexpr int most_predictions_of_free_bodies = 60;
/// Moves of free bodies, in parts of how far an iteration may move them, that Newton takes over.
constexpr double at_rest = 1e-5;
/// Cosine between moves that go one way.
constexpr double same_way = 0.99;
/// Misfit of forces and frames, in parts of the largest force, that Newton takes over.
constexpr double fitting = 3e-3;
/// The most turns of normal and friction forces in the same frames, and the move of the surfaces, in edges,
/// at which these forces are settled.
constexpr int most_turns = 50;
constexpr double settled_move = 1e-3;

/// How far points that may touch have to come at least.
double nearest_gap(std::span<const PredictorPoint> points) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& point : points)
    nearest = std::min(nearest, std::max(0.0, point.gap));
  return points.empty() ? 0 : nearest;
}

class Prediction {
public:
  Prediction(const PredictorSite& site, SurfaceMotion& surface, Reach& reach, PredictorScratch& scratch,
             ContactIterate& now, State& trial)
      : site_(site), surface_(surface), reach_(reach), predictor_(scratch.predictor), points_(scratch.points),
        touching_(scratch.touching), now_(now), trial_(trial),
        matrix_(site.system.matrix, site.model.sharing()), free_bodies_(site.system.has_free_bodies),
        takes_bases_(free_bodies_ &&
                     std::ranges::all_of(site.model.zones, &contact::Zone::points_own_multipliers)),
        rubs_(std::ranges::any_of(site.model.zones,
                                  [](const auto& zone) { return zone.settings.friction > 0; })) {}

  void run() {
    begin();
    const int rounds = takes_bases_ ? most_predictions_of_free_bodies : most_predictions;
    for (int round = 0; round < rounds; ++round) {
      if (!improve(round) || (starts_afar_ && !settle()))
        return;
      follow_frames();
      if (!surface_.consistent ||
          site_.model.sharing().of_first(predictor_.misfit(points_, surface_.moved) > fitting))
        continue;
      if (!takes_bases_ || surface_.moved.lpNorm<Eigen::Infinity>() <= at_rest * reach_.most())
        return;
      if (!take_as_base())
        return;
    }
  }

private:
  /// Improves the forces in the present frames and moves the surfaces by them; false when the progress
  /// stopped.
  bool improve(int round) {
    predictor_.improve(points_, surface_.free, free_bodies_ ? surface_.free : surface_.moved, matrix_,
                       site_.progress);
    if (site_.progress.stopped())
      return false;
    take_forces_of_first();
    take_prediction(site_.model, points_, trial_);
    move(round);
    return true;
  }

  /// Normal and friction forces are improved in turn. In a long step an error of theirs moves a body by the
  /// same part of its way without contact, to where frames do not hold.
  bool settle() {
    const double settled = settled_move * finest_edge(site_.model);
    for (int turn = 0; turn < most_turns; ++turn) {
      const VectorXd before = surface_.moved;
      if (!improve(0))
        return false;
      if (site_.model.sharing().of_first((surface_.moved - before).lpNorm<Eigen::Infinity>() <= settled))
        return true;
    }
    return true;
  }

  /// Where the forces of the last step push the surfaces, or where the step starts.
  void begin() {
    touching_.resize(site_.model.zones.size());
    surface_.applied = trial_.contact_force(compliance().dof_of_interface_dof());
    surface_.move(trial_);
    site_.side.measure(trial_, site_.frozen, now_);
    starts_afar_ = !free_bodies_ && site_.side.is_out_of_reach(now_);
    if (free_bodies_ || starts_afar_) {
      surface_.go_to(site_.side.committed().motion, trial_);
      site_.side.measure(trial_, site_.frozen, now_);
    }
    site_.side.restrict_friction(site_.frozen, now_);
    take_points(site_.model, site_.side, site_.frozen, compliance(), now_, surface_.moved, trial_, points_);
    reach_.start();
  }

  /// What each rank has solved for need not have the same last digits.
  void take_forces_of_first() {
    const auto ranks = site_.model.sharing();
    if (ranks.is_alone())
      return;
    std::vector<double> forces;
    for (const auto& point : points_)
      forces.insert(forces.end(), point.force.begin(), point.force.end());
    ranks.share_first(forces);
    auto next = forces.begin();
    for (auto& point : points_)
      for (double& force : point.force)
        force = *next++;
  }

  /// Nothing but contact holds free bodies: forces that don't fit yet move them by their whole size and more.
  void move(int round) {
    const VectorXd before = free_bodies_ ? surface_.moved : VectorXd();
    surface_.applied = force_on_surface(points_, surface_.free.size());
    surface_.move(trial_);
    if (free_bodies_)
      surface_.shorten(
          before, reach_.part_of(surface_.moved - before, round == 0 ? nearest_gap(points_) : 0.0), trial_);
  }

  void follow_frames() {
    find_touching(points_, surface_.moved, touching_);
    site_.side.measure(trial_, site_.frozen, touching_, now_);
    move_frames(site_.model, site_.side, site_.frozen, compliance(), now_, surface_.moved, touching_,
                points_);
  }

  /// The forces of the springs that hold free bodies are dropped: the motion reached is the new base. False
  /// where a cell has no forces there: the base stays as it is.
  bool take_as_base() {
    const double more = still_to_come();
    surface_.move_bulk(trial_);
    trial_.motion.u += more * (trial_.motion.u - surface_.base.u);
    if (!site_.equilibrium.has_forces_at(trial_.motion.u)) {
      trial_.motion = surface_.base;
      surface_.place(trial_);
      return false;
    }
    const VectorXd moved = (1 + more) * surface_.moved;
    for (auto& point : points_)
      point.value = measures_of(point, moved);
    surface_.start_from(trial_.motion, site_.equilibrium);
    return true;
  }

  /// Moves from base to base that go one way, each the part r of the one before, have r/(1 − r) of the last
  /// one still to come: no more of them is taken than frames tell about.
  double still_to_come() {
    const VectorXd last = std::exchange(last_move_, surface_.moved);
    if (last.size() == 0 || !rubs_)
      return 0;
    const double along = last.dot(surface_.moved);
    if (along < same_way * last.norm() * surface_.moved.norm())
      return 0;
    const double part = along / last.squaredNorm();
    const double most = reach_.most() / surface_.moved.lpNorm<Eigen::Infinity>();
    last_move_.resize(0);
    return part < 1 ? std::min(part / (1 - part), most) : most;
  }

  Compliance& compliance() { return *site_.system.compliance; }

  const PredictorSite& site_;
  SurfaceMotion& surface_;
  Reach& reach_;
  ContactPredictor& predictor_;
  std::vector<PredictorPoint>& points_;
  PointsOfZones& touching_;
  ContactIterate& now_;
  State& trial_;
  linalg::WholeMatrix matrix_;
  bool free_bodies_;
  bool takes_bases_; ///< where points share multipliers, these take the means of the forces predicted only
  bool rubs_;
  bool starts_afar_ = false; ///< whether contact is lost where the forces of the last step push
  VectorXd last_move_;       ///< from base to base
};

} // namespace

PredictorScratch::PredictorScratch(Compliance& compliance, double force_weight, int components,
                                   NormalSolution how_far)
    : predictor(compliance, force_weight, components, how_far) {}

void predict_contact(const PredictorSite& site, SurfaceMotion& surface, Reach& reach,
                     PredictorScratch& scratch, ContactIterate& now, State& trial) {
  Prediction(site, surface, reach, scratch, now, trial).run();
  scratch.predictor.forget_surface();
}

} // namespace rubato::step
