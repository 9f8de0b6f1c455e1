// SPDX-License-Identifier: LGPL-3.0-or-later
// Each thing that can be wrong with a deck: one sentence at the place where it stands.
#include <gtest/gtest.h>

#include "sample_deck.hpp"

namespace rubato::deck::faults_test {
namespace {

using test::faults_of, test::faults_of_explicit, test::faults_of_zone;
using test::full_deck;
using test::place_of;
using test::replaced;
using test::Sentences;
using test::smallest_deck;

/// The full deck with `old` replaced has one fault: `sentence` where `marker` first stands.
struct Mistake {
  const char* old;
  const char* replacement;
  const char* marker;
  const char* sentence;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << '"' << mistake.replacement << '"';
}

class FullDeckWith : public ::testing::TestWithParam<Mistake> {};

TEST_P(FullDeckWith, OneMistakeHasOneSentenceAtItsPlace) {
  const auto& mistake = GetParam();
  const auto deck = replaced(full_deck, mistake.old, mistake.replacement);
  EXPECT_EQ(faults_of(deck), Sentences{place_of(deck, mistake.marker) + ": " + mistake.sentence});
}

const Mistake key_mistakes[] = {
    {"title:", "tilte:", "tilte", "unknown key 'tilte'; did you mean 'title'?"},
    {"  alpha:", "  begn: 1\n  alpha:", "begn", "unknown key 'time.begn'; did you mean 'begin'?"},
    {"friction: 0.2", "frction: 0.2", "frction",
     "unknown key 'contact.interface.frction'; did you mean 'friction'?"},
    {"fix: [x, y]", "fixx: [x, y], fix: x", "fixx", "unknown key 'supports.0.fixx'; did you mean 'fix'?"},
    {"every: 20", "evry: 20", "evry", "unknown key 'checkpoint.evry'; did you mean 'every'?"},
    {"checkpoint:", "checkpint:", "checkpint", "unknown key 'checkpint'; did you mean 'checkpoint'?"},
    {"mass: 2", "Mas: 2", "Mas", "unknown key 'materials.steel.rayleigh.Mas'; did you mean 'mass'?"},
    {"    density: 7800", "    yuong: 1\n    density: 7800", "yuong",
     "unknown key 'materials.steel.yuong'; did you mean 'young'?"},
    {"nodal_force", "nodl_force", "nodl", "unknown key 'loads.0.nodl_force'; did you mean 'nodal_force'?"},
    {"right_top: Force", "rigth_top: Force", "rigth",
     "unknown key 'mesh.generate.0.points.rigth_top'; did you mean 'right_top'?"},
    {"    young: 200e9\n", "", "poisson", "materials.steel: 'young' is missing"},
    {"    poisson: 0.25\n", "", "young", "materials.steel: 'poisson' is missing"},
    {"    density: 7800\n", "", "steel",
     "materials.steel: 'density' is missing: the scheme hht moves masses"},
    {"    slave: Beneath\n", "", "master", "contact.interface: 'slave' is missing"},
    {"  alpha: -0.3\n", "", "scheme", "time: 'alpha' is missing"},
    {"  step: 1e-3\n", "", "scheme", "time: 'step' is missing"},
    {"on: Clamped, fix", "fix", "{fix", "supports.0: 'on' is missing"},
    {"on: Force, ", "", "{y: -1e7", "loads.0.nodal_force: 'on' is missing"},
    {"value: 0.2, ", "", "{function: ramp", "supports.1.y: 'value' is missing"},
    {"      divisions: [20, 2]\n", "", "name: upper", "mesh.generate.0: 'divisions' is missing"},
    {", tolerance: 1e-3", "", "{probe", "checks.0: 'tolerance' is missing"},
    {"on: End, x: 1e4", "x: 1e4", "{x: 1e4", "springs.0: 'on' is missing"},
    {"on: lower, velocity", "velocity", "{velocity", "initial.0: 'on' is missing"},
    {"displacement: {y: 1e-3}", "displcement: {y: 1e-3}", "displcement",
     "unknown key 'initial.1.displcement'; did you mean 'displacement'?"},
};

const Mistake type_mistakes[] = {
    {"thickness: 0.5", "thickness: 5mm", "5mm", "thickness: found '5mm', expected a number > 0"},
    {"step: 1e-3", "step: 1e-3s", "1e-3s", "time.step: found '1e-3s', expected a number > 0"},
    {"step: 1e-3", "step: '1e-3'", "'1e-3'", "time.step: found the text '1e-3', expected a number > 0"},
    {"step: 1e-3", "step: [1e-3]", "[1e-3]", "time.step: found a list, expected a number > 0"},
    {"step: 1e-3", "step:", "step:", "time.step: found nothing, expected a number > 0"},
    {"x: 0.1", "x: inf", "inf",
     "supports.1.x: found 'inf', expected a number or an expression of x, y, z and t: unknown name 'inf' at "
     "character 1; expected one of x, y, z, t, pi, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, "
     "log, log10, sqrt, abs, floor, ceil, sign, atan2, if, min, max"},
    {"x: 0.1", "x: .nan", ".nan",
     "supports.1.x: found '.nan', expected a number or an expression of x, y, z and t: no number, or one "
     "that is "
     "out of range, begins at character 1"},
    {"x: 0.1", "x: 1e999", "1e999",
     "supports.1.x: found '1e999', expected a number or an expression of x, y, z and t: no number, or one "
     "that is "
     "out of range, begins at character 1"},
    {"x: 0.1", "x: 0x10", "0x10",
     "supports.1.x: found '0x10', expected a number or an expression of x, y, z and t: a number is followed "
     "by "
     "'x' at character 2, expected an operator"},
    {"refine: 2", "refine: 2.0", "2.0", "mesh.refine: found '2.0', expected a whole number from 1 to 1000"},
    {"levels: 6", "levels: 99999999999", "99999999999",
     "time.on_failure.levels: found '99999999999', expected a whole number from 0 to 50"},
    {"last: false", "last: no", "no}", "fields.last: found 'no', expected one of true, false"},
    {"scheme: hht", "scheme: hth", "hth",
     "time.scheme: found 'hth', expected one of newmark, hht, modified_average_acceleration, "
     "generalized_alpha, wbz_alpha, moreau_jean, energy_momentum, static, central_difference; did you "
     "mean 'hht'?"},
    {"formats: [vtu, med]", "formats: [vtu, vtk]", "vtk",
     "fields.formats.1: found 'vtk', expected one of vtu, med, vtkhdf, frd; did you mean 'vtu'?"},
    {"newton: {max_iterations: 25, residual: 1e-9}", "newton: 25", "25\nprobes",
     "newton: found '25', expected a map"},
    {"[0, 1, 2]", "0", "0, values", "functions.ramp.times: found '0', expected a list"},
    {"young: 200e9", "law: elastik\n    young: 200e9", "elastik",
     "materials.steel.law: found 'elastik', expected one of elastic, orthotropic, plastic, prony, "
     "hyperelastic, yeoh, ogden; did you mean 'elastic'?"},
    {"young: 200e9\n    poisson: 0.25", "law: ortotropic\n    young_x: 9", "ortotropic",
     "materials.steel.law: found 'ortotropic', expected one of elastic, orthotropic, plastic, prony, "
     "hyperelastic, yeoh, ogden; did you mean "
     "'orthotropic'?"},
    {"title: two beams", "title: [two]", "[two]", "title: found a list, expected text"},
    {"on: Above, value", "on: '', value", "'', value",
     "loads.3.pressure.on: found the text '', expected a name"},
    {"integration: {gauss: 3}", "integration: gauss", "gauss",
     "contact.interface.integration: found 'gauss', expected nodes or {gauss: n} or {simpson: n} or mortar"},
    {"tip: {", "t.p: {node: A}\n  tip: {", "t.p",
     "probes: found the name 't.p', expected up to 100 letters, digits, "
     "'_' or '-'"},
};

const Mistake range_mistakes[] = {
    {"young: 200e9", "young: 0", "0\n    poisson", "materials.steel.young: found '0', expected a number > 0"},
    {"0.25", "0.5", "0.5\n    density",
     "materials.steel.poisson: found '0.5', expected a number between -1 and 0.5"},
    {"0.25", "-1", "-1\n", "materials.steel.poisson: found '-1', expected a number between -1 and 0.5"},
    {"    density: 7800", "    shear_xy: 1\n    density: 7800", "1\n    density",
     "materials.steel.shear_xy: the law elastic takes no shear_xy, orthotropic takes it; a run removes it by "
     "'shear_xy: ~'"},
    {"young: 200e9\n    poisson: 0.25",
     "law: orthotropic\n    young_x: -9\n    young_y: 4\n    poisson_xy: 0.3\n    shear_xy: 2\n    # end",
     "-9", "materials.steel.young_x: found '-9', expected a number > 0"},
    {"young: 200e9\n    poisson: 0.25",
     "law: orthotropic\n    young_x: 9\n    young_y: 4\n    poisson_xy: 0.3\n    # end", "law: ortho",
     "materials.steel: 'shear_xy' is missing"},
    {"young: 200e9\n    poisson: 0.25",
     "law: orthotropic\n    young_x: 9\n    young_y: 4\n    poisson_xy: 0.3\n    shear_xy: 2\n    yung_z: "
     "3\n    # end",
     "yung_z", "unknown key 'materials.steel.yung_z'; did you mean 'young_z'?"},
    {"young: 200e9\n    poisson: 0.25",
     "law: orthotropic\n    young_x: 9\n    young_y: 4\n    poisson_xy: 0.3\n    shear_xy: 2\n    young: 3\n "
     "   # end",
     "3\n    # end",
     "materials.steel.young: the law orthotropic takes no young, elastic, plastic and prony take it; a run "
     "removes it by "
     "'young: ~'"},
    {"young: 200e9\n    poisson: 0.25",
     "law: orthotropic\n    young_x: 9\n    young_y: 4\n    poisson_xy: 1.6\n    shear_xy: 2\n    # end",
     "1.6",
     "materials.steel.poisson_xy: found 1.6, expected a number between -1.5 and 1.5, the roots of "
     "young_x/young_y: else a strain has no positive energy"},
    {"young: 200e9\n    poisson: 0.25",
     "law: orthotropic\n    young_x: 9\n    young_y: 4\n    poisson_xy: 0.3\n    shear_xy: 2\n    angle_y: "
     "30\n    # end",
     "30\n    # end",
     "materials.steel.angle_y: found 30, but axes turn in the plane only in plane_stress, expected angle_z"},
    {"7800", "-7800", "-7800", "materials.steel.density: found '-7800', expected a number >= 0"},
    {"thickness: 0.5", "thickness: 0", "0\nmaterials", "thickness: found '0', expected a number > 0"},
    {"friction: 0.2", "friction: -0.2", "-0.2",
     "contact.interface.friction: found '-0.2', expected a number >= 0"},
    {"gauss: 3", "gauss: 8", "8}",
     "contact.interface.integration.gauss: found '8', expected a whole number from 1 "
     "to 7"},
    {"gauss: 3", "gauss: 0", "0}\n    clamped",
     "contact.interface.integration.gauss: found '0', expected a whole number from 1 to 7"},
    {"normal: 1e9", "normal: 0", "0, tangential",
     "contact.interface.coefficients.normal: found '0', expected a number > 0"},
    {"-0.3", "-0.34", "-0.34", "time.alpha: found '-0.34', expected a number from -0.333333 to 0"},
    {"scheme: hht\n  alpha: -0.3", "scheme: modified_average_acceleration\n  alpha: 0.1", "0.1\n  begin",
     "time.alpha: found '0.1', expected a number <= 0"},
    {"scheme: hht\n  alpha: -0.3", "scheme: wbz_alpha\n  alpha: -1.1", "-1.1",
     "time.alpha: found '-1.1', expected a number from -1 to 0"},
    {"scheme: hht\n  alpha: -0.3", "scheme: generalized_alpha\n  spectral_radius: 1.1", "1.1",
     "time.spectral_radius: found '1.1', expected a number from 0 to 1"},
    {"scheme: hht\n  alpha: -0.3", "scheme: newmark\n  beta: 0", "0\n  begin",
     "time.beta: found '0', expected a number between 0 and 1"},
    {"scheme: hht\n  alpha: -0.3", "scheme: newmark\n  gamma: 0.4", "0.4",
     "time.gamma: found '0.4', expected a number from 0.5 to 2"},
    {"step: 1e-3", "step: -1e-3", "-1e-3", "time.step: found '-0.001', expected a number > 0"},
    {"step: 1e-3", "step: 1", "1\n  end",
     "time.step: found 1, expected at most the length of the run, 0.012"},
    {"step: 1e-3", "step: 1e-300", "1e-300", "time.step: found 1e-300, which makes more than 1e+09 steps"},
    {"cut: 4", "cut: 1", "1, levels",
     "time.on_failure.cut: found '1', expected a whole number from 2 to 1000"},
    {"max_iterations: 25", "max_iterations: 0", "0, residual",
     "newton.max_iterations: found '0', expected a whole number from 1 to 1e+06"},
    {"residual: 1e-9", "residual: 1", "1}\nprobes",
     "newton.residual: found '1', expected a number between 0 and 1"},
    {"divisions: [20, 3]", "divisions: [20, 0]", "0]\n      sides: {top: Beneath",
     "mesh.generate.1.divisions.1: found '0', expected a whole number >= 1"},
    {"divisions: [20, 3]", "divisions: [20, 3, 1]", "[20, 3, 1]",
     "mesh.generate.1.divisions: found 3 numbers, expected 2"},
    {"divisions: [20, 3]", "divisions: [20000, 30000]", "- name: upper",
     "mesh.generate: found 2.4e+09 cells (divisions and refine), expected at most 1e+08"},
    {"to: [1, 0.2]", "to: [1, 0.1]", "0.1]}\n      divisions: [20, 2]",
     "mesh.generate.0.rectangle.to.1: found 0.1 for y, expected more than the 0.1 of 'from'"},
    {"refine: 2", "refine: 0", "0\nphysics",
     "mesh.refine: found '0', expected a whole number from 1 to 1000"},
    {"every: 10", "every: -1", "-1, last", "fields.every: found '-1', expected a whole number >= 0"},
    {"[0, 1, 2]", "[0, 2, 2]", "2], values: [0, 1",
     "functions.ramp.times.2: found 2 after 2, expected numbers that ascend"},
    {"[0.001, 0.006]", "[0.006, 0.001]", "0.001], every",
     "fields.at.1: found 0.001 after 0.006, expected numbers that ascend"},
    {"[0.001, 0.006]", "[0.001, 0.06]", "0.06]",
     "fields.at.1: found 0.06, expected an instant of the run, 0.001 to "
     "0.013"},
    {"[0.001, 0.006]", "[0.0005, 0.006]", "0.0005, 0.006]",
     "fields.at.0: found 0.0005, expected an instant of the run, 0.001 to 0.013"},
    {"every: 20", "every: 0.5", "0.5, last", "checkpoint.every: found '0.5', expected a whole number >= 0"},
    {"at: [0.002]", "at: [0.2]", "0.2], every: 20",
     "checkpoint.at.0: found 0.2, expected an instant of the run, 0.001 to 0.013"},
    {"at: 0.012", "at: 12", "12, reference",
     "checks.0.at: found 12, expected an instant of the run, 0.001 to 0.013"},
    {"x: 1e4", "x: -1e4", "-1e4", "springs.0.x: found '-1e4', expected a number > 0"},
    {"tolerance: 1e-3", "tolerance: 0", "0, kind", "checks.0.tolerance: found '0', expected a number > 0"},
};

const Mistake sense_mistakes[] = {
    {"scheme: hht", "scheme: newmark", "-0.3",
     "time.alpha: the scheme newmark takes no alpha, hht, modified_average_acceleration and wbz_alpha take "
     "it; a run "
     "removes it "
     "by 'alpha: ~'"},
    {"alpha: -0.3", "alpha: -0.3\n  beta: 0.25", "0.25\n  begin",
     "time.beta: the scheme hht takes no beta, newmark takes it; a run removes it by 'beta: ~'"},
    {"step: 1e-3\n  end: 0.013", "step: 1e-3\n  instants: [0.013]", "1e-3\n  instants",
     "time.step: the steps are listed by 'instants' already"},
    {"step: 1e-3\n  end: 0.013", "instants: [0.001, 0.013]", "0.001, 0.013",
     "time.instants.0: found 0.001, expected instants after the begin, 0.001"},
    {"step: 1e-3\n  end: 0.013", "instants: [0.005, 0.013, 0.012]", "0.012]",
     "time.instants.2: found 0.012 after 0.013, expected numbers that ascend"},
    {"start: consistent", "start: at_rest_unloaded", "- {on: lower, velocity",
     "initial: start: at_rest_unloaded begins at rest, expected start: consistent"},
    {"scheme: hht\n  alpha: -0.3", "scheme: static", "- {on: lower, velocity",
     "initial: the scheme static finds equilibrium wherever it begins"},
    {", x: 1e4, y: 2e4", "", "{on: End}", "springs.0: has no stiffness, expected at least one of x, y, z"},
    {"{x: -10, y: 1}", "{}", "{}", "initial.0.velocity: has no component, expected at least one of x, y, z"},
    {"{x: -10, y: 1}", "{z: 1}", "1}}", "initial.0.velocity.z: plane_stress has no z, expected x or y"},
    {", velocity: {x: -10, y: 1}", "", "{on: lower}",
     "initial.0: says nothing, expected 'displacement' or 'velocity'"},
    {"alpha: -0.3", "alpha: -0.3\n  record: 1e-4", "1e-4\n  begin",
     "time.record: the scheme hht takes no record, central_difference takes it; a run removes it by "
     "'record: ~'"},
    {"alpha: -0.3", "alpha: -0.3\n  theta: 0.5", "0.5\n  begin",
     "time.theta: the scheme hht takes no theta, moreau_jean takes it; a run removes it by 'theta: ~'"},
    {"alpha: -0.3", "alpha: -0.3\n  contact_mass: lumped", "lumped",
     "time.contact_mass: found 'lumped', expected one of consistent, redistributed"},
    {"slave: Beneath", "slave: Below", "Below\n    friction",
     "contact.interface.slave: found 'Below' as slave and as master, expected two surfaces, or "
     "'self' for one that touches itself"},
    {"friction: newton", "friction: newtn", "newtn",
     "contact.interface.iterate.friction: found 'newtn', expected one of newton, fixed_point; did you mean "
     "'newton'?"},
    {"by: fixed_point, tolerance: 2e-3, max_loops: 7", "by: newton, max_loops: 7", "7}, friction",
     "contact.interface.iterate.geometry.max_loops: by newton the level has no loop of its own, fixed_point "
     "has one"},
    {"status: fixed_point", "status: {by: fixed_point, tolerance: 1}", "1}}\n    history",
     "contact.interface.iterate.status.tolerance: the status loop ends when no status changes"},
    {"method: augmented_lagrangian", "method: penaltie", "penaltie",
     "contact.interface.method: found 'penaltie', expected one of augmented_lagrangian, penalty, "
     "nodal_lagrange, nodal_penalty, nodal_pcg, exponential; did you mean 'penalty'?"},
    {"friction_method: penalty", "friction_method: nodal_penalty", "nodal_penalty",
     "contact.interface.friction_method: found nodal_penalty with the contact method augmented_lagrangian, "
     "expected augmented_lagrangian or penalty"},
    {"[Clamped, N6]", "[N6, N6]", "N6]", "contact.interface.exclude_nodes.1: found 'N6' a second time"},
    {"y: -1e7", "z: -1e7", "-1e7", "loads.0.nodal_force.z: plane_stress has no z, expected x or y"},
    {"y: -1e7", "z: 0", "0, f", "loads.0.nodal_force.z: plane_stress has no z, expected x or y"},
    {"fix: [x, y]", "fix: [x, z]", "z]",
     "supports.0.fix.1: found 'z', expected one of x, y; did you mean 'x'?"},
    {"fix: [x, y]", "fix: all", "all",
     "supports.0.fix: found 'all', expected one of x, y or a list of them; did you mean [x, y]?"},
    {"fix: [x, y]", "fix: yx", "yx",
     "supports.0.fix: found 'yx', expected one of x, y or a list of them; did you mean [y, x]?"},
    {"fix: [x, y]", "fix: xz", "xz", "supports.0.fix: found 'xz', expected one of x, y; did you mean 'x'?"},
    {"fix: [x, y]", "fix: [x, x]", "x]", "supports.0.fix.1: x is given a second time"},
    {"fix: [x, y]", "fix: [x, y], y: 1", "y], y", "supports.0.fix.1: y is given a second time"},
    {", fix: [x, y]", "", "{on: Clamped",
     "supports.0: holds nothing, expected 'fix', a displacement x, y or z, 'along' or 'rotate'"},
    {", x: 1}", "}", "{on: Above}", "loads.1.line_force: has no component, expected at least one of x, y, z"},
    {"function: ramp}\n  - line", "function: rampe}\n  - line", "rampe",
     "loads.0.nodal_force.function: no function is called 'rampe'; did you mean 'ramp'?"},
    {"function: ramp}}", "function: xxxxx}}", "xxxxx",
     "supports.1.y.function: no function is called 'xxxxx'; expected one of hold, ramp"},
    {"- line_force: {on: Above, x: 1}", "- {line_force: {on: A, x: 1}, pressure: {on: A, value: 1}}",
     "{line_force", "loads.1: found 2 kinds of load in one entry, expected one"},
    {"values: [0, 1, 0.5]", "values: [0, 1]", "[0, 1], outside",
     "functions.ramp.values: found 2 values for 3 times"},
    {"outside: zero", "outside: linear", "linear}\ncontact",
     "functions.hold.outside: found 'linear' for one instant, expected at least two to go on from"},
    {"tip.y", "tp.y", "tp.y", "checks.0.probe: no probe is called 'tp'; did you mean 'tip'?"},
    {"tip.y", "tip.z", "tip.z", "checks.0.probe: found the component 'z', expected x or y"},
    {"tip.y", "tip", "tip, at", "checks.0.probe: found 'tip', expected a probe and a component, as in tip.y"},
    {"-0.0132, tolerance: 1e-3, kind: absolute", "0, tolerance: 1e-3", "0, tolerance",
     "checks.0.reference: found 0, to which nothing can be relative, expected 'kind: absolute' with it"},
    {"node: Force", "node: Force, point: [1, 2]", "{node: Force, point",
     "probes.tip: found both 'node' and 'point', expected one of them"},
    {"node: Force, ", "", "{field: velocity",
     "probes.tip: 'node', 'point', 'on', 'section', 'contact' or 'minus' is missing"},
    {"node: Force, ", "on: Force, node: Force, ", "{on: Force, node",
     "probes.tip: found both 'node' and 'on', expected one of them"},
    {"node: Force, ", "node: Force, take: sum, ", "sum, field",
     "probes.tip.take: goes with 'on' only: it says what is taken of the nodes of a group"},
    {"node: Force, ", "on: Force, take: average, ", "average, field",
     "probes.tip.take: found 'average', expected one of sum, mean, min, max"},
    {"[0.5, 0.15]", "[0.5, 0.15, 0]", "[0.5, 0.15, 0]",
     "probes.middle.point: found 3 coordinates, expected 2"},
    {"cells: [upper, lower]", "cells: [upper, upper]", "upper]",
     "materials.steel.cells.1: found 'upper' a second "
     "time"},
    {"cells: [upper, lower]", "cells: []", "[]\nsupports",
     "materials.steel.cells: found an empty list, expected 'all' or groups of cells"},
    {"supports:", "  brass: {young: 1, poisson: 0, density: 1}\nsupports:", "brass",
     "materials.brass: is on all cells, expected its own groups ('cells') beside other materials"},
    {"supports:", "  brass: {young: 1, poisson: 0, density: 1, cells: upper}\nsupports:", "upper}\nsupports",
     "materials.brass.cells.0: the group 'upper' has another material already"},
    {"name: lower", "name: upper", "name: upper\n      rectangle: {from: [0, 0], to",
     "mesh.generate.1: found a second body named 'upper'"},
    {"cells: quad8", "cells: hexa8", "hexa8",
     "mesh.generate.0.cells: found 'hexa8', expected one of tria3, tria6, "
     "tria7, quad4, quad8, quad9"},
    {"  convert: full", "  name: mesh\n  convert: full", "mesh\n  convert",
     "mesh.name: only a mesh from a file has a name"},
    {"  convert: full", "  file: a.med\n  convert: full", "generate",
     "mesh: found both 'file' and 'generate', expected one of them"},
    {"points: {right_top: Force, left_bottom: P}", "edges: {right_top: P}", "{right_top: P}",
     "mesh.generate.0.edges: the edges of a rectangle are its sides"},
};

std::string test_name(const ::testing::TestParamInfo<Mistake>& info) {
  return std::to_string(info.index);
}

INSTANTIATE_TEST_SUITE_P(Keys, FullDeckWith, ::testing::ValuesIn(key_mistakes), test_name);
INSTANTIATE_TEST_SUITE_P(Types, FullDeckWith, ::testing::ValuesIn(type_mistakes), test_name);
INSTANTIATE_TEST_SUITE_P(Ranges, FullDeckWith, ::testing::ValuesIn(range_mistakes), test_name);
INSTANTIATE_TEST_SUITE_P(Sense, FullDeckWith, ::testing::ValuesIn(sense_mistakes), test_name);

TEST(DeckFaults, TheUnchangedDeckHasNone) {
  EXPECT_EQ(faults_of(full_deck), Sentences{});
  EXPECT_EQ(faults_of(smallest_deck), Sentences{});
}

TEST(DeckFaults, EveryRequiredPartIsAskedFor) {
  EXPECT_EQ(faults_of("title: nothing else\n"),
            (Sentences{"study.yaml:1:1: 'materials' is missing", "study.yaml:1:1: 'mesh' is missing",
                       "study.yaml:1:1: 'physics' is missing", "study.yaml:1:1: 'time' is missing"}));
}

TEST(DeckFaults, AllOfADeckComeTogetherInTheOrderOfTheFile) {
  EXPECT_EQ(faults_of("mesh: {fil: beams.med}\n"
                      "physics: fluid\n"
                      "materials: {steel: {young: -1, poisson: 0.3}}\n"
                      "time: {scheme: newmark, alpha: 0, step: 0, end: -1}\n"),
            (Sentences{
                "study.yaml:1:7: mesh: 'file' or 'generate' is missing",
                "study.yaml:1:8: unknown key 'mesh.fil'; did you mean 'file'?",
                "study.yaml:2:10: physics: found 'fluid', expected one of solid, plane_stress, plane_strain, "
                "axisymmetric",
                "study.yaml:3:13: materials.steel: 'density' is missing: the scheme newmark moves masses",
                "study.yaml:3:28: materials.steel.young: found '-1', expected a number > 0",
                "study.yaml:4:32: time.alpha: the scheme newmark takes no alpha, hht, "
                "modified_average_acceleration and wbz_alpha take it; a run removes it by 'alpha: ~'",
                "study.yaml:4:41: time.step: found '0', expected a number > 0",
                "study.yaml:4:49: time.end: found -1, expected more than the begin, 0"}));
}

TEST(DeckFaults, AFaultThatRunsInheritIsToldOnce) {
  const auto deck = replaced(full_deck, "friction: 0.2", "friction: -1") + "runs: {a: {}, b: {}, c: {}}\n";
  EXPECT_EQ(faults_of(deck), Sentences{place_of(deck, "-1\n    method") +
                                       ": contact.interface.friction: found '-1', expected a number >= 0"});
}

TEST(DeckFaults, AFaultOfSomeRunsNamesThem) {
  const auto deck = full_deck + "runs: {a: {}, b: {time: {scheme: newmark}}, c: {time: {scheme: newmark}}}\n";
  const auto faults = faults_of(deck);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0],
            place_of(deck, "-0.3") +
                ": time.alpha: the scheme newmark takes no alpha, hht, modified_average_acceleration and "
                "wbz_alpha take it; a run removes it by 'alpha: ~' (runs b, c)");
}

TEST(DeckFaults, ThicknessOnlyBelongsToPlanes) {
  EXPECT_EQ(
      faults_of(smallest_deck + "thickness: 2"),
      Sentences{"study.yaml:5:12: thickness: solid has no thickness, plane_stress and plane_strain do"});
}

TEST(DeckFaults, AnExplicitSchemeHasStepsOfItsOwn) {
  EXPECT_EQ(faults_of_explicit("end: 1"), Sentences{});
  EXPECT_EQ(faults_of_explicit("end: 1, step: auto, safety: 1, record: 0.1"), Sentences{});
  EXPECT_EQ(faults_of_explicit("end: 1, safety: 1.5"),
            Sentences{"time.safety: found '1.5', expected a number > 0 and <= 1"});
  EXPECT_EQ(faults_of_explicit("end: 1, mass_scaling: {step: 0}"),
            Sentences{"time.mass_scaling.step: found '0', expected a number > 0"});
  EXPECT_EQ(faults_of_explicit("end: 1, record: 2"),
            Sentences{"time.record: found 2, expected at most the length of the run, 1"});
  EXPECT_EQ(faults_of_explicit("end: 1, step: 2"),
            Sentences{"time.step: found 2, expected at most the length of the run, 1"});
  EXPECT_EQ(
      faults_of_explicit("end: 1, instants: [1]"),
      Sentences{
          "time.instants: the scheme central_difference chooses its steps; results are kept every 'record'"});
  EXPECT_EQ(faults_of_explicit("end: 1, on_failure: {cut: 2}"),
            Sentences{"time.on_failure: the scheme central_difference has no steps that fail"});
  EXPECT_EQ(faults_of_explicit("end: 1, start: at_rest_unloaded"),
            Sentences{"time.start: the scheme central_difference starts from the true equilibrium, "
                      "expected consistent or {from: run}"});
  EXPECT_EQ(faults_of_explicit("end: 1, alpha: -0.1").size(), 1U);
  EXPECT_EQ(faults_of(replaced(smallest_deck, "newmark", "newmark, record: 1e-4")),
            Sentences{place_of(replaced(smallest_deck, "newmark", "newmark, record: 1e-4"), "1e-4") +
                      ": time.record: the scheme newmark takes no record, central_difference takes it; a run "
                      "removes it by 'record: ~'"});
}

TEST(DeckFaults, AnExplicitSchemeTakesContactByPenaltyOnly) {
  const auto faults = [](const std::string& method) {
    return faults_of_explicit("end: 1", "contact: {a: {master: M, slave: S, friction: 0.1" + method + "}}\n");
  };
  EXPECT_EQ(faults(", method: penalty"), Sentences{});
  EXPECT_EQ(faults(""), Sentences{"contact.a: found the method augmented_lagrangian with friction by "
                                  "augmented_lagrangian, but the scheme central_difference has forces only, "
                                  "expected penalty for both"});
  EXPECT_EQ(faults(", method: nodal_penalty").size(), 1U);
  EXPECT_EQ(faults(", method: exponential, coefficients: {pressure: 1, clearance: 1}").size(), 1U);
  EXPECT_EQ(faults(", method: penalty, friction_method: augmented_lagrangian").size(), 1U);
}

TEST(DeckFaults, AStaticRunHasNoFirstAccelerationToLeaveOut) {
  const auto deck = replaced(smallest_deck, "newmark,", "static, start: at_rest_unloaded,");
  EXPECT_EQ(faults_of(deck), Sentences{place_of(deck, "at_rest") +
                                       ": time.start: the scheme static has no first acceleration, expected "
                                       "consistent or {from: run}"});
}

TEST(DeckFaults, ARunThatGoesOnFromAnotherHasItsMotion) {
  const auto deck = smallest_deck + "initial: [{on: all, velocity: {x: 1}}]\n"
                                    "runs: {first: {}, second: {time: {start: {from: first}}}}\n";
  EXPECT_EQ(faults_of(deck), Sentences{place_of(deck, "[{on: all") +
                                       ": initial: the run starts from the end of another one, whose motion "
                                       "it has (run second)"});
  EXPECT_EQ(faults_of(replaced(deck, "second: {", "second: {initial: ~, ")), Sentences{});
}

TEST(DeckFaults, ASolverMustSuitTheSchemeAndTheMethod) {
  EXPECT_EQ(faults_of(smallest_deck + "solver: full\n"), Sentences{});
  EXPECT_EQ(faults_of_explicit("end: 1", "solver: full\n"),
            Sentences{"solver: the scheme central_difference solves no system, expected auto"});
  EXPECT_EQ(faults_of_explicit("end: 1", "solver: auto\n"), Sentences{});
  const auto by_cg = smallest_deck + "contact: {a: {master: M, slave: S, method: nodal_pcg}}\n";
  const auto deck = by_cg + "solver: full\n";
  EXPECT_EQ(faults_of(deck),
            Sentences{place_of(deck, "full") +
                      ": solver: found full, but nodal_pcg works on the factored bulk, expected auto, "
                      "condensed or iterative"});
}

TEST(DeckFaults, MethodsThatDoNotGoTogetherAreToldApart) {
  EXPECT_EQ(
      faults_of_zone("method: nodal_pcg, friction: 0.2"),
      Sentences{"contact.a.friction: found 0.2, nodal_pcg is without friction, expected 0 or the method "
                "nodal_lagrange"});
  EXPECT_EQ(faults_of_zone("method: nodal_penalty, integration: {gauss: 2}"),
            Sentences{"contact.a.integration: nodal_penalty has one relation a node, expected nodes; "
                      "augmented_lagrangian, penalty and exponential take points between the nodes"});
  EXPECT_EQ(
      faults_of_zone("method: nodal_lagrange, iterate: {geometry: newton}"),
      Sentences{"contact.a.iterate.geometry: nodal_lagrange holds its relations during a loop, expected "
                "fixed_point"});
  EXPECT_EQ(faults_of_zone("method: nodal_pcg, iterate: {status: fixed_point}"),
            Sentences{"contact.a.iterate.status: nodal_pcg finds the points that touch by itself, expected "
                      "newton"});
  EXPECT_EQ(
      faults_of_zone("method: penalty, friction: 0.1, friction_method: nodal_penalty"),
      Sentences{"contact.a.friction_method: found nodal_penalty with the contact method penalty, expected "
                "penalty or augmented_lagrangian"});
  EXPECT_EQ(
      faults_of_zone("method: nodal_pcg}, b: {master: K, slave: L"),
      Sentences{"contact.b: found the method augmented_lagrangian beside nodal_pcg, which solves for all "
                "zones together, expected nodal_pcg in every zone or in none"});
}

TEST(DeckFaults, BodiesFitThePhysics) {
  const auto deck = replaced(full_deck, "physics: plane_stress\nthickness: 0.5", "physics: solid");
  const auto faults = faults_of(deck);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0], place_of(deck, "{from: [0, 0.1]") +
                           ": mesh.generate.0.rectangle: found a rectangle in solid, "
                           "expected a box");
}

TEST(DeckFaults, LongWordsAreCutAtACharacter) {
  const auto deck = replaced(smallest_deck, "solid", std::string(59, 'a') + "éééé");
  const auto faults = faults_of(deck);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("'" + std::string(59, 'a') + "…'"), std::string::npos) << faults[0];
}

} // namespace
} // namespace rubato::deck::faults_test
