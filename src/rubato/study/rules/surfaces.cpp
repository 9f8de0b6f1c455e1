// SPDX-License-Identifier: LGPL-3.0-or-later
// Which surfaces a contact zone has: master and slave, or what stands for both.
#include "rubato/study/contact_methods.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

namespace rubato::study {
namespace {

class SurfaceRules {
public:
  SurfaceRules(Rules& rules, const ContactZone& zone)
      : rules_(rules), zone_(zone), path_("contact." + zone.name) {}

  void check() {
    const auto ways = ways_asked_for();
    if (ways.size() > 1)
      return tell_several(ways);
    if (ways.empty())
      return check_given();
    check_no_sides(ways.front());
    if (!zone_.between.empty())
      check_between();
    else if (!zone_.self.empty())
      check_self();
  }

private:
  std::string at(std::string_view key) const { return fmt::format("{}.{}", path_, key); }

  std::vector<std::string_view> ways_asked_for() const {
    std::vector<std::string_view> ways;
    if (!zone_.between.empty())
      ways.emplace_back("between");
    if (!zone_.self.empty())
      ways.emplace_back("self");
    if (zone_.all)
      ways.emplace_back("all");
    return ways;
  }

  void tell_several(const std::vector<std::string_view>& ways) {
    rules_.broken({at(ways[1]), at(ways[0])},
                  fmt::format("found both '{}' and '{}', expected one of them", ways[0], ways[1]));
  }

  void check_given() {
    rules_.name(at("slave"), zone_.slave);
    if (zone_.master.empty() != zone_.obstacle.has_value())
      rules_.broken({path_, at("master"), at("obstacle")},
                    zone_.obstacle ? "found both 'master' and 'obstacle', expected one of them"
                                   : "'master' or 'obstacle' is missing");
    if (!zone_.slave.empty() && zone_.slave == zone_.master)
      rules_.broken({at("slave"), at("master")},
                    fmt::format("found {} as slave and as master, expected two surfaces{}",
                                shown(zone_.slave),
                                zone_.tie ? "" : ", or 'self' for one that touches itself"));
  }

  void check_no_sides(std::string_view way) {
    const auto refuse = [&](bool given, std::string_view key) {
      if (given)
        rules_.broken({at(key), at(way)},
                      fmt::format("found '{}' beside '{}', which stands for both sides, expected one of them",
                                  key, way));
    };
    refuse(!zone_.master.empty(), "master");
    refuse(!zone_.slave.empty(), "slave");
    refuse(zone_.obstacle.has_value(), "obstacle");
  }

  void check_between() {
    rules_.names(at("between"), zone_.between);
    if (zone_.between.size() != 2)
      rules_.broken({at("between")}, fmt::format("found {} name{}, expected two surfaces",
                                                 zone_.between.size(), zone_.between.size() == 1 ? "" : "s"));
  }

  void check_self() {
    if (zone_.tie)
      rules_.broken({at("tie"), at("self")}, "found 'tie' with 'self': a surface is one with itself already, "
                                             "expected two surfaces, or no 'tie'");
    if (zone_.freeze)
      rules_.broken({at("freeze"), at("self")},
                    "found 'freeze' with 'self', whose faces have to move to meet, expected no 'freeze'");
    if (zone_.normal != ContactNormal::master)
      rules_.broken({at("normal"), at("self")},
                    fmt::format("found {} with 'self', where the other side gives the normal, expected no "
                                "'normal'",
                                word_of(contact_normal_words, zone_.normal)));
    if (zone_.smoothing)
      rules_.broken({at("smoothing"), at("self")},
                    "found smoothing: true with 'self', where a fold has no mean normal, expected no "
                    "'smoothing'");
  }

  Rules& rules_;
  const ContactZone& zone_;
  std::string path_;
};

} // namespace

void check_surfaces(Rules& rules, const ContactZone& zone) {
  SurfaceRules(rules, zone).check();
}

} // namespace rubato::study
