// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/validate.hpp"

#include "rubato/core/error.hpp"
#include "rubato/study/rules/rules.hpp"

#include <utility>

namespace rubato::study {

Judgement judge(const Study& study) {
  Rules rules(study);
  check_physics(rules);
  check_mesh(rules);
  check_groups(rules);
  check_time(rules);
  check_materials(rules);
  check_functions(rules);
  check_supports(rules);
  check_base_motion(rules);
  check_preloads(rules);
  check_relations(rules);
  check_modal_damping(rules);
  check_springs(rules);
  check_connectors(rules);
  check_point_masses(rules);
  check_loads(rules);
  check_temperatures(rules);
  check_initial(rules);
  check_contact(rules);
  check_solution(rules);
  check_probes(rules);
  check_output(rules);
  check_checks(rules);
  return rules.take();
}

Judgement judge_groups(const Study& study) {
  Rules rules(study);
  check_groups(rules);
  return rules.take();
}

std::vector<BrokenRule> broken_rules(const Study& study) {
  return judge(study).broken;
}

void validate(const Study& study) {
  std::vector<Fault> faults;
  for (auto& rule : broken_rules(study))
    faults.push_back(fault_at(rule.paths.front(), rule.paths.front() + ": " + rule.text));
  if (!faults.empty())
    throw InputError(std::move(faults));
}

} // namespace rubato::study
