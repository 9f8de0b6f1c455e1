// SPDX-License-Identifier: LGPL-3.0-or-later
// The page on mortar contact.
#include <fmt/format.h>

#include "verification/edge_drag.hpp"
#include "verification/hertz.hpp"
#include "verification/mortar_beams.hpp"
#include "verification/mortar_drag.hpp"
#include "verification/mortar_hertz.hpp"
#include "verification/mortar_patch.hpp"
#include "verification/mortar_runs.hpp"
#include "verification/signorini.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rubato::verification {
namespace {

constexpr std::array plane_cells{CellType::quad4, CellType::quad8, CellType::quad9,
                                 CellType::tria3, CellType::tria6, CellType::tria7};
constexpr std::array solid_cells{CellType::hexa8,   CellType::hexa20, CellType::hexa27, CellType::tetra4,
                                 CellType::tetra10, CellType::penta6, CellType::penta15};

std::string name_of(CellType cells) {
  return std::string(cell::topology(cells).name);
}

std::string percent(double part) {
  return fmt::format("{:+.2f} %", 100 * part);
}

void write_pairs(Page& page, std::span<const CellType> cells) {
  std::vector<std::string> columns{"slave on master"};
  for (const auto layout : layouts)
    columns.emplace_back(name_of(layout));
  page.table(columns);
  for (const auto slave : cells)
    for (const auto master : cells) {
      std::vector<std::string> row{fmt::format("{} on {}", name_of(slave), name_of(master))};
      for (const auto layout : layouts) {
        const auto found = press_by_mortar(slave, master, layout);
        row.push_back(found.failure.empty()
                          ? fmt::format("{:.0e}, {:.0e}", found.pressure, found.displacement)
                          : found.failure);
      }
      page.row(row);
    }
}

void write_patches(Page& page) {
  page.paragraph("## Patch test");
  page.paragraph(
      "Two blocks of side 1, E = 2e6, ν = 0, are pressed on one another by 0.1 (tests/verification/"
      "mortar_patch.hpp): the pressure is 1e5 everywhere and the interface moves by −0.05. Each entry has "
      "the "
      "largest deviation of a nodal pressure, in parts of 1e5, and of the displacement along the push, in "
      "parts of 0.1. The upper block, with 3 cells a side where nothing else is said, is the slave, the "
      "lower one has 4. What the other block does not cover of a surface is loaded by 1e5. *Curved edges* "
      "are curved within the surface, where chords stand for them.");
  write_pairs(page, plane_cells);
  page.paragraph("In space:");
  write_pairs(page, solid_cells);
  page.paragraph("Two discs on the axis of revolution, 4 cells on 3, under pressure: largest deviation of a "
                 "nodal pressure, the node on the axis included.");
  std::vector<std::string> columns{"slave on master"};
  for (const auto below : plane_cells)
    columns.push_back(name_of(below));
  page.table(columns);
  for (const auto cells : plane_cells) {
    std::vector<std::string> row{name_of(cells)};
    for (const auto below : plane_cells)
      row.push_back(fmt::format("{:.0e}", press_discs(cells, below)));
    page.row(row);
  }
}

void write_half_loaded(Page& page) {
  page.paragraph("## A block loaded on half of its roof");
  page.paragraph("4 cells a side on 3, μ = 0.3; nothing but contact holds the upper block.");
  page.table({"cells", "contact force over the load, less 1", "slave nodes lifted off", "iterations"});
  for (const auto cells : solid_cells) {
    const auto found = load_half_block(cells);
    if (found.failure.empty())
      page.row({name_of(cells), fmt::format("{:.0e}", found.reaction), std::to_string(found.open),
                std::to_string(found.iterations)});
    else
      page.row({name_of(cells), found.failure, "", ""});
  }
}

void write_shrink_fit(Page& page) {
  page.paragraph("## Shrink fit");
  page.paragraph(fmt::format(
      "A ring of radii 19.95 and 40 on a shaft of radius 20, both 20 long, of one material (E = 210e3, ν = "
      "0.3), axisymmetric; 13k cells on 10k along the axis, the ring is the slave. Lamé: {:.2f} with the "
      "ends held, {:.2f} with free ends, on the ring's undeformed area. With free ends the shaft grows "
      "beyond the ring, whose edge presses without bound: the middle 80 % of the length can be compared.",
      lame_pressure(true), lame_pressure(false)));
  page.table({"ends", "cells", "k", "mortar: largest error", "root mean square", "middle 80 %", "iterations",
              "nodes: largest error", "root mean square", "middle 80 %", "iterations"});
  for (const bool held : {true, false})
    for (const auto cells : {CellType::quad4, CellType::quad8})
      for (const int k : {1, 2, 4}) {
        std::vector<std::string> row{held ? "held" : "free", name_of(cells), std::to_string(k)};
        for (const auto* integration : {"mortar", "nodes"}) {
          const auto errors = shrink({cells, k, held, integration});
          for (const double error : {errors.largest, errors.rms, errors.interior})
            row.push_back(errors.converged ? fmt::format("{:.1e}", error) : "no end");
          row.push_back(std::to_string(errors.iterations));
        }
        page.row(row);
      }
}

void write_solid_rings(Page& page) {
  page.paragraph(fmt::format(
      "In space, a quarter of the ring on a shaft with a bore of radius 5, ends held; cells along the "
      "radius, "
      "round a quarter and along the axis. Lamé: {:.2f}. The middle 80 % is that of the length and of the "
      "quarter.",
      lame_pressure(true, 5)));
  page.table({"cells", "shaft", "ring", "mesh nodes", "integration", "largest error", "root mean square",
              "middle 80 %", "iterations"});
  const auto shown = [](const std::array<int, 3>& n) {
    return fmt::format("{} × {} × {}", n[0], n[1], n[2]);
  };
  const auto row = [&](const SolidRing& fit) {
    const auto errors = shrink_in_space(fit);
    std::vector<std::string> values{name_of(fit.cells), shown(fit.shaft), shown(fit.ring),
                                    std::to_string(errors.nodes), fit.integration};
    for (const double error : {errors.largest, errors.rms, errors.interior})
      values.push_back(errors.converged ? fmt::format("{:.1e}", error) : "no end");
    values.push_back(std::to_string(errors.iterations));
    page.row(values);
  };
  for (const auto* integration : {"mortar", "nodes"}) {
    row({CellType::hexa8, {8, 18, 14}, {9, 21, 16}, integration});
    row({CellType::hexa20, {8, 18, 14}, {9, 21, 16}, integration});
    row({CellType::tetra10, {6, 14, 12}, {7, 16, 13}, integration});
  }
}

void write_round(Page& page, const RoundOnBlock& bodies) {
  const auto found = press_round(bodies);
  std::vector<std::string> row{name_of(bodies.cells), std::to_string(bodies.faces),
                               bodies.round_is_slave ? "round" : "block", bodies.integration};
  if (found.failure.empty())
    for (const double part : {found.centre, found.inside, found.anywhere, found.rms})
      row.push_back(fmt::format("{:.2f} %", 100 * part));
  else
    row.insert(row.end(), {found.failure, "", "", ""});
  for (const double part : {found.peak, found.radius})
    row.push_back(found.failure.empty() ? percent(part) : "");
  row.insert(row.end(), {std::to_string(found.iterations), std::to_string(found.nodes),
                         fmt::format("{:.1f}", found.seconds)});
  page.row(row);
}

const std::vector<std::string> round_columns{"cells",  "faces in a",    "slave",      "integration",
                                             "centre", "within 0.85 a", "anywhere",   "root mean square",
                                             "peak",   "radius",        "iterations", "nodes",
                                             "s"};

void write_rounds(Page& page) {
  page.paragraph("## Hertz");
  page.paragraph("A cylinder of radius 20 on a block, a = 1, plane strain; the faces of the block are 1.2 "
                 "times as wide. Errors of nodal pressures in parts of p₀; peak and radius are those of the "
                 "ellipse nearest to the squares of the pressures.");
  page.table(round_columns);
  for (const auto cells : {CellType::quad4, CellType::quad8, CellType::quad9, CellType::tria6})
    for (const int faces : {10, 20})
      for (const bool round_is_slave : {true, false})
        for (const auto* integration : {"mortar", "nodes"})
          write_round(page, {cells, faces, round_is_slave, integration});
  page.paragraph("A paraboloid of radius 20 on a block, in space, a quarter of both:");
  page.table(round_columns);
  for (const auto cells : {CellType::hexa8, CellType::hexa20, CellType::tetra10})
    write_round(page, {cells, 10, true, "mortar"});
  write_round(page, {CellType::hexa8, 10, true, "nodes"});
}

struct Range {
  double least = 1e300, most = -1e300;
  void take(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// The steps after the first `skipped`.
template <class Value> Range range_of(const Dragged& dragged, std::size_t skipped, Value value) {
  Range range;
  for (std::size_t i = skipped; i < dragged.steps.size(); ++i)
    range.take(value(dragged.steps[i]));
  return range;
}

void write_drag(Page& page, const Drag& how, const std::string& moves) {
  const auto found = drag(how);
  std::vector<std::string> row{name_of(how.cells), how.integration, how.block_is_slave ? "block" : "plate",
                               fmt::format("{}", how.strain), moves};
  if (!found.failure.empty()) {
    page.row({row[0], row[1], row[2], row[3], row[4], found.failure, "", "", "", ""});
    return;
  }
  constexpr std::size_t sliding = 3; // the block has left its first stick
  const auto iterations = range_of(found, 0, [](const auto& step) { return step.iterations; });
  const auto ratio = range_of(found, sliding, [](const auto& step) { return step.ratio; });
  const auto normal = range_of(found, sliding, [](const auto& step) { return step.normal; });
  const auto total =
      range_of(found, sliding, [](const auto& step) { return step.normal * std::hypot(1.0, step.ratio); });
  const auto direction = range_of(found, sliding, [](const auto& step) { return step.direction; });
  row.insert(row.end(), {fmt::format("{:.0f} to {:.0f}", iterations.least, iterations.most),
                         fmt::format("{:.5f} to {:.5f}", ratio.least, ratio.most),
                         fmt::format("{:.2f} %", 100 * (normal.most / normal.least - 1)),
                         fmt::format("{:.2f} %", 100 * (total.most / total.least - 1)),
                         fmt::format("{:.3f}", direction.most)});
  page.row(row);
}

const std::vector<std::string> drag_columns{
    "cells",      "integration", "slave",       "strain",   "moves",
    "iterations", "T/N",         "N varies by", "total by", "off its direction by [°]"};

void write_drags(Page& page) {
  page.paragraph("## Drag");
  page.paragraph(
      "A block pressed on a plate by the strain and dragged, μ = 0.3; moves in faces of the block. "
      "T/N, how much N and the total force vary, and the angle between friction and what opposes "
      "the move, all from the third move on.");
  page.paragraph("5 faces on 17, plane strain:");
  page.table(drag_columns);
  for (const auto cells : {CellType::quad4, CellType::quad8})
    for (const double strain : {0.0007, 0.007})
      for (const bool block_is_slave : {true, false}) {
        write_drag(page, {cells, 1, 0.3, strain, block_is_slave, straight(0.5, 8)}, "8 × 0.5");
        write_drag(page, {cells, 1, 0.3, strain, block_is_slave, straight(1.75, 3)}, "3 × 1.75");
      }
  write_drag(page, {CellType::quad4, 1, 0.3, 0.0007, true, straight(0.5, 8), "nodes"}, "8 × 0.5");
  page.paragraph("3 × 3 faces on 7 × 7:");
  page.table(drag_columns);
  for (const double degrees : {0.0, 37.0})
    for (const double strain : {0.0008, 0.008})
      for (const auto cells : {CellType::hexa8, CellType::hexa20, CellType::tetra10})
        write_drag(page, {cells, 1, 0.3, strain, true, straight(0.5, 4, degrees)},
                   fmt::format("4 × 0.5 at {}°", degrees));
  for (const auto* integration : {"mortar", "nodes"})
    write_drag(page, {CellType::hexa8, 2, 0.3, 0.0008, true, straight(0.5, 8), integration},
               "8 × 0.5 at 0°, twice as fine");
}

void write_edge(Page& page, const char* shape, const EdgeDrag& how) {
  auto rubbing = how;
  rubbing.friction = 0.1;
  const auto smooth = drag_edge(how), rough = drag_edge(rubbing);
  const std::vector<std::string> what{shape, fmt::format("{}", how.degrees), name_of(how.cells),
                                      how.rail_is_slave ? "rail" : "body"};
  const auto failure = smooth.failure.empty() ? rough.failure : smooth.failure;
  if (!failure.empty()) {
    page.row({what[0], what[1], what[2], what[3], failure, "", "", ""});
    return;
  }
  page.row({what[0], what[1], what[2], what[3], fmt::format("{:.0e}", smooth.drag),
            fmt::format("{:.0e}", smooth.impact), fmt::format("{:.4f}", rough.drag),
            fmt::format("{:.1f}, {:.1f}", smooth.iterations, rough.iterations)});
}

void write_edges(Page& page) {
  page.paragraph("## Edges on a smooth rail");
  page.paragraph(
      "A body is pressed on a rail and dragged over twelve of its faces (four of HEXA20 and TETRA10): a "
      "block "
      "that is tilted about its edge, one that is flat over two thirds and then rises (ski), one that falls "
      "at half of the slope "
      "and then rises (wedge). Without friction: mean drag over mean N, which is 0, and what contact took "
      "of the energy, over the largest strain energy. With μ = 0.1: mean drag over mean N. Iterations a "
      "step without and with friction.");
  page.table({"body", "degrees", "cells", "slave", "drag/N, μ = 0", "energy taken", "drag/N, μ = 0.1",
              "iterations"});
  for (const auto cells : {CellType::quad4, CellType::quad8, CellType::tria6, CellType::hexa8,
                           CellType::hexa20, CellType::tetra10})
    for (const bool rail_is_slave : {false, true}) {
      const bool all = cells == CellType::quad4;
      for (const double degrees : all ? std::vector{0.5, 2., 5., 10., 20., 45.} : std::vector{2., 20.})
        write_edge(page, "tilted block", {Profile::tilted, degrees, cells, rail_is_slave});
      for (const double degrees : all ? std::vector{2.9, 10., 14., 30.} : std::vector{10.}) {
        write_edge(page, "ski", {Profile::ski, degrees, cells, rail_is_slave});
        write_edge(page, "wedge", {Profile::wedge, degrees, cells, rail_is_slave});
      }
    }
}

void write_trial(Page& page) {
  page.paragraph("## Drag, turn, reverse");
  page.paragraph(
      "The same in space: pressed, two moves of half a face along x, two turned by 143°, two back. "
      "Iterations of each step, with the attempts if there was more than one.");
  page.table({"cells", "μ", "strain", "slave", "pressed", "along x", "", "turned", "", "reversed", ""});
  for (const auto cells : {CellType::hexa8, CellType::hexa20, CellType::tetra10})
    for (const double friction : {0.3, 0.8})
      for (const double strain : {0.0008, 0.008})
        for (const bool block_is_slave : {true, false}) {
          const auto found = drag({cells, 1, friction, strain, block_is_slave, turned_and_reversed()});
          std::vector<std::string> row{name_of(cells), fmt::format("{}", friction), fmt::format("{}", strain),
                                       block_is_slave ? "block" : "plate"};
          for (const auto& step : found.steps)
            row.push_back(step.attempts == 1 ? std::to_string(step.iterations)
                                             : fmt::format("{} ({})", step.iterations, step.attempts));
          row.resize(11, found.failure);
          page.row(row);
        }
}

/// What a closed solution says, and what the two integrations give.
void write_cylinders(Page& page) {
  page.paragraph("## Cases with `integration: mortar`");
  page.table({"", "theory", "mortar", "nodes"});
  const auto row = [&](const char* name, double theory, double mortar, double nodes) {
    page.row({name, fmt::format("{:.4f}", theory),
              fmt::format("{:.4f} ({})", mortar, percent(mortar / theory - 1)),
              fmt::format("{:.4f} ({})", nodes, percent(nodes / theory - 1))});
  };
  const std::vector<deck::Setting> by_mortar{{"contact.interface.integration", "mortar"}};
  CaseRuns cylinder("v4_hertz_cylinder/cylinder.yaml", by_mortar), before("v4_hertz_cylinder/cylinder.yaml");
  const auto mortar = surface_at_end(cylinder["run"]), nodes = surface_at_end(before["run"]);
  row("V4, half-width of the ellipse through p² [mm]", v4_theory().half_width,
      fitted_ellipse(mortar).half_width, fitted_ellipse(nodes).half_width);
  row("V4, peak of the ellipse [MPa]", v4_theory().peak, fitted_ellipse(mortar).peak,
      fitted_ellipse(nodes).peak);
  row("V4, largest pressure at a node [MPa]", v4_theory().peak, largest_pressure(mortar),
      largest_pressure(nodes));
  CaseRuns pushed("v5_cattaneo_mindlin/cylinder.yaml", by_mortar),
      pushed_before("v5_cattaneo_mindlin/cylinder.yaml");
  const auto& with = pushed["pushed"];
  const auto& without = pushed_before["pushed"];
  row("V5, half-width of stick [mm], in cells of 0.2", mindlin_theory(with).stick,
      stick_half_width(surface_at_end(with)), stick_half_width(surface_at_end(without)));
  page.row({"V5, q/(μ p₀), root mean square of the difference", "",
            fmt::format("{:.4f}", traction_error(surface_at_end(with), mindlin_theory(with))),
            fmt::format("{:.4f}", traction_error(surface_at_end(without), mindlin_theory(without)))});
}

void write_orders(Page& page) {
  page.paragraph(
      "V9, a block on a rigid cylinder: error in the energy norm against 128 × 128 QUAD9 with nodes, "
      "and the mean order.");
  page.table({"cells", "integration", "4 × 4", "8 × 8", "16 × 16", "32 × 32", "order"});
  constexpr std::array divisions{4, 8, 16, 32};
  for (const auto cells : {CellType::quad4, CellType::quad8, CellType::quad9})
    for (const auto* integration : {"mortar", "nodes"}) {
      const auto errors = signorini_errors(cells, divisions, 128, integration);
      std::vector<std::string> row{name_of(cells), integration};
      for (const double error : errors)
        row.push_back(fmt::format("{:.3e}", error));
      row.push_back(fmt::format("{:.2f}", std::log2(errors.front() / errors.back()) /
                                              static_cast<double>(errors.size() - 1)));
      page.row(row);
    }
}

void write_deflections(Page& page, const RefinedBeams& beams) {
  std::vector<std::string> row{beams.modeling == "f" ? "F" : "C", name_of(beams.cells),
                               beams.matching ? "20 on 20" : "20 on 17", std::to_string(beams.fineness),
                               beams.integration};
  try {
    const auto found = deflect(beams);
    for (const double y : found.y)
      row.push_back(fmt::format("{:.5f}", y));
    row.push_back(fmt::format("{:.1e}", std::abs(found.y[1] / converged_deflections[1] - 1)));
    for (const int count : {found.steps, found.cuts, found.iterations})
      row.push_back(std::to_string(count));
    row.push_back(fmt::format("{:.1f}", found.seconds));
  } catch (const std::runtime_error& error) {
    row.emplace_back(error.what());
    row.resize(13);
  }
  page.row(row);
}

void write_beams(Page& page) {
  page.paragraph("## SDNL140, refined");
  page.paragraph(fmt::format(
      "Two beams of 20 × 2 cells, or 20 and 17, with k times as many along every edge; steps of 2e-5 s, HHT "
      "with α = −0.05, a true start. An independent explicit computation, refined until converged, has "
      "{:.4f}, "
      "{:.4f} and {:.4f} m at 1, 6 and 12 ms. Error: at 6 ms, in parts of that.",
      converged_deflections[0], converged_deflections[1], converged_deflections[2]));
  page.table({"modeling", "cells", "upper on lower", "k", "integration", "DY(1 ms) (m)", "DY(6 ms) (m)",
              "DY(12 ms) (m)", "error", "steps", "cuts", "iterations", "s"});
  const auto both = [&](RefinedBeams beams) {
    for (const auto* integration : {"mortar", "nodes"}) {
      beams.integration = integration;
      write_deflections(page, beams);
    }
  };
  for (const auto cells : {CellType::quad4, CellType::quad9})
    for (const bool matching : {true, false})
      for (const int k : {1, 2, 4, 8})
        if (cells == CellType::quad4 || k < 8)
          both({.cells = cells, .fineness = k, .matching = matching});
  for (const bool matching : {true, false})
    for (const int k : {1, 2, 4})
      both({.modeling = "c", .cells = CellType::hexa8, .fineness = k, .matching = matching});
  both({.modeling = "c", .cells = CellType::hexa20});
}

} // namespace

void write_mortar(const std::filesystem::path& folder) {
  Page page(folder / "mortar.md", "Mortar contact, measured");
  write_patches(page);
  write_half_loaded(page);
  write_shrink_fit(page);
  write_solid_rings(page);
  write_rounds(page);
  write_drags(page);
  write_edges(page);
  write_trial(page);
  write_cylinders(page);
  write_orders(page);
  write_beams(page);
}

} // namespace rubato::verification
