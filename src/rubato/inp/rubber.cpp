// SPDX-License-Identifier: LGPL-3.0-or-later
// Readers of *HYPERELASTIC, *VISCOELASTIC and *CREEP.
#include "rubato/core/naming.hpp"
#include "rubato/inp/reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using Numbers = std::span<const double>;

/// CalculiX takes D1 = 0.1/G where the file has 0, and Abaqus/Explicit the same ratio.
constexpr double usual_bulk_ratio = 20;

/// K = 2/D1; D of higher order are refused before.
void set_bulk(double d1, double shear, study::Material& material) {
  material.hyperelasticity.bulk = d1 > 0 ? 2 / d1 : usual_bulk_ratio * shear;
  material.hyperelasticity.volume = study::VolumeEnergy::quadratic;
}

/// C10, C01, D1.
void set_mooney(Numbers n, study::Material& material) {
  material.law = study::LawKind::hyperelastic;
  material.hyperelasticity.c10 = n[0];
  material.hyperelasticity.c01 = n[1];
  set_bulk(n[2], 2 * (n[0] + n[1]), material);
}

/// C10, C20, C30, D1.
void set_yeoh(Numbers n, study::Material& material) {
  material.law = study::LawKind::yeoh;
  material.hyperelasticity.c10 = n[0];
  material.hyperelasticity.c20 = n[1];
  material.hyperelasticity.c30 = n[2];
  set_bulk(n[3], 2 * n[0], material);
}

/// μ1, α1, … and as many D.
void set_ogden(Numbers n, study::Physics, study::Material& material) {
  material.law = study::LawKind::ogden;
  const auto terms = n.size() / 3;
  double shear = 0;
  material.hyperelasticity.terms.clear();
  for (std::size_t i = 0; i < terms; ++i) {
    material.hyperelasticity.terms.push_back({n[2 * i], n[2 * i + 1]});
    shear += n[2 * i];
  }
  set_bulk(n[2 * terms], shear, material);
}

struct Potential {
  std::string_view word;
  int most_terms; ///< 1: the file gives no number of terms
  std::size_t (*coefficients)(std::size_t terms);
  std::size_t (*volumes)(std::size_t terms); ///< numbers D behind them
  void (*set)(Numbers, study::Physics, study::Material&);
};

std::size_t same(std::size_t terms) {
  return terms;
}
template <std::size_t Count> std::size_t always(std::size_t) {
  return Count;
}

/// C10, C01 of the first order, C20, C11, C02 of the second …; 0 but those of I1 from the second on.
void set_polynomial(Numbers n, study::Physics, study::Material& material) {
  if (n.size() == 3) // N=1
    return set_mooney(n, material);
  const bool third = n.size() > 7;
  set_yeoh(std::array{n[0], n[2], third ? n[5] : 0, n[third ? 9 : 5]}, material);
}

constexpr std::array potentials{
    Potential{"NEOHOOKE", 1, always<1>, always<1>,
              [](Numbers n, study::Physics, study::Material& m) {
                set_mooney(std::array{n[0], 0.0, n[1]}, m);
              }},
    Potential{"MOONEYRIVLIN", 1, always<2>, always<1>,
              [](Numbers n, study::Physics, study::Material& m) { set_mooney(n, m); }},
    Potential{"YEOH", 1, always<3>, always<3>,
              [](Numbers n, study::Physics, study::Material& m) { set_yeoh(n, m); }},
    Potential{"OGDEN", 6, [](std::size_t terms) { return 2 * terms; }, same, set_ogden},
    Potential{"POLYNOMIAL", 3, [](std::size_t terms) { return terms * (terms + 3) / 2; }, same,
              set_polynomial},
    Potential{"REDUCEDPOLYNOMIAL", 3, same, same, [](Numbers n, study::Physics, study::Material& m) {
                const auto terms = n.size() / 2;
                set_yeoh(std::array{n[0], terms > 1 ? n[1] : 0, terms > 2 ? n[2] : 0, n[terms]}, m);
              }}};

/// D2 and D3 divide terms of the energy: those above so many times D1 leave nothing of them.
constexpr double no_such_term = 1e10;

/// Coefficients that no law of rubato has: mixed ones of a polynomial.
bool has_mixed_terms(const Potential& potential, Numbers n, std::size_t terms) {
  if (potential.word != "POLYNOMIAL" || terms == 1)
    return false;
  for (std::size_t i = 0; i < potential.coefficients(terms); ++i)
    if (i != 0 && i != 2 && i != 5 && n[i] != 0)
      return true;
  return false;
}

void check_coefficients(Reading& reading, const Block& block, const Potential& potential,
                        const HeatTable& table, std::size_t terms) {
  const auto first = potential.coefficients(terms);
  for (const auto& numbers : table.numbers) {
    if (has_mixed_terms(potential, numbers, terms))
      return reading.faults.add(block.at,
                                "found a polynomial of I2 of the second order and higher, expected one of I1 "
                                "(YEOH) or one of the first order (MOONEY-RIVLIN)");
    const auto higher = std::span(numbers).subspan(first + 1);
    if (std::ranges::any_of(higher, [&](double d) { return d != 0 && !(d > no_such_term * numbers[first]); }))
      return reading.faults.add(block.at, "found D2 or D3, the compressibility of higher order, expected D1 "
                                          "alone");
    if (std::ranges::find(higher, 0.0) != higher.end())
      note(reading, block.at,
           "D2 and D3 are 0; CalculiX takes numbers of its own instead of 0, which changes "
           "forces by up to 2 %");
    if (numbers[first] == 0)
      note(reading, block.at,
           "D1 is 0, an incompressible material; the bulk modulus is 20 times the shear modulus, as in "
           "CalculiX and Abaqus/Explicit (Abaqus/Standard with hybrid elements keeps the volume)");
  }
}

std::size_t terms_of(Reading& reading, const Block& block, const Potential& potential) {
  const auto* const given = block.find("N");
  if (given == nullptr)
    return 1;
  const auto terms = mesh::inp::require_integer(given->value, "the number of terms", reading.faults);
  if (terms && *terms >= 1 && *terms <= potential.most_terms)
    return static_cast<std::size_t>(*terms);
  if (terms)
    reading.faults.add(given->value,
                       fmt::format("found N={}, expected 1 to {}", *terms, potential.most_terms));
  return 0;
}

const Potential* potential_of(Reading& reading, const Block& block) {
  for (const auto* word : {"ARRUDABOYCE", "MARLOW", "VANDERWAALS", "USER", "TESTDATAINPUT"})
    if (const auto* given = block.find(word); given != nullptr) {
      reading.faults.add(given->name,
                         fmt::format("found {}, expected the coefficients of NEO HOOKE, MOONEY-RIVLIN, YEOH, "
                                     "OGDEN, POLYNOMIAL or REDUCED POLYNOMIAL",
                                     given->name.text));
      return nullptr;
    }
  for (const auto& potential : potentials)
    if (block.find(potential.word) != nullptr)
      return &potential;
  return std::ranges::find(potentials, std::string_view("POLYNOMIAL"), &Potential::word);
}

} // namespace

void read_hyperelastic(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const data = material_above(reading, index);
  if (data == nullptr)
    return;
  data->names_law = true;
  const auto* const potential = potential_of(reading, block);
  const auto terms = potential == nullptr ? 0 : terms_of(reading, block, *potential);
  if (terms == 0)
    return;
  const auto first = potential->coefficients(terms);
  auto table = heat_table(reading, block, first, first + potential->volumes(terms),
                          "the coefficients of the potential and D");
  if (table.numbers.empty())
    return;
  check_coefficients(reading, block, *potential, table, terms);
  data->law = {std::move(table), potential->set};
}

void read_viscoelastic(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const data = material_above(reading, index);
  const auto* const time = block.find("TIME");
  if (data == nullptr)
    return;
  if (time == nullptr || compact(time->value.text) != "PRONY")
    return reading.faults.add(time == nullptr ? block.at : time->value,
                              "found viscoelasticity without a Prony series, expected TIME=PRONY");
  RelaxationPart part;
  part.at = block.at;
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    std::array<double, 3> n{};
    for (std::size_t i = 0; i < n.size(); ++i) {
      const auto number = mesh::inp::require_number(mesh::inp::field(fields, i, Word{}),
                                                    "g, k and the time of a term", reading.faults, 0);
      if (!number)
        return;
      n.at(i) = *number;
    }
    if (n[1] != 0)
      return reading.faults.add(fields[1],
                                fmt::format("found k = {}, a bulk modulus that relaxes, expected 0: "
                                            "the shear modulus relaxes alone",
                                            n[1]));
    if (n[0] != 0)
      part.terms.push_back({n[0], n[2]});
  }
  double sum = 0;
  for (const auto& term : part.terms)
    sum += term[0];
  if (part.terms.empty() || !(sum < 1))
    return reading.faults.add(block.at, fmt::format("found the sum {} of g, expected more than 0 and less "
                                                    "than 1",
                                                    sum));
  data->relaxation = std::move(part);
}

void read_creep(Reading& reading, std::size_t index) {
  if (auto* const data = material_above(reading, index); data != nullptr)
    data->creeps = true;
}

void set_relaxation(const RelaxationPart& part, bool instantaneous, study::Material& material) {
  double sum = 0;
  for (const auto& term : part.terms)
    sum += term[0];
  const double bulk = material.young / (3 * (1 - 2 * material.poisson));
  const double given = material.young / (2 * (1 + material.poisson));
  const double short_time = instantaneous ? given : given / (1 - sum);
  const double long_time = short_time * (1 - sum);
  material.law = study::LawKind::prony;
  material.young = 9 * bulk * long_time / (3 * bulk + long_time);
  material.poisson = (3 * bulk - 2 * long_time) / (2 * (3 * bulk + long_time));
  for (const auto& [part_of_shear, time] : part.terms)
    material.prony.push_back({part_of_shear * short_time, time});
}

} // namespace rubato::inp
