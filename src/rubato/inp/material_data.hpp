// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: what the keywords of a material give, at each of their temperatures.
#pragma once

#include "rubato/mesh/io/inp_content.hpp"
#include "rubato/study/study.hpp"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace rubato::inp {

using mesh::inp::Block;
using mesh::inp::Word;

struct Reading;

/// Numbers of a keyword at each of its temperatures, which ascend: linear in between, constant outside.
struct HeatTable {
  std::vector<double> temperatures;
  std::vector<std::vector<double>> numbers; ///< as many at every temperature
};

/// Points of plastic strain and stress; the first strain is 0, strains ascend.
using StressCurve = std::vector<std::array<double, 2>>;
/// Stress curves at each temperature.
struct HeatCurves {
  std::vector<double> temperatures;
  std::vector<StressCurve> curves;
};

/// Numbers of one keyword and what they are in a study.
struct MaterialPart {
  HeatTable table;
  void (*set)(std::span<const double> numbers, study::Physics physics, study::Material& material);
};

struct ExpansionPart {
  HeatTable table; ///< three coefficients
  double zero = 0; ///< temperature that the coefficients are counted from
};

enum class HardeningRule { isotropic, kinematic, combined, johnson_cook };

/// *PLASTIC with *CYCLIC HARDENING and *RATE DEPENDENT.
struct HardeningPart {
  HardeningRule rule = HardeningRule::isotropic;
  HeatCurves curves;           ///< isotropic, kinematic, and the first half cycle of combined
  HeatTable parameters;        ///< combined: σ0, C1, γ1, … johnson_cook: A, B, n, m, melting, transition
  HeatCurves cyclic;           ///< size of the yield surface
  HeatTable cyclic_parameters; ///< σ0, Q, b
  std::optional<std::array<double, 2>> rate; ///< C and the reference rate of Johnson and Cook
  Word at;
};

/// *VISCOELASTIC: parts of the shear modulus and their times.
struct RelaxationPart {
  std::vector<std::array<double, 2>> terms; ///< (g, τ)
  Word at;
};

struct MaterialData {
  study::Material material;        ///< name, damping; without cells
  bool plane_only = false;         ///< moduli of a lamina
  bool instantaneous = false;      ///< *ELASTIC, MODULI=INSTANTANEOUS
  std::optional<MaterialPart> law; ///< elastic or hyperelastic
  std::optional<MaterialPart> density;
  std::optional<ExpansionPart> expansion;
  std::optional<HardeningPart> hardening;
  std::optional<RelaxationPart> relaxation;
  bool names_law = false; ///< has the keyword of a law, sound or not
  bool creeps = false;
  Word at;
};

/// The material that the keyword completes; nullptr and a fault where there is none.
MaterialData* material_above(Reading& reading, std::size_t index);

/// Sets of `count` numbers, each with a temperature behind, in lines of eight. At least `least` of each set
/// are there, the others are 0. Empty after a fault.
HeatTable heat_table(Reading& reading, const Block& block, std::size_t least, std::size_t count,
                     std::string_view expected);
/// Lines of a stress, a plastic strain and a temperature. Empty after a fault.
HeatCurves heat_curves(Reading& reading, const Block& block);
std::vector<double> numbers_at(const HeatTable& table, double temperature);
StressCurve curve_at(const HeatCurves& curves, double temperature);

/// The plastic numbers of a material at a temperature.
void set_hardening(const HardeningPart& part, double temperature, study::Material& material);
/// Adds a fault where kinematic hardening is not one straight line.
void check_hardening(Reading& reading, const HardeningPart& part);
/// An elastic material becomes one with a series of shear moduli.
void set_relaxation(const RelaxationPart& part, bool instantaneous, study::Material& material);

/// The material at a temperature, whose strains are 0 at the initial one.
study::Material material_at(const MaterialData& data, study::Physics physics, double temperature,
                            double initial);
/// Returns whether numbers of the material differ between two temperatures.
bool varies_between(const MaterialData& data, double lowest, double highest);

} // namespace rubato::inp
