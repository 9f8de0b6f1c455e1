// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/echo.hpp"

#include "rubato/study/echo_json.hpp"

#include <nlohmann/json.hpp>

namespace rubato::study {
namespace {

Json echo(const LinearTable& table, const char* abscissae) {
  return {{abscissae, table.at}, {"values", table.values}, {"outside", word(outside_words, table.outside)}};
}

Json echo_kind(const LinearTable& table) {
  return echo(table, "times");
}

Json echo_kind(const Ramp& ramp) {
  return {{"ramp", {{"begin", ramp.begin}, {"end", ramp.end}, {"from", ramp.from}, {"to", ramp.to}}}};
}

Json echo_kind(const Sine& sine) {
  return {{"sine",
           {{"frequency", sine.frequency},
            {"amplitude", sine.amplitude},
            {"phase", sine.phase},
            {"mean", sine.mean}}}};
}

Json echo_kind(const Expression& expression) {
  return {{"expression", expression.text()}};
}

/// The rules refuse it.
Json echo_kind(const Integral& /*integral*/) {
  return "integral";
}

/// Factors as functions without names.
Json echo_kind(const Product& product) {
  auto factors = Json::array();
  for (const auto& factor : product.factors)
    factors.push_back(std::visit([](const auto& kind) { return echo_kind(kind); }, factor.is));
  return {{"product", factors}};
}

Json echo(const Function& function) {
  return std::visit([](const auto& kind) { return echo_kind(kind); }, function.is);
}

Json echo(double number) {
  return number;
}

Json echo(const FileField& field) {
  Json map{{"field", field.file}, {"name", field.name}};
  put_name(map, "component", field.component);
  put_optional(map, "at", field.at);
  return map;
}

/// Its name: the deck refuses it, as it cannot compute it.
Json echo(const GivenField& field) {
  return {{"given", field.name}};
}

/// Expressions as they are written.
Json echo(const FieldValue& value) {
  if (const auto* profile = value.profile()) {
    auto map = echo(profile->table, "at");
    map["along"] = axis_words.at(profile->axis);
    return map;
  }
  if (const auto* of_file = value.of_file())
    return echo(*of_file);
  if (const auto* of_program = value.of_program())
    return echo(*of_program);
  return value.number() != nullptr ? Json(*value.number()) : Json(value.formula()->text);
}

/// A number of a material that depends on the place, where it does.
void put_in_place(Json& map, const Material& material) {
  for (const auto& [key, value] : material.in_place)
    map[key] = echo(value);
}

Json echo(const CylindricalAxes& axes, int dimension) {
  Json map{{"point", first(axes.point, dimension)}};
  if (dimension == 3)
    map["direction"] = first(axes.direction, dimension);
  return {{"cylindrical", map}};
}

Json echo(const Material& material, int dimension) {
  Json map{{"law", word(law_words, material.law)}};
  put_numbers(map, entry_of(material.law), material);
  put_law_words(map, material);
  put_optional(map, "density", material.density);
  put_in_place(map, material);
  if (const auto& axes = material.orthotropy.cylindrical)
    map["axes"] = echo(*axes, dimension);
  map["rayleigh"] = {{"stiffness", material.rayleigh_stiffness}, {"mass", material.rayleigh_mass}};
  if (material.damping)
    map["damping"] = {{"ratio", material.damping->ratio}, {"at", material.damping->at}};
  if (const auto& expansion = material.expansion) {
    map["expansion"] =
        material.law == LawKind::orthotropic ? Json(expansion->along) : Json(expansion->along[0]);
    map["reference_temperature"] = expansion->reference;
  }
  map["cells"] = material.everywhere ? Json("all") : Json(material.cells);
  return map;
}

/// A value times a function of time.
template <class Varying> Json echo_varying(const Varying& varying) {
  Json map{{"value", echo(varying.value)}};
  put_name(map, "function", varying.function);
  return map;
}
Json echo_varying(const Field& field) {
  Json map{{word(given_words, field.given), echo(field.value)}};
  put_name(map, "function", field.function);
  return map;
}

template <class Varying>
void put_components(Json& map, const std::array<std::optional<Varying>, 3>& components) {
  for (std::size_t axis = 0; axis < axis_words.size(); ++axis)
    if (components[axis])
      map[std::string(axis_words[axis])] = echo_varying(*components[axis]);
}

Json echo(const Rotation& rotation, int dimension) {
  Json map{{"about", first(rotation.about, dimension)}, {"angle", echo_varying(rotation.angle)}};
  if (dimension == 3)
    map["axis"] = first(rotation.axis, dimension);
  return map;
}

Json echo(const Support& support, int dimension) {
  Json map{{"on", support.on}};
  put_components(map, support.components);
  if (const auto& along = support.along) {
    map["along"] = along->normal
                       ? Json(normal_word)
                       : Json(std::vector(along->direction.begin(), along->direction.begin() + dimension));
    map["value"] = echo_varying(along->value);
  }
  if (auto turns = Json::object(); put_components(turns, support.turns), !turns.empty())
    map["turn"] = turns;
  if (support.rotate)
    map["rotate"] = echo(*support.rotate, dimension);
  put_optional(map, "until", support.until);
  return map;
}

Json echo(const BaseMotion& base) {
  Json map{{"frame", word(base_frame_words, base.frame)}};
  put_components(map, base.components);
  return map;
}

Json echo(const RelationTerm& term, int dimension) {
  Json map{{"on", term.on}};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    if (term.coefficients[axis] != 0)
      map[std::string(axis_words[axis])] = term.coefficients[axis];
  return map;
}

/// Axes that are chosen, of those that there are; none where all are.
Json echo_axes(const std::array<bool, 3>& components, int dimension) {
  auto axes = Json::array();
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    if (components[axis])
      axes.push_back(axis_words[axis]);
  return axes.size() == static_cast<std::size_t>(dimension) ? Json() : axes;
}

Json echo(const Relation& relation, int dimension) {
  auto map = Json::object();
  if (relation.kind == RelationKind::equation) {
    map["terms"] = Json::array();
    for (const auto& term : relation.terms)
      map["terms"].push_back(echo(term, dimension));
    map["value"] = echo_varying(relation.value);
  }
  put_name(map, "on", relation.on);
  put_name(map, "with", relation.with);
  put_name(map, "in", relation.cells);
  if (const auto axes = echo_axes(relation.components, dimension); !axes.is_null())
    map["in"] = axes;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    if (relation.difference[axis] != Field())
      map["difference"][std::string(axis_words[axis])] = echo_varying(relation.difference[axis]);
  if (relation.at)
    map["at"] = std::vector(relation.at->begin(), relation.at->begin() + dimension);
  return {{word(relation_words, relation.kind), map}};
}

Json echo(const Load& load, int dimension) {
  auto map = Json::object();
  put_name(map, "on", load.on);
  if (load.kind == LoadKind::pressure)
    map["value"] = echo(load.components[0]);
  else
    for (std::size_t axis = 0;
         axis < (load.kind == LoadKind::moment ? 3 : static_cast<std::size_t>(dimension)); ++axis)
      if (load.kind != LoadKind::moment || load.components[axis] != 0.0)
        map[std::string(axis_words[axis])] = echo(load.components[axis]);
  put_name(map, "function", load.function);
  if (load.kind == LoadKind::pressure)
    map["follower"] = load.follower;
  return {{word(load_words, load.kind), map}};
}

Json echo(const Temperature& temperature) {
  Json map{{"on", temperature.on}, {"value", echo(temperature.value.value)}};
  put_name(map, "function", temperature.value.function);
  return map;
}

Json echo(const Connector& connector, int dimension) {
  Json map{{"on", connector.on}};
  put_name(map, "to", connector.to);
  if (connector.along)
    map["along"] = std::vector(connector.along->begin(), connector.along->begin() + dimension);
  const auto put_law = [&](const char* key, const char* places, const std::optional<LinearTable>& law) {
    if (law)
      map[key] = {{places, law->at}, {"forces", law->values}, {"outside", word(outside_words, law->outside)}};
  };
  if (connector.rotates)
    map["rotates"] = true;
  if (connector.anchor)
    map["anchor"] = std::vector(connector.anchor->begin(), connector.anchor->begin() + dimension);
  map["stiffness"] = connector.stiffness;
  map["damping"] = connector.damping;
  put_law("force", "elongations", connector.force);
  put_law("damper", "rates", connector.damper);
  return map;
}

Json echo(const PointMasses& masses) {
  Json map{{"on", masses.on}, {"mass", masses.mass}};
  if (masses.inertia != std::array<double, 3>{})
    map["inertia"] = masses.inertia;
  return map;
}

Json echo(const Springs& springs, int dimension) {
  Json map{{"on", springs.on}};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    if (springs.stiffness[axis] > 0)
      map[std::string(axis_words[axis])] = springs.stiffness[axis];
  return map;
}

void put_components(Json& map, const char* key, const std::array<std::optional<double>, 3>& components) {
  for (std::size_t axis = 0; axis < axis_words.size(); ++axis)
    if (components[axis])
      map[key][std::string(axis_words[axis])] = *components[axis];
}

Json echo(const InitialMotion& initial) {
  Json map{{"on", initial.on}};
  put_components(map, "displacement", initial.displacement);
  put_components(map, "velocity", initial.velocity);
  return map;
}

Json echo(const Level& level) {
  if (level.by == Iteration::newton)
    return word(iteration_words, level.by);
  Json map{{"by", word(iteration_words, level.by)}, {"max_loops", level.max_loops}};
  if (level.tolerance > 0)
    map["tolerance"] = level.tolerance;
  return map;
}

Json echo(const Obstacle& obstacle, Physics physics) {
  const int dimension = dimension_of(physics);
  const bool solid = physics == Physics::solid;
  auto shape = Json::object();
  if (physics != Physics::axisymmetric || obstacle.kind != ObstacleKind::cylinder)
    shape["point"] = first(obstacle.point, dimension);
  if (obstacle.kind == ObstacleKind::plane)
    shape["normal"] = first(obstacle.direction, dimension);
  if (obstacle.kind == ObstacleKind::cylinder && solid)
    shape["axis"] = first(obstacle.direction, dimension);
  if (obstacle.kind != ObstacleKind::plane) {
    shape["radius"] = obstacle.radius;
    shape["side"] = word(obstacle_side_words, obstacle.side);
  }
  Json map{{word(obstacle_words, obstacle.kind), shape}};
  map["move"] = Json::object();
  put_components(map["move"], obstacle.move);
  if (obstacle.rotate)
    map["rotate"] = echo(*obstacle.rotate, dimension);
  return map;
}

void put_surfaces(Json& map, const ContactZone& zone, Physics physics) {
  if (!zone.between.empty())
    map["between"] = zone.between;
  else if (!zone.self.empty())
    map["self"] = zone.self;
  else if (zone.all)
    map["all"] = true;
  else if (zone.obstacle)
    map["obstacle"] = echo(*zone.obstacle, physics);
  else
    map["master"] = zone.master;
  if (!zone.slave.empty())
    map["slave"] = zone.slave;
}

/// What only surfaces have that touch and part.
void put_touching(Json& map, const ContactZone& zone) {
  map["friction_method"] = word(friction_method_words, zone.friction_method);
  map["interference"] = echo_varying(zone.interference);
  map["gap"] = echo_varying(zone.gap);
  map["normal"] = word(contact_normal_words, zone.normal);
  map["smoothing"] = zone.smoothing;
  if (!zone.obstacle)
    map["clamped_normal"] = word(clamped_normal_words, zone.clamped_normal);
  map["bilateral"] = zone.bilateral;
  map["freeze"] = zone.freeze;
  map["nodal_pairs"] = zone.nodal_pairs;
  put_optional(map, "initially_active", zone.initially_active);
  map["coefficients"] = Json::object();
  put_numbers(map["coefficients"], entry_of(zone.method), zone);
  if (zone.method == ContactMethod::exponential)
    map["coefficients"]["curve"] = word(exponential_curve_words, zone.curve);
  put_optional(map["coefficients"], "tangential", zone.tangential_coefficient);
  map["iterate"] = {
      {"geometry", echo(zone.geometry)}, {"friction", echo(zone.threshold)}, {"status", echo(zone.status)}};
  map["restitution"] = zone.restitution;
}

Json echo(const ContactZone& zone, Physics physics) {
  auto map = Json::object();
  put_surfaces(map, zone, physics);
  map["friction"] = zone.friction_in_place ? echo(*zone.friction_in_place) : Json(zone.friction);
  map["method"] = word(contact_method_words, zone.method);
  map["tie"] = zone.tie;
  if (!zone.tie)
    put_touching(map, zone);
  const std::string rule(entry_of(zone.integration.by).name);
  map["integration"] = zone.integration.order == 0 ? Json(rule) : Json{{rule, zone.integration.order}};
  put_optional(map, "projection_tolerance", zone.projection_tolerance);
  map["exclude_nodes"] = zone.exclude_nodes;
  map["history_force"] = zone.history_force;
  return map;
}

Json echo(const TimeStepping& time) {
  auto map = Json::object();
  map["scheme"] = word(scheme_words, time.scheme);
  put_numbers(map, entry_of(time.scheme), time);
  if (is_explicit(time.scheme))
    map["record"] = time.record;
  map["contact_mass"] = word(contact_mass_words, time.contact_mass);
  map["begin"] = time.begin;
  if (time.instants.empty()) {
    map["step"] =
        is_explicit(time.scheme) && time.step == 0 ? Json(std::string(automatic_step)) : Json(time.step);
    map["end"] = time.end;
  } else {
    map["instants"] = time.instants;
  }
  put_optional(map, "max_step", time.max_step);
  put_optional(map, "max_plastic_step", time.max_plastic_step);
  if (time.mass_scaling)
    map["mass_scaling"] = {{"step", *time.mass_scaling}};
  if (time.arc_length)
    map["arc_length"] = {{"length", time.arc_length->length}, {"on", time.arc_length->on}};
  map["start"] = time.start == StartKind::from_run ? Json{{"from", time.start_run}}
                                                   : Json(word(start_words, time.start));
  if (!is_explicit(time.scheme))
    map["on_failure"] = {{"cut", time.cut_parts}, {"levels", time.cut_levels}};
  return map;
}

Json echo(const Preload& preload, int dimension) {
  Json map{{"cut", echo(preload.cut, dimension)},
           {preload.by_force ? "force" : "displacement", preload.value.value}};
  put_name(map, "function", preload.value.function);
  put_optional(map, "lock", preload.lock);
  return map;
}

template <class T, class... More> Json echo_list(const std::vector<T>& entries, More... more) {
  auto list = Json::array();
  for (const auto& entry : entries)
    list.push_back(echo(entry, more...));
  return list;
}

template <class T, class... More> Json echo_by_name(const std::vector<T>& entries, More... more) {
  auto map = Json::object();
  for (const auto& entry : entries)
    map[entry.name] = echo(entry, more...);
  return map;
}

} // namespace

std::string to_json(const Study& study) {
  const auto dimension = dimension_of(study.physics);
  Json deck{{"title", study.title}, {"units", study.units}};
  deck["mesh"] = echo(study.mesh, dimension);
  deck["physics"] = word(physics_words, study.physics);
  if (study.physics == Physics::plane_stress || study.physics == Physics::plane_strain)
    deck["thickness"] = study.thickness;
  deck["materials"] = echo_by_name(study.materials, dimension);
  deck["functions"] = Json::object();
  for (const auto& [name, function] : study.functions)
    deck["functions"][name] = echo(function);
  deck["supports"] = echo_list(study.supports, dimension);
  if (study.base_motion)
    deck["base_motion"] = echo(*study.base_motion);
  deck["preload"] = echo_by_name(study.preload, dimension);
  deck["relations"] = echo_by_name(study.relations, dimension);
  deck["springs"] = echo_list(study.springs, dimension);
  deck["connectors"] = echo_list(study.connectors, dimension);
  deck["masses"] = echo_list(study.masses);
  deck["loads"] = echo_list(study.loads, dimension);
  deck["temperature"] = echo_list(study.temperatures);
  deck["initial"] = echo_list(study.initial);
  if (study.modal_damping)
    deck["modal_damping"] = {{"modes", study.modal_damping->modes}, {"ratio", study.modal_damping->ratios}};
  deck["contact"] = echo_by_name(study.contact, study.physics);
  deck["time"] = echo(study.time);
  deck["solver"] = word_of(solver_words, study.solver);
  deck["newton"] = {{"max_iterations", study.newton.max_iterations},
                    {"residual", study.newton.residual},
                    {"tangent", word(tangent_words, study.newton.tangent)}};
  deck["probes"] = echo_by_name(study.probes, dimension);
  deck["fields"] = echo(study.fields);
  deck["checkpoint"] = echo(study.checkpoint);
  deck["checks"] = echo_list(study.checks);
  deck["runs"] = {{study.name, Json::object()}};
  constexpr int indentation = 2;
  return deck.dump(indentation, ' ', false, Json::error_handler_t::replace);
}

} // namespace rubato::study
