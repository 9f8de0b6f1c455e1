// SPDX-License-Identifier: LGPL-3.0-or-later
// The enumerations of a study, by the words that decks have for them.
#include "rubato/cell/topology.hpp"
#include "rubato/study/table_words.hpp"

#include "values.hpp"
#include <algorithm>
#include <cctype>

namespace rubato::python {
namespace {

/// The words of a table in the order of the enumerators. `unsaid`: of the enumerator that decks choose
/// otherwise than by a word.
template <class E, std::size_t N>
WordList listed(std::string_view class_name, std::string_view meaning,
                const std::array<study::Word<E>, N>& table,
                std::initializer_list<study::Word<E>> unsaid = {}) {
  std::vector<study::Word<E>> words(table.begin(), table.end());
  words.insert(words.end(), unsaid.begin(), unsaid.end());
  std::ranges::sort(words, {}, &study::Word<E>::value);
  WordList list{class_name, meaning, {}};
  for (const auto& word : words)
    list.words.emplace_back(word.text);
  return list;
}

WordList cell_types() {
  WordList list{"CellType", "Types of cells.", {}};
  for (const auto& shape : cell::all_topologies()) {
    std::string name(shape.name);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    list.words.push_back(std::move(name));
  }
  return list;
}

} // namespace

template <> const WordList& words_of<CellType>() {
  static const auto list = cell_types();
  return list;
}
template <> const WordList& words_of<study::MeshConversion>() {
  static const auto list =
      listed("MeshConversion", "What order the cells of a mesh are given.", study::conversion_words);
  return list;
}
template <> const WordList& words_of<study::GroupKind>() {
  static const auto list =
      listed("GroupKind", "How a group is made of what the mesh has.", study::group_words);
  return list;
}
template <> const WordList& words_of<study::GroupTake>() {
  static const auto list = listed("GroupTake", "What of the mesh a shape chooses.", study::group_take_words);
  return list;
}
template <> const WordList& words_of<study::Physics>() {
  static const auto list = listed("Physics", "What the bodies are.", study::physics_words);
  return list;
}
template <> const WordList& words_of<LinearTable::Outside>() {
  static const auto list = listed("Outside", "What a table is outside of its places.", study::outside_words);
  return list;
}
template <> const WordList& words_of<study::LoadKind>() {
  static const auto list = listed("LoadKind", "What a load is.", study::load_words);
  return list;
}
template <> const WordList& words_of<study::ContactMethod>() {
  static const auto list = listed("ContactMethod", "How contact is enforced.", study::contact_method_words);
  return list;
}
template <> const WordList& words_of<study::FrictionMethod>() {
  static const auto list =
      listed("FrictionMethod", "How friction is enforced.", study::friction_method_words);
  return list;
}
template <> const WordList& words_of<study::ContactIntegration>() {
  static const auto list =
      listed("ContactIntegration", "Where contact points stand on a slave face.",
             study::words_of(study::contact_integrations, &study::ContactIntegrationEntry::method));
  return list;
}
template <> const WordList& words_of<study::LawKind>() {
  static const auto list = listed("LawKind", "What gives stresses from strains.", study::law_words);
  return list;
}
template <> const WordList& words_of<study::HardeningKind>() {
  static const auto list = listed("HardeningKind", "How the yield stress grows.", study::hardening_words);
  return list;
}
template <> const WordList& words_of<study::StrainKind>() {
  static const auto list = listed("StrainKind", "The strain that a law sees.", study::strain_words);
  return list;
}
template <> const WordList& words_of<study::Formulation>() {
  static const auto list = listed("Formulation", "How cells are integrated.", study::formulation_words);
  return list;
}
template <> const WordList& words_of<study::VolumeEnergy>() {
  static const auto list =
      listed("VolumeEnergy", "Energy of changes of volume of hyperelastic laws.", study::volume_energy_words);
  return list;
}
template <> const WordList& words_of<study::TangentChoice>() {
  static const auto list =
      listed("TangentChoice", "When nonlinear bodies have their matrix factored anew.", study::tangent_words);
  return list;
}
template <> const WordList& words_of<study::RelationKind>() {
  static const auto list = listed("RelationKind", "What ties displacements.", study::relation_words);
  return list;
}
template <> const WordList& words_of<study::Given>() {
  static const auto list =
      listed("Given", "What of a motion a value gives; value: the displacement.", study::given_words);
  return list;
}
template <> const WordList& words_of<study::BaseFrame>() {
  static const auto list =
      listed("BaseFrame", "Where displacements are counted from.", study::base_frame_words);
  return list;
}
template <> const WordList& words_of<study::ContactNormal>() {
  static const auto list =
      listed("ContactNormal", "The surface whose normals count.", study::contact_normal_words);
  return list;
}
template <> const WordList& words_of<study::ClampedNormal>() {
  static const auto list = listed("ClampedNormal", "The normal of a point beside the end of the master.",
                                  study::clamped_normal_words);
  return list;
}
template <> const WordList& words_of<study::ExponentialCurve>() {
  static const auto list =
      listed("ExponentialCurve", "Whose law exponential pressures follow.", study::exponential_curve_words);
  return list;
}
template <> const WordList& words_of<study::ObstacleKind>() {
  static const auto list = listed("ObstacleKind", "The shape of an obstacle.", study::obstacle_words);
  return list;
}
template <> const WordList& words_of<study::ObstacleSide>() {
  static const auto list =
      listed("ObstacleSide", "Where the bodies are that an obstacle touches.", study::obstacle_side_words);
  return list;
}
template <> const WordList& words_of<study::Iteration>() {
  static const auto list = listed("Iteration", "Whether a level is part of Newton's iterations or a loop.",
                                  study::iteration_words);
  return list;
}
template <> const WordList& words_of<study::Solver>() {
  static const auto list = listed("Solver", "How implicit steps are solved.", study::solver_words);
  return list;
}
template <> const WordList& words_of<study::SchemeKind>() {
  static const auto list = listed("SchemeKind", "Time schemes.", study::scheme_words);
  return list;
}
template <> const WordList& words_of<study::ContactMass>() {
  static const auto list = listed("ContactMass", "What the slave surfaces weigh.", study::contact_mass_words);
  return list;
}
template <> const WordList& words_of<study::StartKind>() {
  static const auto list = listed("StartKind", "How a run begins.", study::start_words,
                                  {{"from_run", study::StartKind::from_run}});
  return list;
}
template <> const WordList& words_of<study::ProbeField>() {
  static const auto list = listed("ProbeField", "What a probe has the history of.", study::probe_field_words);
  return list;
}
template <> const WordList& words_of<study::ProbeTake>() {
  static const auto list =
      listed("ProbeTake", "What a probe takes of the nodes of a group; node: there is one.",
             study::probe_take_words, {{"node", study::ProbeTake::node}});
  return list;
}
template <> const WordList& words_of<study::ProbePlace>() {
  static const auto list = listed("ProbePlace", "Where a probe has its values.", study::probe_place_words);
  return list;
}
template <> const WordList& words_of<study::TableOf>() {
  static const auto list = listed("TableOf", "What the lines of a table are of.", study::table_of_words);
  return list;
}
template <> const WordList& words_of<study::TableTotals>() {
  static const auto list = listed("TableTotals", "Sums of a table.", study::table_totals_words);
  return list;
}
template <> const WordList& words_of<study::CheckedTime>() {
  static const auto list = listed("CheckedTime", "When a checked history has its value.",
                                  study::checked_time_words, {{"instant", study::CheckedTime::instant}});
  return list;
}
template <> const WordList& words_of<study::CheckSource>() {
  static const auto list =
      listed("CheckSource", "Where the reference of a check comes from.", study::check_source_words);
  return list;
}
template <> const WordList& words_of<Axis>() {
  static const WordList list{
      "Axis", "An axis of space.", {study::axis_words.begin(), study::axis_words.end()}};
  return list;
}

std::vector<const WordList*> all_words() {
  using namespace study;
  return {&words_of<CellType>(),        &words_of<MeshConversion>(),
          &words_of<GroupKind>(),       &words_of<GroupTake>(),
          &words_of<Physics>(),         &words_of<LinearTable::Outside>(),
          &words_of<LoadKind>(),        &words_of<ContactMethod>(),
          &words_of<FrictionMethod>(),  &words_of<ContactIntegration>(),
          &words_of<LawKind>(),         &words_of<HardeningKind>(),
          &words_of<StrainKind>(),      &words_of<Formulation>(),
          &words_of<VolumeEnergy>(),    &words_of<TangentChoice>(),
          &words_of<RelationKind>(),    &words_of<Given>(),
          &words_of<BaseFrame>(),       &words_of<ContactNormal>(),
          &words_of<ClampedNormal>(),   &words_of<ObstacleKind>(),
          &words_of<ObstacleSide>(),    &words_of<Iteration>(),
          &words_of<Solver>(),          &words_of<SchemeKind>(),
          &words_of<ContactMass>(),     &words_of<StartKind>(),
          &words_of<ProbeField>(),      &words_of<ProbeTake>(),
          &words_of<ProbePlace>(),      &words_of<CheckedTime>(),
          &words_of<CheckSource>(),     &words_of<TableOf>(),
          &words_of<TableTotals>(),     &words_of<Axis>(),
          &words_of<ExponentialCurve>()};
}

} // namespace rubato::python
