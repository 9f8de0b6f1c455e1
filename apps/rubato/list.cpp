// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/obstacle.hpp"
#include "rubato/deck/schema.hpp"
#include "rubato/mesh/io/inp_keywords.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/study/contact_methods.hpp"
#include "rubato/study/hardenings.hpp"
#include "rubato/study/material_laws.hpp"
#include "rubato/study/schemes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include <tuple>
#include <utility>

namespace rubato::app {

int schema() {
  fmt::print("{}", deck::schema());
  return done;
}

namespace {

/// Those of .inp files that become something.
void list_keywords() {
  using rubato::mesh::inp::Use;
  fmt::print("\nKeywords of .inp files (Abaqus, CalculiX) and what they become\n");
  for (const auto& keyword : rubato::mesh::inp::all_keywords())
    if (!keyword.note.empty() && keyword.use != Use::unavailable)
      fmt::print("  {:<31} {}\n", fmt::format("*{}", keyword.name), keyword.note);
}

} // namespace

int list() {
  fmt::print("Cells\n");
  for (const auto& cell : rubato::cell::all_topologies())
    fmt::print("  {:<10} dimension {}, {:>2} nodes{}\n", cell.name, cell.dimension, cell.node_count,
               cell::has_reference_cell(cell.type) ? "" : "   (in mesh files only)");
  fmt::print("\nTime schemes (time.scheme)\n");
  for (const auto& scheme : study::schemes)
    fmt::print("  {:<31} {:<36} {}\n", scheme.name, scheme.code_aster, scheme.summary);
  fmt::print("\nContact methods (contact.ZONE.method)\n");
  for (const auto& method : study::contact_methods)
    fmt::print("  {:<31} {:<36} {}\n", method.name, method.code_aster, method.summary);
  fmt::print("\nFriction methods (contact.ZONE.friction_method)\n");
  for (const auto& method : study::friction_methods)
    fmt::print("  {:<31} {:<36} {}\n", method.name, method.code_aster, method.summary);
  fmt::print("\nContact points (contact.ZONE.integration)\n");
  for (const auto& rule : study::contact_integrations)
    fmt::print("  {:<31} {:<36} {}\n",
               rule.most_order > 0 ? fmt::format("{}: n", rule.name) : std::string(rule.name),
               rule.code_aster, rule.summary);
  fmt::print("\nNested levels (contact.ZONE.iterate: geometry, friction, status)\n");
  for (const auto& [name, code_aster, summary] :
       {std::tuple{"newton", "ALGO_RESO_*='NEWTON'", "part of every Newton iteration"},
        {"fixed_point", "ALGO_RESO_*='POINT_FIXE'", "a loop of its own around them"}})
    fmt::print("  {:<31} {:<36} {}\n", name, code_aster, summary);
  fmt::print("\nRigid obstacles (contact.ZONE.obstacle)\n");
  for (const auto& obstacle : contact::all_obstacles())
    fmt::print("  {:<31} {}\n", obstacle.name, obstacle.summary);
  fmt::print("\nPhysics (physics)\n");
  for (const auto& [name, summary] : {std::pair{"solid", "3D"},
                                      {"plane_stress", "2D, with thickness"},
                                      {"plane_strain", "2D, with thickness"},
                                      {"axisymmetric", "2D, x is the radius"}})
    fmt::print("  {:<31} {}\n", name, summary);
  fmt::print("\nMaterial laws (materials.NAME.law)\n");
  for (const auto& law : study::material_laws)
    fmt::print("  {:<31} {:<36} {}\n", law.name, law.code_aster, law.summary);
  fmt::print("\nHardening of the law plastic (materials.NAME.hardening)\n");
  for (const auto& hardening : study::hardenings)
    fmt::print("  {:<31} {:<36} {}\n", hardening.name, hardening.code_aster, hardening.summary);
  fmt::print("\nStrains (materials.NAME.strain)\n");
  for (const auto& [name, code_aster, summary] :
       {std::tuple{"small", "DEFORMATION='PETIT'", "small turns and strains"},
        {"green_lagrange", "DEFORMATION='GROT_GDEP'",
         "large turns, small strains; large ones of hyperelastic laws"},
        {"logarithmic", "DEFORMATION='GDEF_LOG'", "large turns and strains"}})
    fmt::print("  {:<31} {:<36} {}\n", name, code_aster, summary);
  fmt::print("\nFormulations of cells (materials.NAME.formulation)\n");
  for (const auto& [name, summary] :
       {std::pair{"full", "every cell: all points of the rule"},
        {"mean_dilatation", "all but TRIA3, TETRA4, pyramids: the mean change of volume; plasticity, rubber"},
        {"enhanced", "QUAD4, HEXA8: own modes of the cell; bending with few layers"}})
    fmt::print("  {:<31} {}\n", name, summary);
  fmt::print("\nMesh files\n");
  for (const auto& format : rubato::mesh::all_formats())
    fmt::print("  {:<31} {}\n", fmt::format("{}", fmt::join(format.endings, ", ")), format.summary);
  list_keywords();
  return done;
}

} // namespace rubato::app
