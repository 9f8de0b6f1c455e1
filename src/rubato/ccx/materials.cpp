// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials, their axes and sections.
#include "rubato/ccx/draft.hpp"
#include "rubato/material/make_point_law.hpp"
#include "rubato/material/orthotropic.hpp"
#include "rubato/study/damping.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::ccx {
namespace {

using study::LawKind;
using study::Material;
using study::StrainKind;

/// Divides terms (J − 1)⁴ and (J − 1)⁶ of rubber, so that they vanish: CalculiX takes numbers of its own for
/// 0.
constexpr double no_such_term = 1e20;

std::string line_of(std::initializer_list<double> numbers) {
  std::vector<std::string> entries;
  for (const double number : numbers)
    entries.push_back(shown_number(number));
  return rows_of(entries, 8);
}

/// D1 of (J − 1)²/D1.
double compressibility(const Material& material) {
  const auto& bulk = material.hyperelasticity.bulk;
  if (bulk)
    return 2 / *bulk;
  const auto small = material::small_strain_moduli(material);
  return 6 * (1 - 2 * small.poisson) / small.young;
}

std::string rubber_lines(Run& run, const Material& material) {
  const auto& given = material.hyperelasticity;
  const double d = compressibility(material);
  if (given.volume == study::VolumeEnergy::logarithmic)
    add_note(run.draft,
             fmt::format("material {}: the energy of the change of volume is K/2 (J - 1)^2 in CalculiX, "
                         "'logarithmic' in rubato: equal for small changes of volume",
                         material.name));
  if (material.law == LawKind::yeoh)
    return "*HYPERELASTIC, YEOH\n" +
           line_of({given.c10, given.c20, given.c30, d, no_such_term, no_such_term});
  if (material.law == LawKind::ogden) {
    constexpr std::size_t most_terms = 4;
    if (given.terms.size() > most_terms)
      run.refuse("materials." + material.name + ".terms",
                 fmt::format("found {} terms; CalculiX takes {}, expected as many at most",
                             given.terms.size(), most_terms));
    std::vector<std::string> entries;
    for (const auto& term : given.terms)
      entries.insert(entries.end(), {shown_number(term.shear), shown_number(term.exponent)});
    entries.push_back(shown_number(d));
    for (std::size_t i = 1; i < given.terms.size(); ++i)
      entries.push_back(shown_number(no_such_term));
    return fmt::format("*HYPERELASTIC, OGDEN, N={}\n{}", given.terms.size(), rows_of(entries, 8));
  }
  if (given.c01 == 0)
    return "*HYPERELASTIC, NEO HOOKE\n" + line_of({given.c10, d});
  return "*HYPERELASTIC, MOONEY-RIVLIN\n" + line_of({given.c10, given.c01, d});
}

/// Constants that have no effect in plane physics and are not given are those of other directions, as in
/// rubato.
std::string orthotropic_lines(const Material& material) {
  const auto& o = material.orthotropy;
  return "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n" +
         line_of({o.young_x, o.young_y, o.young_z.value_or(o.young_x), o.poisson_xy, o.poisson_xz.value_or(0),
                  o.poisson_yz.value_or(0), o.shear_xy, o.shear_xz.value_or(o.shear_xy)}) +
         line_of({o.shear_yz.value_or(o.shear_xy)});
}

/// The axes of a material; nothing where they are those of the model.
std::string orientation_of(Run& run, const Material& material, const std::string& label) {
  const auto& o = material.orthotropy;
  const bool turned = o.angle_x != 0 || o.angle_y != 0 || o.angle_z != 0;
  if (material.law != LawKind::orthotropic || (!turned && !o.cylindrical))
    return {};
  if (o.cylindrical && turned) {
    run.refuse(
        "materials." + material.name + ".axes",
        "found axes about a line that angles turn; CalculiX has cylindrical axes without, expected angles "
        "of 0");
    return {};
  }
  if (o.cylindrical) {
    const auto& p = o.cylindrical->point;
    auto d = o.cylindrical->direction;
    if (run.is_plane())
      d = {0, 0, 1};
    run.body += fmt::format("*ORIENTATION, NAME=OR_{}, SYSTEM=CYLINDRICAL\n", label) +
                line_of({p[0], p[1], p[2], p[0] + d[0], p[1] + d[1], p[2] + d[2]});
  } else {
    const Eigen::Matrix3d axes = material::axes_of(o);
    run.body += fmt::format("*ORIENTATION, NAME=OR_{}, SYSTEM=RECTANGULAR\n", label) +
                line_of({axes(0, 0), axes(1, 0), axes(2, 0), axes(0, 1), axes(1, 1), axes(2, 1)});
  }
  return fmt::format(", ORIENTATION=OR_{}", label);
}

std::string law_lines(Run& run, const Material& material) {
  switch (material.law) {
  case LawKind::elastic:
    return "*ELASTIC\n" + line_of({material.young, material.poisson});
  case LawKind::orthotropic:
    return orthotropic_lines(material);
  case LawKind::plastic:
    return "*ELASTIC\n" + line_of({material.young, material.poisson}) + hardening_lines(run, material);
  case LawKind::hyperelastic:
  case LawKind::yeoh:
  case LawKind::ogden:
    return rubber_lines(run, material);
  case LawKind::prony:
    break;
  }
  run.refuse("materials." + material.name + ".law",
             "found the law prony; CalculiX has no viscoelasticity of shear, expected another law");
  return {};
}

std::string expansion_lines(const Run& run, const Material& material) {
  if (!material.expansion || !run.model.heat)
    return {};
  const auto& along = material.expansion->along;
  if (material.law == LawKind::orthotropic)
    return "*EXPANSION, TYPE=ORTHO\n" + line_of({along[0], along[1], along[2]});
  return "*EXPANSION\n" + line_of({along[0]});
}

std::string damping_lines(const Run& run, const Material& material) {
  const auto damping = study::rayleigh_coefficients(material);
  if ((damping.mass == 0 && damping.stiffness == 0) || run.is_static() || run.modes)
    return {};
  return fmt::format("*DAMPING, ALPHA={}, BETA={}\n", shown_number(damping.mass),
                     shown_number(damping.stiffness));
}

/// Strains of CalculiX with NLGEOM that are not those of the material.
void note_strain(Run& run, const Material& material) {
  const auto strain = study::strain_of(material);
  if (!run.nonlinear)
    return;
  if (strain == StrainKind::small)
    add_note(run.draft,
             fmt::format("material {}: NLGEOM is for all bodies in CalculiX, small strains in rubato: "
                         "equal where the bodies of the material do not turn",
                         material.name));
  if (strain == StrainKind::logarithmic && material.law != LawKind::plastic)
    add_note(run.draft,
             fmt::format("material {}: CalculiX has Green-Lagrange strains for 'logarithmic': equal "
                         "where strains are small",
                         material.name));
  if (strain == StrainKind::green_lagrange && material.law == LawKind::plastic)
    add_note(run.draft,
             fmt::format("material {}: CalculiX has logarithmic strains for 'green_lagrange': equal "
                         "where strains are small",
                         material.name));
  if (strain == StrainKind::logarithmic && material.law == LawKind::plastic)
    add_note(run.draft,
             fmt::format("material {}: yields by Cauchy's stress in CalculiX, by Kirchhoff's in rubato: "
                         "0.3 % at 20 % of strain",
                         material.name));
}

} // namespace

void write_materials(Run& run) {
  const auto& study = run.study();
  const bool plane =
      study.physics == study::Physics::plane_stress || study.physics == study::Physics::plane_strain;
  for (std::size_t i = 0; i < study.materials.size(); ++i) {
    const auto& material = study.materials[i];
    const auto& sets = run.draft.element_sets_of_law;
    if (i >= sets.size() || sets[i].empty())
      continue;
    note_strain(run, material);
    const auto label = run.draft.labels.chosen("MATERIAL " + study.name, material.name);
    run.materials.push_back(label);
    const auto orientation = orientation_of(run, material, label);
    run.body += fmt::format("*MATERIAL, NAME={}\n{}", label, law_lines(run, material));
    if (material.density.value_or(0) > 0)
      run.body += fmt::format("*DENSITY\n{}\n", shown_number(*material.density));
    run.body += expansion_lines(run, material) + damping_lines(run, material);
    for (const auto& set : sets[i])
      run.body += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL={}{}\n{}", set, label, orientation,
                              plane ? shown_number(study.thickness) + "\n" : "");
  }
}

} // namespace rubato::ccx
