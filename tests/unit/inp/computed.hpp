// SPDX-License-Identifier: LGPL-3.0-or-later
/// Studies computed to their ends, one after another.
#pragma once

#include "rubato/domain/dof_map.hpp"
#include "rubato/inp/read.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

#include "support/model_parts.hpp"
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rubato::test {

inline std::filesystem::path inp_file(const std::string& name) {
  return std::filesystem::path(RUBATO_SOURCE_DIR) / "tests/inp" / (name + ".inp");
}

/// Every .inp file of the tests that a run can be made of, in the order of their names.
inline std::vector<std::filesystem::path> all_inp_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(inp_file("x").parent_path()))
    if (entry.path().extension() == ".inp")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Runs that start from one another.
class Computed {
public:
  explicit Computed(const std::vector<study::Study>& studies) {
    for (const auto& study : studies) {
      simulation::Start start;
      for (std::size_t i = 0; i < runs_.size(); ++i)
        if (studies[i].name == study.time.start_run)
          start.previous = &runs_[i]->state();
      runs_.push_back(std::make_unique<simulation::Simulation>(study, start));
      while (!runs_.back()->finished())
        if (!runs_.back()->advance().accepted())
          throw std::runtime_error(study.name + " did not come to its end");
    }
  }

  std::size_t size() const { return runs_.size(); }
  test::ModelParts model(std::size_t run) const { return runs_[run]->model(); }
  const Eigen::VectorXd& displacements(std::size_t run) const { return runs_[run]->state().motion.u; }

  double displacement(std::size_t run, const Eigen::Vector3d& place, int axis) const {
    const auto& mesh = model(run).mesh;
    for (const auto node : model(run).dofs.nodes)
      if ((mesh.points[static_cast<std::size_t>(node)] - place).norm() < 1e-9)
        return displacements(run)[model(run).dofs.dof(node, axis)];
    throw std::runtime_error("no node there");
  }

private:
  std::vector<std::unique_ptr<simulation::Simulation>> runs_;
};

inline Computed computed(const std::string& name) {
  return Computed(inp::read_input(inp_file(name)).runs);
}

} // namespace rubato::test
