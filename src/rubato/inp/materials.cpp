// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/inp/reading.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace rubato::inp {
namespace {

using mesh::inp::compact;

/// Moduli along the axes: E1 E2 E3 ν12 ν13 ν23 G12 G13 G23.
void set_constants(const std::vector<double>& n, study::Physics physics, study::Material& material) {
  auto& o = material.orthotropy;
  material.law = study::LawKind::orthotropic;
  o.young_x = n[0];
  o.young_y = n[1];
  o.poisson_xy = n[3];
  o.shear_xy = n[6];
  if (physics == study::Physics::plane_stress)
    return;
  o.young_z = n[2];
  o.poisson_xz = n[4];
  o.poisson_yz = n[5];
  if (physics != study::Physics::solid)
    return;
  o.shear_xz = n[7];
  o.shear_yz = n[8];
}

/// The same from D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323.
std::vector<double> constants_of_stiffness(const std::vector<double>& d) {
  Eigen::Matrix3d stiffness;
  stiffness << d[0], d[1], d[3], d[1], d[2], d[4], d[3], d[4], d[5];
  const Eigen::Matrix3d s = stiffness.inverse();
  return {1 / s(0, 0), 1 / s(1, 1), 1 / s(2, 2), -s(1, 0) / s(0, 0), -s(2, 0) / s(0, 0), -s(2, 1) / s(1, 1),
          d[6],        d[7],        d[8]};
}

using Numbers = std::span<const double>;

void set_isotropic(Numbers n, study::Physics, study::Material& material) {
  material.law = study::LawKind::elastic;
  material.young = n[0];
  material.poisson = n[1];
}

void set_lamina(Numbers n, study::Physics, study::Material& material) {
  set_constants({n[0], n[1], 0, n[2], 0, 0, n[3], 0, 0}, study::Physics::plane_stress, material);
}

void set_orthotropic(Numbers n, study::Physics physics, study::Material& material) {
  set_constants(constants_of_stiffness({n.begin(), n.end()}), physics, material);
}

void set_engineering(Numbers n, study::Physics physics, study::Material& material) {
  set_constants({n.begin(), n.end()}, physics, material);
}

/// Places of the nine orthotropic moduli among the 21 of an anisotropic material.
constexpr std::array orthotropic_places{0, 1, 2, 3, 4, 5, 9, 14, 20};

void set_anisotropic(Numbers n, study::Physics physics, study::Material& material) {
  std::vector<double> moduli;
  for (const int place : orthotropic_places)
    moduli.push_back(n[static_cast<std::size_t>(place)]);
  set_orthotropic(moduli, physics, material);
}

struct ElasticType {
  std::string_view word;
  std::size_t least;
  std::size_t count;
  std::string_view expected;
  void (*set)(Numbers, study::Physics, study::Material&);
};
constexpr std::string_view isotropic_numbers = "Young's modulus and Poisson's ratio";
constexpr std::string_view stiffness_numbers =
    "D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323";
constexpr std::array elastic_types{
    ElasticType{"ISO", 1, 2, isotropic_numbers, set_isotropic},
    ElasticType{"ISOTROPIC", 1, 2, isotropic_numbers, set_isotropic},
    ElasticType{"ENGINEERINGCONSTANTS", 9, 9, "E1, E2, E3, nu12, nu13, nu23, G12, G13, G23", set_engineering},
    ElasticType{"LAMINA", 4, 6, "E1, E2, nu12, G12, G13, G23", set_lamina},
    ElasticType{"ORTHO", 9, 9, stiffness_numbers, set_orthotropic},
    ElasticType{"ORTHOTROPIC", 9, 9, stiffness_numbers, set_orthotropic},
    ElasticType{"ANISO", 21, 21, "21 moduli", set_anisotropic},
    ElasticType{"ANISOTROPIC", 21, 21, "21 moduli", set_anisotropic}};

bool is_orthotropic(const HeatTable& table) {
  return std::ranges::all_of(table.numbers, [](const auto& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (std::ranges::find(orthotropic_places, static_cast<int>(i)) == orthotropic_places.end() &&
          numbers[i] != 0)
        return false;
    return true;
  });
}

void set_density(Numbers n, study::Physics, study::Material& material) {
  material.density = n[0];
}

/// One coefficient between the initial temperature and the present one, that expands as those of the table:
/// these count from the temperature `zero`.
std::array<double, 3> expansion_at(const ExpansionPart& part, double temperature, double initial) {
  const auto now = numbers_at(part.table, temperature);
  const auto first = numbers_at(part.table, initial);
  std::array<double, 3> along{now[0], now[1], now[2]};
  if (temperature != initial && now != first)
    for (std::size_t i = 0; i < along.size(); ++i)
      along.at(i) =
          (now[i] * (temperature - part.zero) - first[i] * (initial - part.zero)) / (temperature - initial);
  return along;
}

} // namespace

MaterialData* material_above(Reading& reading, std::size_t index) {
  const auto* const parent =
      parent_of(reading, index, "MATERIAL",
                {"ELASTIC", "DENSITY", "EXPANSION", "DAMPING", "PLASTIC", "CYCLIC HARDENING",
                 "RATE DEPENDENT", "HYPERELASTIC", "VISCOELASTIC", "CREEP"});
  const auto* const name = parent == nullptr ? nullptr : parent->block->find("NAME");
  const auto found =
      name == nullptr ? reading.materials.end() : reading.materials.find(mesh::inp::folded(name->value.text));
  return found == reading.materials.end() ? nullptr : &found->second;
}

void read_material(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  const auto name = mesh::inp::require_value(block, "NAME", "the name of the material", reading.faults);
  if (name.empty())
    return;
  MaterialData data;
  data.at = name;
  data.material.name = std::string(name.text);
  data.material.everywhere = false;
  if (!reading.materials.try_emplace(mesh::inp::folded(name.text), std::move(data)).second)
    reading.faults.add(name, fmt::format("found a second material {}, expected each name once",
                                         shown(std::string(name.text))));
}

void read_elastic(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const data = material_above(reading, index);
  if (data == nullptr)
    return;
  data->names_law = true;
  const auto* const type = block.find("TYPE");
  const auto word = type == nullptr ? std::string("ISO") : compact(type->value.text);
  const auto* const found = std::ranges::find(elastic_types, std::string_view(word), &ElasticType::word);
  if (found == elastic_types.end())
    return reading.faults.add(type->value,
                              fmt::format("found TYPE={}, expected ISOTROPIC, ENGINEERING CONSTANTS, "
                                          "LAMINA or ORTHOTROPIC",
                                          type->value.text));
  auto table = heat_table(reading, block, found->least, found->count, found->expected);
  if (table.numbers.empty())
    return;
  if (found->set == set_anisotropic && !is_orthotropic(table))
    return reading.faults.add(block.at, "found an anisotropic material without three planes of symmetry, "
                                        "expected the moduli of an orthotropic one");
  data->plane_only = found->set == set_lamina;
  const auto* const moduli = block.find("MODULI");
  data->instantaneous = moduli != nullptr && compact(moduli->value.text) == "INSTANTANEOUS";
  data->law = {std::move(table), found->set};
}

void read_density(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const data = material_above(reading, index);
  auto table = heat_table(reading, block, 1, 1, "one density");
  if (data != nullptr && !table.numbers.empty())
    data->density = {std::move(table), set_density};
}

void read_expansion(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const data = material_above(reading, index);
  const auto* const type = block.find("TYPE");
  const auto word = type == nullptr ? std::string("ISO") : compact(type->value.text);
  const bool along_axes = word == "ORTHO" || word == "ORTHOTROPIC";
  if (!along_axes && word != "ISO" && word != "ISOTROPIC")
    return reading.faults.add(type->value,
                              fmt::format("found TYPE={}, expected ISO or ORTHO", type->value.text));
  auto table = along_axes ? heat_table(reading, block, 3, 3, "three coefficients of expansion")
                          : heat_table(reading, block, 1, 1, "one coefficient of expansion");
  if (data == nullptr || table.numbers.empty())
    return;
  for (auto& numbers : table.numbers)
    numbers.resize(3, numbers.front());
  auto& part = data->expansion.emplace();
  part.table = std::move(table);
  if (const auto* zero = block.find("ZERO"); zero != nullptr)
    part.zero = mesh::inp::require_number(zero->value, "a temperature", reading.faults).value_or(0);
}

void read_damping(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const data = material_above(reading, index);
  if (data == nullptr)
    return;
  const auto read = [&](std::string_view key, double& value) {
    if (const auto* given = block.find(key); given != nullptr)
      value = mesh::inp::require_number(given->value, "a coefficient of damping", reading.faults).value_or(0);
  };
  read("ALPHA", data->material.rayleigh_mass);
  read("BETA", data->material.rayleigh_stiffness);
}

study::Material material_at(const MaterialData& data, study::Physics physics, double temperature,
                            double initial) {
  auto material = data.material;
  const auto set = [&](const MaterialPart& part) {
    part.set(numbers_at(part.table, temperature), physics, material);
  };
  if (data.law)
    set(*data.law);
  if (data.density)
    set(*data.density);
  if (data.expansion)
    material.expansion = {expansion_at(*data.expansion, temperature, initial), 0};
  if (data.hardening)
    set_hardening(*data.hardening, temperature, material);
  if (data.relaxation)
    set_relaxation(*data.relaxation, data.instantaneous, material);
  return material;
}

// ---- axes

namespace {

std::vector<double> orientation_numbers(Reading& reading, const Block& block, std::size_t line) {
  std::vector<double> numbers;
  for (const auto& word : mesh::inp::fields_at(block, line))
    numbers.push_back(
        mesh::inp::require_number(word, "a coordinate of the orientation", reading.faults, 0).value_or(0));
  return numbers;
}

/// The turn about one of the own axes that the second line asks for.
Eigen::Matrix3d second_turn(Reading& reading, const Block& block) {
  const auto fields = mesh::inp::fields_at(block, 1);
  if (fields.empty())
    return Eigen::Matrix3d::Identity();
  const auto axis = mesh::inp::require_integer(fields[0], "the axis of a turn, 1 to 3", reading.faults);
  const auto angle = mesh::inp::require_number(field(fields, 1, fields[0]), "the angle of a turn in degrees",
                                               reading.faults, 0);
  if (!axis || !angle)
    return Eigen::Matrix3d::Identity();
  if (*axis < 1 || *axis > 3 || fields.size() > 2) {
    reading.faults.add(fields[0], "expected the axis of a turn, 1 to 3, and its angle");
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::Vector3d about = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(*axis) - 1);
  return Eigen::AngleAxisd(*angle * std::numbers::pi / 180, about).toRotationMatrix();
}

/// x' along a, y' in the plane of a and b, both from the origin c.
std::optional<Eigen::Matrix3d> rectangular(const std::vector<double>& n) {
  const Eigen::Vector3d origin(n[6], n[7], n[8]);
  const Eigen::Vector3d a = Eigen::Vector3d(n[0], n[1], n[2]) - origin;
  const Eigen::Vector3d b = Eigen::Vector3d(n[3], n[4], n[5]) - origin;
  const Eigen::Vector3d normal = a.cross(b);
  if (!(normal.norm() > 1e-12 * a.norm() * b.norm()))
    return std::nullopt;
  Eigen::Matrix3d turn;
  turn.col(0) = a.normalized();
  turn.col(2) = normal.normalized();
  turn.col(1) = turn.col(2).cross(turn.col(0));
  return turn;
}

/// The angles of turns about z, the new y, the new x [degrees].
std::array<double, 3> angles_of(const Eigen::Matrix3d& r) {
  constexpr double degree = std::numbers::pi / 180;
  const double sine = std::clamp(-r(2, 0), -1.0, 1.0);
  const double y = std::asin(sine);
  if (std::abs(sine) > 1 - 1e-14)
    return {std::atan2(-r(0, 1), r(1, 1)) / degree, y / degree, 0};
  return {std::atan2(r(1, 0), r(0, 0)) / degree, y / degree, std::atan2(r(2, 1), r(2, 2)) / degree};
}

double without_rounding(double angle) {
  const double rounded = std::round(angle * 1e9) / 1e9;
  return std::abs(angle - rounded) < 1e-12 * 180 ? rounded : angle;
}

void turn_material(Reading& reading, const Axes& axes, study::Material& material) {
  auto& o = material.orthotropy;
  const auto angles = angles_of(axes.turn);
  o.angle_z = without_rounding(angles[0]);
  o.angle_y = without_rounding(angles[1]);
  o.angle_x = without_rounding(angles[2]);
  o.cylindrical = axes.cylindrical;
  if (reading.dimension() == 3)
    return;
  if (o.angle_y != 0 || o.angle_x != 0 || (o.cylindrical && o.cylindrical->direction[2] <= 0))
    reading.faults.add(axes.at, "found an orientation whose third axis is not z, which a plane model needs");
  if (o.cylindrical) {
    o.cylindrical->direction = {0, 0, 1};
    o.cylindrical->point[2] = 0;
  }
}

} // namespace

void read_orientation(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto& faults = reading.faults;
  const auto name = mesh::inp::require_value(block, "NAME", "the name of the orientation", faults);
  if (const auto* definition = block.find("DEFINITION");
      definition != nullptr && compact(definition->value.text) != "COORDINATES")
    return faults.add(definition->value,
                      fmt::format("found DEFINITION={}, expected COORDINATES", definition->value.text));
  const auto* const system = block.find("SYSTEM");
  const auto word = system == nullptr ? std::string("RECTANGULAR") : compact(system->value.text);
  if (word != "RECTANGULAR" && word != "CYLINDRICAL")
    return faults.add(system->value, fmt::format("found SYSTEM={}, expected RECTANGULAR or CYLINDRICAL",
                                                 system->value.text));
  auto numbers = orientation_numbers(reading, block, 0);
  if (numbers.size() != 6 && (word == "CYLINDRICAL" || numbers.size() != 9))
    return faults.add(block.at,
                      fmt::format("found {} coordinates of an orientation, expected two points{}",
                                  numbers.size(), word == "CYLINDRICAL" ? "" : " and perhaps an origin"));
  numbers.resize(9);
  Axes axes;
  axes.at = name;
  axes.turn = second_turn(reading, block);
  if (word == "RECTANGULAR") {
    const auto turn = rectangular(numbers);
    if (!turn)
      return faults.add(block.at,
                        "found two directions of an orientation that are parallel or 0, expected two "
                        "different ones");
    axes.turn = *turn * axes.turn;
  } else {
    study::CylindricalAxes about;
    about.point = {numbers[0], numbers[1], numbers[2]};
    about.direction = {numbers[3] - numbers[0], numbers[4] - numbers[1], numbers[5] - numbers[2]};
    if (about.direction == std::array<double, 3>{})
      return faults.add(block.at, "found two equal points of an axis, expected two different ones");
    axes.cylindrical = about;
  }
  reading.axes[mesh::inp::folded(name.text)] = axes;
}

// ---- sections

namespace {

void set_thickness(Reading& reading, const Block& block) {
  const auto fields = mesh::inp::fields_at(block, 0);
  if (fields.empty() || fields[0].empty())
    return;
  const auto value = mesh::inp::require_number(fields[0], "the thickness", reading.faults);
  const bool has_thickness = reading.study.physics == study::Physics::plane_stress ||
                             reading.study.physics == study::Physics::plane_strain;
  if (!value || !has_thickness)
    return;
  if (reading.places.contains("thickness") && reading.study.thickness != *value)
    reading.faults.add(fields[0],
                       fmt::format("found the thickness {} beside {} in line {}, expected one for the whole "
                                   "model",
                                   *value, reading.study.thickness, reading.places.at("thickness").line));
  reading.study.thickness = *value;
  reading.places["thickness"] = fields[0].at();
}

/// Keywords that a material must have, and those that do not go together.
bool is_sound(Reading& reading, const MaterialData& data) {
  if (!data.law && data.names_law)
    return false;
  if (!data.law) {
    reading.faults.add(data.at,
                       fmt::format("found the material {} without *ELASTIC or *HYPERELASTIC, expected "
                                   "one of them",
                                   shown(data.material.name)));
    return false;
  }
  if (data.plane_only && reading.study.physics != study::Physics::plane_stress)
    reading.faults.add(
        data.at, "found moduli of a lamina, which are for plane stress, expected ENGINEERING CONSTANTS");
  study::Material bare;
  data.law->set(data.law->table.numbers.front(), reading.study.physics, bare);
  if (bare.law == study::LawKind::elastic && data.hardening && data.relaxation)
    reading.faults.add(data.relaxation->at, "found *VISCOELASTIC beside *PLASTIC, expected one of them");
  if (bare.law == study::LawKind::elastic) {
    if (data.hardening)
      check_hardening(reading, *data.hardening);
    return true;
  }
  if (data.hardening)
    reading.faults.add(data.hardening->at, "found *PLASTIC of a material that is not isotropic and linear "
                                           "elastic, expected *ELASTIC, TYPE=ISOTROPIC");
  if (data.relaxation)
    reading.faults.add(data.relaxation->at, "found *VISCOELASTIC of a material that is not isotropic and "
                                            "linear elastic, expected *ELASTIC, TYPE=ISOTROPIC");
  return true;
}

/// The material of the study for a material and its axes; cells with the same ones share it.
std::optional<std::size_t> material_for(Reading& reading, const Word& name, const Word& orientation) {
  const auto* const data = named(reading.materials, name, "a material", reading.faults);
  const Axes* const axes =
      orientation.empty() ? nullptr : named(reading.axes, orientation, "an orientation", reading.faults);
  if (data == nullptr || (axes == nullptr && !orientation.empty()) || !is_sound(reading, *data) ||
      !reading.faults.empty())
    return std::nullopt;
  const double first = data->law->table.temperatures.front();
  auto material = material_at(*data, reading.study.physics, first, first);
  const bool turned = axes != nullptr && material.law == study::LawKind::orthotropic;
  if (turned)
    turn_material(reading, *axes, material);
  const auto same = std::ranges::find_if(reading.made_materials, [&](const MadeMaterial& other) {
    return other.data == data && other.turned == material;
  });
  if (same != reading.made_materials.end())
    return static_cast<std::size_t>(same - reading.made_materials.begin());
  reading.made_materials.push_back({data, material, {}});
  material.name =
      chosen_name(reading, "material",
                  turned ? fmt::format("{}_{}", data->material.name, orientation.text) : data->material.name);
  reading.places["materials." + material.name] = data->at.at();
  reading.study.materials.push_back(std::move(material));
  return reading.study.materials.size() - 1;
}

} // namespace

void read_solid_section(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto set = mesh::inp::require_value(block, "ELSET", "a set of elements", reading.faults);
  const auto name = mesh::inp::require_value(block, "MATERIAL", "the name of a material", reading.faults);
  const auto* const orientation = block.find("ORIENTATION");
  if (set.empty() || name.empty())
    return;
  set_thickness(reading, block);
  const auto found = mesh::inp::find_elements(reading.content, placed.scope, set, reading.faults);
  const auto place = material_for(reading, name, orientation == nullptr ? Word{} : orientation->value);
  if (!found || !place) {
    if (found && reading.materials.contains(mesh::inp::folded(name.text)))
      reading.with_section.insert(reading.with_section.end(), found->items.begin(), found->items.end());
    return;
  }
  if (found->name.empty() || !found->is_set)
    return reading.faults.add(
        set, fmt::format("found {}, expected a set of solid elements", shown(std::string(set.text))));
  auto& material = reading.study.materials[*place];
  auto& made = reading.made_materials[*place];
  material.cells.push_back(found->name);
  made.elements.insert(made.elements.end(), found->items.begin(), found->items.end());
  reading.with_section.insert(reading.with_section.end(), found->items.begin(), found->items.end());
  if (material.density)
    reading.densities[found->name] = *material.density;
}

} // namespace rubato::inp
