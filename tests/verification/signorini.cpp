// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/signorini.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/domain.hpp"

#include <fmt/format.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "verification/case_runs.hpp"
#include "verification/hertz.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::verification {
namespace {

using Eigen::VectorXd;

/// A block that was pressed, and its cells by their place in the grid.
class Pressed {
public:
  Pressed(CellType cells, int divisions, const std::string& integration = "nodes")
      : run_(pressed(cells, divisions, integration)), model_(test::BuiltModel(run_.study)),
        divisions_(divisions) {}

  const CaseRun& run() const { return run_; }
  const test::ModelParts& model() const { return model_; }
  const VectorXd& displacement() const { return run_.result.end.motion.u; }

  /// The displacement at a point of the unit square.
  Eigen::Vector2d at(double x, double y) const {
    const auto place = [this](double s) {
      return std::min(static_cast<int>(s * divisions_ + 1e-9), divisions_ - 1);
    };
    const int i = place(x);
    const int j = place(y);
    const auto cell = model_.bulk.cells[static_cast<std::size_t>(j * divisions_ + i)];
    const Eigen::Vector3d xi(2 * (x * divisions_ - i) - 1, 2 * (y * divisions_ - j) - 1, 0);
    std::array<double, 27> shape{};
    cell::reference_cell(model_.mesh.type_of(cell)).values(xi, shape);
    const auto nodes = model_.mesh.nodes_of(cell);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int a = 0; a < 2; ++a)
        sum[a] += shape[n] * displacement()[model_.dofs.dof(nodes[n], a)];
    return sum;
  }

private:
  static CaseRun pressed(CellType cells, int divisions, const std::string& integration) {
    std::string name(cell::topology(cells).name);
    for (auto& letter : name)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    CaseRuns runs("v9_signorini/block.yaml",
                  {{"mesh.generate.0.cells", name},
                   {"mesh.generate.0.divisions", fmt::format("[{0}, {0}]", divisions)},
                   {"contact.foot.integration", integration}});
    return runs["run"];
  }

  CaseRun run_;
  test::BuiltModel model_;
  int divisions_;
};

double energy(const test::ModelParts& model, const VectorXd& u) {
  return u.dot(model.domain.initial_tangent() * u);
}

double error_of(const Pressed& coarse, const Pressed& fine) {
  VectorXd difference = -fine.displacement();
  for (const auto node : fine.model().dofs.nodes) {
    const auto& x = fine.model().mesh.points[static_cast<std::size_t>(node)];
    const auto u = coarse.at(x[0], x[1]);
    for (int a = 0; a < 2; ++a)
      difference[fine.model().dofs.dof(node, a)] += u[a];
  }
  return std::sqrt(energy(fine.model(), difference) / energy(fine.model(), fine.displacement()));
}

} // namespace

std::vector<double> signorini_errors(CellType cells, std::span<const int> divisions, int fine,
                                     const std::string& integration) {
  const Pressed reference(CellType::quad9, fine);
  std::vector<double> errors;
  for (const int n : divisions)
    errors.push_back(error_of(Pressed(cells, n, integration), reference));
  return errors;
}

double signorini_half_width(int fine) {
  const Pressed reference(CellType::quad9, fine);
  double last = 0;
  for (const auto& point : surface_at_end(reference.run()))
    if (point.status != contact::Status::open)
      last = std::max(last, point.x);
  return last;
}

} // namespace rubato::verification
