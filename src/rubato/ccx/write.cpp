// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/ccx/write.hpp"

#include "rubato/ccx/draft.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/modes/modal_study.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::ccx {
namespace {

constexpr std::size_t longest_comment = 110;

/// A sentence as comment lines.
std::string comment_of(const std::string& sentence) {
  std::string text = "**";
  std::size_t length = 2;
  for (std::size_t begin = 0; begin < sentence.size();) {
    auto end = std::min(sentence.find(' ', begin), sentence.size());
    const auto word = sentence.substr(begin, end - begin);
    if (length + 1 + word.size() > longest_comment) {
      text += "\n**  ";
      length = 4;
    }
    text += " " + word;
    length += 1 + word.size();
    begin = end + 1;
  }
  std::ranges::replace_if(
      text, [](char c) { return c == '\r' || c == '\t'; }, ' ');
  return text + "\n";
}

/// The title in one line, which is no keyword.
std::string heading_of(const study::Study& study) {
  auto title = study.title.empty() ? std::string("rubato") : study.title;
  std::ranges::replace_if(
      title, [](unsigned char c) { return c < ' ' || c > '~'; }, ' ');
  if (title.front() == '*')
    title.front() = ' ';
  return "*HEADING\n" + title + "\n";
}

void check_order(const Draft& draft, const study::Study& study, bool modes) {
  if (modes || draft.last_run.empty())
    return;
  const auto& time = study.time;
  if (time.start != study::StartKind::from_run || time.start_run != draft.last_run)
    throw InputError(
        {fault_at("time.start", fmt::format("found the run '{}' after '{}', which it does not start from; "
                                            "the steps of a file follow one another, expected one run "
                                            "(--only) or 'start: {{from: {}}}'",
                                            study.name, draft.last_run, draft.last_run))});
}

void check_first(const study::Study& study) {
  if (study.time.start == study::StartKind::from_run)
    throw InputError(
        {fault_at("time.start", fmt::format("found a start from the run '{}', which is not written before "
                                            "it; expected that run too",
                                            study.time.start_run))});
}

/// Supports and loads that differ from those of the step before, instead of these.
std::string changed_parts(Draft& draft, const std::map<std::string, std::string>& parts) {
  std::string text;
  const bool is_first = draft.steps.empty();
  for (const auto* keyword : {"*BOUNDARY", "*CLOAD", "*DLOAD", "*TEMPERATURE"}) {
    const auto& now = parts.at(keyword);
    auto& before = draft.parts[keyword];
    if (now == before)
      continue;
    before = now;
    auto renewed = now.empty() ? fmt::format("{}\n", keyword) : now;
    if (!is_first)
      for (std::size_t at = renewed.find('*'); at != std::string::npos; at = renewed.find("\n*", at)) {
        at += renewed[at] == '\n' ? 1 : 0;
        const auto end = std::min(renewed.find_first_of(",\n", at), renewed.size());
        renewed.insert(end, ", OP=NEW");
        at = end;
      }
    text += renewed;
  }
  return text;
}

std::string write_body(Run& run) {
  write_materials(run);
  write_relations(run);
  write_springs(run);
  write_masses(run);
  write_contact(run);
  return run.body;
}

void check_body(const Draft& draft, const std::string& body, const study::Study& study) {
  if (!draft.steps.empty() && body != draft.body)
    throw InputError(
        {fault_at("time.start", fmt::format("found the run '{}' with other materials, relations, springs or "
                                            "contact than '{}'; CalculiX keeps them in all steps of a "
                                            "file, expected the same",
                                            study.name, draft.last_run))});
}

} // namespace

InputFile::InputFile() : draft_(std::make_unique<Draft>()) {}
InputFile::InputFile(InputFile&&) noexcept = default;
InputFile& InputFile::operator=(InputFile&&) noexcept = default;
InputFile::~InputFile() = default;

void InputFile::add(const study::Study& study, const std::optional<Frequencies>& modes) {
  auto& draft = *draft_;
  const bool is_first = draft.steps.empty();
  check_order(draft, study, modes.has_value());
  if (is_first && !modes)
    check_first(study);
  const auto model = model::build_model(modes ? rubato::modes::modal_study(study) : study);
  std::vector<Fault> faults;
  Run run{model, draft, faults};
  run.modes = modes.has_value();
  run.nonlinear = study::takes_large_rotations(study);
  check_limits(run);
  if (!faults.empty())
    throw InputError(faults);
  if (is_first) {
    draft.begin = study.time.begin;
    draft.mesh = heading_of(study);
    write_mesh(run);
    write_initial(run);
  }
  run.next_element = draft.next_element;
  auto body = write_body(run);
  std::map<std::string, std::string> parts;
  write_loads(run, parts);
  parts["*TEMPERATURE"] = temperature_lines(run);
  parts["*BOUNDARY"] = support_lines(run);
  const auto procedure = procedure_lines(run, modes);
  const auto requests = request_lines(run);
  if (!faults.empty())
    throw InputError(faults);
  check_body(draft, body, study);
  draft.body = std::move(body);
  draft.steps.push_back(
      fmt::format("** {}\n{}{}{}*END STEP\n", study.name, procedure, changed_parts(draft, parts), requests));
  if (!modes)
    draft.last_run = study.name;
}

std::string InputFile::text() const {
  const auto& draft = *draft_;
  std::string text;
  for (const auto& note : draft.notes)
    text += comment_of(note);
  text += draft.mesh;
  if (!draft.more_nodes.empty())
    text += "** nodes that stand for sums of displacements\n*NODE\n" + draft.more_nodes;
  text += draft.more_sets + draft.amplitudes + draft.body;
  for (const auto& [place, equation] : draft.copies)
    text += equation;
  text += draft.initial;
  for (const auto& step : draft.steps)
    text += step;
  return text;
}

const std::vector<std::string>& InputFile::notes() const {
  return draft_->notes;
}

} // namespace rubato::ccx
