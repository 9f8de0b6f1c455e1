// SPDX-License-Identifier: LGPL-3.0-or-later
/// The words a deck may use where it must choose. A word that is not accepted is known to the data but not
/// yet computed by the solver: enabling it is its row here, nothing else.
#pragma once

#include "rubato/study/contact_methods.hpp"
#include "rubato/study/groups.hpp"
#include "rubato/study/hardenings.hpp"
#include "rubato/study/material_laws.hpp"
#include "rubato/study/schemes.hpp"
#include "rubato/study/study.hpp"

#include <array>
#include <string_view>

namespace rubato::study {

template <class E> struct Word {
  std::string_view text;
  E value;
  bool accepted = true;
};

inline constexpr std::array<Word<MeshConversion>, 4> conversion_words{
    {{"none", MeshConversion::none},
     {"linear", MeshConversion::linear},
     {"quadratic", MeshConversion::quadratic},
     {"full_quadratic", MeshConversion::full_quadratic}}};

inline constexpr std::array<Word<GroupTake>, 3> group_take_words{
    {{"nodes", GroupTake::nodes}, {"faces", GroupTake::faces}, {"cells", GroupTake::cells}}};

inline constexpr std::array<Word<Physics>, 4> physics_words{{{"solid", Physics::solid},
                                                             {"plane_stress", Physics::plane_stress},
                                                             {"plane_strain", Physics::plane_strain},
                                                             {"axisymmetric", Physics::axisymmetric}}};

inline constexpr std::array<Word<Function::Outside>, 3> outside_words{
    {{"constant", Function::Outside::constant},
     {"linear", Function::Outside::linear},
     {"zero", Function::Outside::zero}}};

inline constexpr std::array<Word<LoadKind>, 6> load_words{{{"nodal_force", LoadKind::nodal_force},
                                                           {"moment", LoadKind::moment},
                                                           {"line_force", LoadKind::line_force},
                                                           {"surface_force", LoadKind::surface_force},
                                                           {"pressure", LoadKind::pressure},
                                                           {"gravity", LoadKind::gravity}}};

/// The words of a table whose rows have a name and, as `member`, what it stands for.
template <class Entry, class Value, std::size_t N>
constexpr auto words_of(const std::array<Entry, N>& entries, Value Entry::*member) {
  std::array<Word<Value>, N> words{};
  for (std::size_t i = 0; i < N; ++i)
    words[i] = {entries[i].name, entries[i].*member};
  return words;
}
inline constexpr auto contact_method_words = words_of(contact_methods, &ContactMethodEntry::method);
inline constexpr auto friction_method_words = words_of(friction_methods, &FrictionMethodEntry::method);

inline constexpr auto group_words = words_of(group_kinds, &GroupKindEntry::kind);

inline constexpr auto law_words = words_of(material_laws, &LawEntry::law);

inline constexpr auto hardening_words = words_of(hardenings, &HardeningEntry::kind);

inline constexpr std::array<Word<StrainKind>, 3> strain_words{{{"small", StrainKind::small},
                                                               {"green_lagrange", StrainKind::green_lagrange},
                                                               {"logarithmic", StrainKind::logarithmic}}};

inline constexpr std::array<Word<Formulation>, 4> formulation_words{
    {{"full", Formulation::full},
     {"mean_dilatation", Formulation::mean_dilatation},
     {"enhanced", Formulation::enhanced},
     {"reduced", Formulation::reduced}}};

inline constexpr std::array<Word<VolumeEnergy>, 2> volume_energy_words{
    {{"logarithmic", VolumeEnergy::logarithmic}, {"quadratic", VolumeEnergy::quadratic}}};

inline constexpr std::array<Word<RelationKind>, 6> relation_words{{{"equation", RelationKind::equation},
                                                                   {"equal", RelationKind::equal},
                                                                   {"pairs", RelationKind::pairs},
                                                                   {"rigid", RelationKind::rigid},
                                                                   {"distributed", RelationKind::distributed},
                                                                   {"embedded", RelationKind::embedded}}};

/// A displacement is given as `value`.
inline constexpr std::array<Word<Given>, 3> given_words{
    {{"value", Given::displacement}, {"velocity", Given::velocity}, {"acceleration", Given::acceleration}}};

inline constexpr std::array<Word<BaseFrame>, 2> base_frame_words{
    {{"relative", BaseFrame::relative}, {"absolute", BaseFrame::absolute}}};

/// `along: normal`.
inline constexpr std::string_view normal_word = "normal";

inline constexpr std::array<Word<ContactNormal>, 3> contact_normal_words{
    {{"master", ContactNormal::master},
     {"slave", ContactNormal::slave},
     {"average", ContactNormal::average}}};

inline constexpr std::array<Word<ClampedNormal>, 2> clamped_normal_words{
    {{"projection", ClampedNormal::projection}, {"code_aster", ClampedNormal::code_aster}}};

inline constexpr std::array<Word<ExponentialCurve>, 2> exponential_curve_words{
    {{"abaqus", ExponentialCurve::abaqus}, {"calculix", ExponentialCurve::calculix}}};

inline constexpr std::array<Word<ObstacleKind>, 3> obstacle_words{
    {{"plane", ObstacleKind::plane}, {"cylinder", ObstacleKind::cylinder}, {"sphere", ObstacleKind::sphere}}};

inline constexpr std::array<Word<ObstacleSide>, 2> obstacle_side_words{
    {{"outside", ObstacleSide::outside}, {"inside", ObstacleSide::inside}}};

inline constexpr std::array<Word<Iteration>, 2> iteration_words{
    {{"newton", Iteration::newton}, {"fixed_point", Iteration::fixed_point}}};

inline constexpr std::array<Word<Solver>, 4> solver_words{{{"auto", Solver::automatic},
                                                           {"condensed", Solver::condensed},
                                                           {"full", Solver::full},
                                                           {"iterative", Solver::iterative}}};

inline constexpr std::array<Word<TangentChoice>, 3> tangent_words{
    {{"auto", TangentChoice::automatic}, {"full", TangentChoice::full}, {"kept", TangentChoice::kept}}};

inline constexpr auto scheme_words = words_of(schemes, &SchemeEntry::kind);

inline constexpr std::array<Word<ContactMass>, 2> contact_mass_words{
    {{"consistent", ContactMass::consistent}, {"redistributed", ContactMass::redistributed}}};

/// `time.step` of an explicit run that chooses it by itself.
inline constexpr std::string_view automatic_step = "auto";

/// `start: {from: …}` is a map, not a word.
inline constexpr std::array<Word<StartKind>, 2> start_words{
    {{"consistent", StartKind::consistent}, {"at_rest_unloaded", StartKind::at_rest_unloaded}}};

inline constexpr std::array<Word<ProbeField>, 22> probe_field_words{
    {{"displacement", ProbeField::displacement},
     {"velocity", ProbeField::velocity},
     {"acceleration", ProbeField::acceleration},
     {"rotation", ProbeField::rotation},
     {"reaction", ProbeField::reaction},
     {"internal_force", ProbeField::internal_force},
     {"contact_force", ProbeField::contact_force},
     {"temperature", ProbeField::temperature},
     {"stress", ProbeField::stress},
     {"von_mises", ProbeField::von_mises},
     {"strain", ProbeField::strain},
     {"plastic_strain", ProbeField::plastic_strain},
     {"cumulated_plastic_strain", ProbeField::cumulated_plastic_strain},
     {"tresca", ProbeField::tresca},
     {"mean_stress", ProbeField::mean_stress},
     {"principal_stress", ProbeField::principal_stress},
     {"contact_pressure", ProbeField::contact_pressure},
     {"contact_gap", ProbeField::contact_gap},
     {"contact_slip", ProbeField::contact_slip},
     {"contact_status", ProbeField::contact_status},
     {"contact_cumulated_slip", ProbeField::contact_cumulated_slip},
     {"contact_friction_work", ProbeField::contact_friction_work}}};

inline constexpr std::array<Word<ProbeTake>, 4> probe_take_words{{{"sum", ProbeTake::sum},
                                                                  {"mean", ProbeTake::mean},
                                                                  {"min", ProbeTake::least},
                                                                  {"max", ProbeTake::largest}}};

inline constexpr std::array<Word<ProbePlace>, 3> probe_place_words{
    {{"nodes", ProbePlace::nodes}, {"cells", ProbePlace::cells}, {"gauss_points", ProbePlace::gauss_points}}};

/// `over`; an instant is given by `at`.
inline constexpr std::array<Word<CheckedTime>, 3> checked_time_words{
    {{"max", CheckedTime::largest},
     {"min", CheckedTime::least},
     {"max_magnitude", CheckedTime::largest_magnitude}}};

inline constexpr std::array<Word<bool>, 2> check_kind_words{{{"relative", true}, {"absolute", false}}};

inline constexpr std::array<Word<CheckSource>, 4> check_source_words{{{"external", CheckSource::external},
                                                                      {"analytic", CheckSource::analytic},
                                                                      {"other_code", CheckSource::other_code},
                                                                      {"other_run", CheckSource::other_run}}};

inline constexpr std::array<std::string_view, 3> axis_words{"x", "y", "z"};

/// Formats of stored fields.
inline constexpr std::array<std::string_view, 4> field_formats{"vtu", "med", "vtkhdf", "frd"};

/// The word of a value, accepted or not.
template <class E, std::size_t N>
constexpr std::string_view word_of(const std::array<Word<E>, N>& table, E value) {
  for (const auto& word : table)
    if (word.value == value)
      return word.text;
  return {};
}

/// Axes of the mesh and of every vector in the deck.
constexpr int dimension_of(Physics physics) {
  return physics == Physics::solid ? 3 : 2;
}

} // namespace rubato::study
