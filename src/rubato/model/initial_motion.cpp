// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/build.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rubato::model {
namespace {

using Eigen::VectorXd;

/// Numbers nearer than this part of them are the same.
constexpr double rounding = 1e-9;
/// Part of the run over which the velocity of a moving support at its beginning is taken.
constexpr double shortly = 1e-6;

bool same(double a, double b) {
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

class MotionCollector {
public:
  MotionCollector(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                  const constraint::Reduction& reduction, std::vector<Fault>& faults)
      : time_(study.time), mesh_(mesh), dofs_(dofs), reduction_(reduction), faults_(faults) {
    for (const auto& support : reduction.prescribed())
      supports_[support.dof] = &support;
    motion_.displacement = VectorXd::Zero(dofs.dof_count);
    motion_.velocity = motion_.displacement;
    reduction.impose_rates(1, time_.begin, motion_.velocity);
    given_ = motion_.velocity;
  }

  void add(const study::InitialMotion& initial, const std::string& path) {
    told_ = false;
    for (const auto node : nodes_of({initial.on, path + ".on"}))
      for (int i = 0; i < dofs_.components; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        if (const auto& value = initial.displacement[axis])
          set_displacement(path, node, i, *value);
        if (const auto& value = initial.velocity[axis])
          set_velocity(path, node, i, *value);
      }
  }

  /// What entries say of dofs that relations give must be what these give.
  void check_relations() {
    VectorXd related = motion_.velocity;
    reduction_.relate(related);
    reduction_.impose_rates(1, time_.begin, related);
    for (const auto& dependent : reduction_.dependents()) {
      double displaced = reduction_.given_part(dependent, time_.begin);
      for (const auto& term : dependent.of)
        displaced += term.coefficient * motion_.displacement[term.dof];
      check_dependent(dependent.dof, "displacement", displaced_, displaced);
      check_dependent(dependent.dof, "velocity", moved_, related[dependent.dof]);
    }
  }

  InitialMotion take() { return std::move(motion_); }

private:
  std::vector<mesh::NodeIndex> nodes_of(const Mention& name) {
    if (name.name == study::everywhere)
      return {dofs_.nodes.begin(), dofs_.nodes.end()};
    return body_nodes_or_fault(mesh_, dofs_, name, "to set in motion", faults_);
  }

  void set_displacement(const std::string& path, mesh::NodeIndex node, int component, double value) {
    const int dof = dofs_.dof(node, component);
    if (const auto support = supports_.find(dof); support != supports_.end()) {
      const double held = reduction_.displacement(*support->second, time_.begin);
      if (!same(value, held))
        tell(path, node, component, "displacement", value, fmt::format("its support puts it at {:g}", held));
    }
    set(path, node, component, "displacement", value, displaced_, motion_.displacement);
  }

  void set_velocity(const std::string& path, mesh::NodeIndex node, int component, double value) {
    const int dof = dofs_.dof(node, component);
    if (const auto support = supports_.find(dof); support != supports_.end()) {
      const double held = velocity_of(*support->second);
      if (std::abs(value - held) > shortly * std::max(std::abs(value), std::abs(held)))
        tell(path, node, component, "velocity", value, fmt::format("its support moves at {:g}", held));
    }
    set(path, node, component, "velocity", value, moved_, motion_.velocity);
  }

  /// What two entries say of one dof must be the same.
  void set(const std::string& path, mesh::NodeIndex node, int component, std::string_view what, double value,
           std::map<int, double>& known, VectorXd& values) {
    const int dof = dofs_.dof(node, component);
    const auto [there, fresh] = known.emplace(dof, value);
    if (!fresh && there->second != value)
      tell(path, node, component, what, value, fmt::format("another entry has {:g}", there->second));
    values[dof] = value;
  }

  void check_dependent(int dof, std::string_view what, const std::map<int, double>& known, double related) {
    const auto set = known.find(dof);
    if (set == known.end() || same(set->second, related))
      return;
    told_ = false;
    tell("initial", dofs_.nodes[static_cast<std::size_t>(dof / dofs_.components)], dof % dofs_.components,
         what, set->second, fmt::format("a relation gives {:g}", related));
  }

  /// One node of an entry is enough.
  void tell(const std::string& path, mesh::NodeIndex node, int component, std::string_view what, double value,
            const std::string& contradiction) {
    if (told_)
      return;
    told_ = true;
    faults_.push_back(
        fault_at(path, fmt::format("node {} begins with the {} {:g} in {}, but {}", node_label(mesh_, node),
                                   what, value, "xyz"[static_cast<std::size_t>(component)], contradiction)));
  }

  /// As it is given, else shortly after the begin.
  double velocity_of(const constraint::PrescribedDof& support) const {
    if (given_[support.dof] != 0)
      return given_[support.dof];
    const double h = shortly * (time_.end - time_.begin);
    const double begin = reduction_.displacement(support, time_.begin);
    return (reduction_.displacement(support, time_.begin + h) - begin) / h;
  }

  const study::TimeStepping& time_;
  const mesh::Mesh& mesh_;
  const domain::DofMap& dofs_;
  const constraint::Reduction& reduction_;
  std::vector<Fault>& faults_;
  VectorXd given_; ///< velocities that supports are given by
  std::map<int, const constraint::PrescribedDof*> supports_;
  std::map<int, double> displaced_;
  std::map<int, double> moved_;
  InitialMotion motion_;
  bool told_ = false;
};

} // namespace

InitialMotion make_initial_motion(const study::Study& study, const mesh::Mesh& mesh,
                                  const domain::DofMap& dofs, const constraint::Reduction& reduction,
                                  std::vector<Fault>& faults) {
  MotionCollector collector(study, mesh, dofs, reduction, faults);
  for (std::size_t i = 0; i < study.initial.size(); ++i)
    collector.add(study.initial[i], fmt::format("initial.{}", i));
  if (faults.empty())
    collector.check_relations();
  return collector.take();
}

} // namespace rubato::model
