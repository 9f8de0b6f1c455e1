// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/mode_tables.hpp"

#include "rubato/contact/enforcement.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/ccx_contact.hpp"
#include "rubato/results/frd.hpp"
#include "rubato/results/frd_blocks.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/tables.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace rubato::results {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int directions = 6;
constexpr std::string_view heading_of_factors = "MODE NO.   X-COMPONENT     Y-COMPONENT     Z-COMPONENT     "
                                                "X-ROTATION      Y-ROTATION      Z-ROTATION\n\n";

double angular_frequency(const modes::Modes& modes, Index k) {
  return 2 * std::numbers::pi * modes.frequencies[k];
}

/// Unit translations and rotations, one a column; 0 where supports hold.
MatrixXd rigid_motions(const model::Model& model) {
  MatrixXd motions = MatrixXd::Zero(model.dofs.dof_count, directions);
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    Eigen::Matrix<double, 3, directions> at;
    at << Eigen::Matrix3d::Identity(),
        Eigen::Matrix3d{{0, x.z(), -x.y()}, {-x.z(), 0, x.x()}, {x.y(), -x.x(), 0}};
    for (int c = 0; c < model.dofs.components; ++c)
      if (const auto dof = model.dofs.dof(node, c); !model.reduction.is_prescribed(dof))
        motions.row(dof) = at.row(c);
  }
  return motions;
}

class ModeText {
public:
  void words(std::string_view text) { text_ += text; }
  template <class Values> void row(std::string_view begin, const Values& values) {
    fmt::format_to(std::back_inserter(text_), "{:>7}", begin);
    for (const double value : values)
      fmt::format_to(std::back_inserter(text_), "{:>16}", fortran_e(value, 7));
    text_ += '\n';
  }
  const std::string& text() const { return text_; }

private:
  std::string text_;
};

void add_eigenvalues(const modes::Modes& modes, ModeText& text) {
  text.words("\n     E I G E N V A L U E   O U T P U T\n\n"
             " MODE NO    EIGENVALUE                       FREQUENCY   \n"
             "                                     REAL PART            IMAGINARY PART\n"
             "                           (RAD/TIME)      (CYCLES/TIME     (RAD/TIME)\n\n");
  for (Index k = 0; k < modes.frequencies.size(); ++k) {
    const double omega = angular_frequency(modes, k);
    text.row(std::to_string(k + 1), std::array{omega * omega, omega, modes.frequencies[k], 0.0});
  }
}

void add_participation(const model::Model& model, const modes::Modes& modes, ModeText& text) {
  const MatrixXd motions = rigid_motions(model);
  const MatrixXd moved = model.mass * motions;
  MatrixXd factors = linalg::transposed_product(modes.shapes, moved);
  for (Index k = 0; k < factors.rows(); ++k)
    factors.row(k) /= std::sqrt(modes.generalised_masses[k]);
  const MatrixXd masses = factors.cwiseAbs2();
  text.words("\n     P A R T I C I P A T I O N   F A C T O R S\n\n");
  text.words(heading_of_factors);
  for (Index k = 0; k < factors.rows(); ++k)
    text.row(std::to_string(k + 1), factors.row(k));
  text.words("\n     E F F E C T I V E   M O D A L   M A S S\n\n");
  text.words(heading_of_factors);
  for (Index k = 0; k < masses.rows(); ++k)
    text.row(std::to_string(k + 1), masses.row(k));
  text.row("TOTAL  ", masses.colwise().sum());
  text.words("\n     T O T A L   E F F E C T I V E   M A S S\n\n");
  text.words(heading_of_factors);
  text.row("", motions.cwiseProduct(moved).colwise().sum());
}

/// The bodies displaced by the shape, φ·M φ = 1.
step::State displaced(const model::Model& model, const modes::Modes& modes, Index k) {
  step::State state;
  state.t = 1; // of every mode, as in CalculiX
  state.motion.u = modes.shapes.col(k) / std::sqrt(modes.generalised_masses[k]);
  state.motion.v = state.motion.a = VectorXd::Zero(model.dofs.dof_count);
  state.bulk_points = model.domain.initial_states();
  for (const auto& zone : model.zones)
    state.zones.push_back(contact::initial_state(zone));
  return state;
}

std::string heading_of_mode(Index k) {
  return fmt::format("\n\n                    E I G E N V A L U E    N U M B E R {:5}\n\n", k + 1);
}

} // namespace

void write_mode_tables(const std::filesystem::path& folder, const model::Model& model,
                       const modes::Modes& modes) {
  const auto& output = model.study.fields;
  if (output.tables.empty() && !output.frd)
    return;
  ModeText head;
  add_eigenvalues(modes, head);
  add_participation(model, modes, head);
  Tables tables(model, folder / tables_file);
  tables.add_words(head.text());
  std::optional<FrdFile> frd;
  if (output.frd)
    frd.emplace(folder / frd_file, model.mesh, frd_settings(model));
  ContactLister contact(model);
  for (Index k = 0; k < modes.frequencies.size(); ++k) {
    const auto state = displaced(model, modes, k);
    if (!output.tables.empty())
      tables.add_words(heading_of_mode(k));
    tables.write(state, 0, true);
    if (frd)
      frd->add_mode(modes.frequencies[k], static_cast<int>(k + 1),
                    frd_blocks(model, state, nodal_fields(model, state, output), contact));
  }
}

} // namespace rubato::results
