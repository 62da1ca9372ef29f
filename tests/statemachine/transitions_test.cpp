// Every mode x event x frozen or not, from tables written by hand from the spec.
#include <gtest/gtest.h>

#include <set>

#include "tests/statemachine/csv.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

const std::vector<std::string> kModes{"OFF", "STBY", "RBM", "HRM",  "MAPS",  "PATCH", "BCN",
                                      "PVU", "AA",   "AGR", "MENU", "AAMAP", "AASET", "AGSET"};

// The word of `yars watch` for the mode of a state.
std::string word_of(const std::string& mode) {
  static const std::map<std::string, std::string> words{{"OFF", "RBM"},  {"STBY", "RBM"}, {"MAPS", "HRM"},
                                                        {"AAMAP", "AA"}, {"AASET", "AA"}, {"AGSET", "PATCH"}};
  const auto word = words.find(mode);
  return word == words.end() ? mode : word->second;
}

bool map_stands(const std::string& mode) {
  return mode == "AAMAP" || mode == "AASET" || mode == "AGSET";
}

// OFF forgets the freeze, and freeze is dead in PVU.
bool reachable(const std::string& mode, bool frozen) {
  return !frozen || (mode != "OFF" && mode != "PVU");
}

struct Case {
  std::string event;
  std::string mode;
  bool frozen;
  std::string effect;
  std::string source;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Row& row : read_csv("transitions.csv")) {
    for (const std::string& mode : split(row.at("mode"), '|')) {
      for (const std::string& frozen : split(row.at("frozen"), '|')) {
        if (!reachable(mode, frozen == "yes")) continue;
        all.push_back({row.at("event"), mode, frozen == "yes", row.at("effect"), row.at("source")});
      }
    }
  }
  return all;
}

// "mode=HRM range_nm=20" over the fields before; a mode shown is also the mode that runs, but for the menu.
Fields expected_after(Fields fields, const std::string& effect) {
  for (const std::string& change : split(effect, ' ')) {
    const auto equals = change.find('=');
    if (equals == std::string::npos) continue;  // second word of a message
    const std::string name = change.substr(0, equals);
    const std::string value = change.substr(equals + 1);
    fields[name] = name == "message" ? effect.substr(effect.find('=') + 1) : value;
    if (name == "mode" && value != "MENU") fields["running"] = value;
  }
  return fields;
}

TEST(Transitions, EveryRowOfTheTableHolds) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.event + " in " + one.mode + (one.frozen ? " frozen" : "") + " (" + one.source + ")");
    Pilot pilot;
    bring_into(pilot, one.mode, one.frozen);
    const Fields before = fields_of(pilot);
    ASSERT_EQ(before.at("mode"), word_of(one.mode));
    ASSERT_EQ(before.at("freeze"), one.frozen || map_stands(one.mode) ? "true" : "false");
    const databuffer::RadarState untouched = pilot.state;

    const bool did = pilot.send(one.event);

    EXPECT_EQ(did, one.effect != "dead");
    if (one.effect == "dead") {
      EXPECT_EQ(std::memcmp(&untouched, &pilot.state, sizeof untouched), 0) << "a dead event changed something";
    } else {
      EXPECT_EQ(fields_of(pilot), expected_after(before, one.effect));
    }
  }
}

TEST(Transitions, TheTableNamesEveryModeForEveryEventOnce) {
  std::map<std::string, std::multiset<std::string>> named;
  for (const Case& one : cases()) named[one.event].insert(one.mode + (one.frozen ? " frozen" : ""));
  for (int button = 1; button <= 20; ++button) EXPECT_EQ(named.count("pb " + std::to_string(button)), 1U) << button;
  std::set<int> kinds;
  for (const auto& entry : named) kinds.insert(databuffer::event_from_text(entry.first)->kind);
  EXPECT_EQ(kinds.size(), 16U) << "a kind of event is missing";
  for (const auto& [event, modes] : named) {
    for (const std::string& mode : kModes) {
      EXPECT_EQ(modes.count(mode), 1U) << event << " in " << mode;
      const std::string frozen = mode + " frozen";
      EXPECT_EQ(modes.count(frozen), reachable(mode, true) ? 1U : 0U) << event << " in " << frozen;
    }
  }
}

TEST(Legends, AreTheSpecsInEveryMode) {
  std::set<std::string> seen;
  for (const Row& row : read_csv("legends.csv")) {
    std::map<int, std::string> expected;
    for (const std::string& entry : split(row.at("legends"), ';')) {
      const auto equals = entry.find('=');
      expected[std::stoi(entry.substr(0, equals))] = entry.substr(equals + 1);
    }
    for (const std::string& frozen : split(row.at("frozen"), '|')) {
      const std::string mode = row.at("mode");
      SCOPED_TRACE(mode + " frozen " + frozen);
      seen.insert(mode + frozen);
      Pilot pilot;
      bring_into(pilot, mode, frozen == "yes");
      pilot.wait();
      for (int button = 1; button <= 20; ++button) {
        const auto entry = expected.find(button);
        EXPECT_EQ(pilot.legend(button), entry == expected.end() ? "" : entry->second) << "PB " << button;
      }
      EXPECT_EQ(pilot.state.boxed, mode == "AASET" || mode == "AGSET" ? 1U << 18 : 0U);
    }
  }
  for (const std::string& mode : kModes) {
    EXPECT_EQ(seen.count(mode + "no"), 1U) << mode;
    EXPECT_EQ(seen.count(mode + "yes"), reachable(mode, true) ? 1U : 0U) << mode;
  }
}

}  // namespace
}  // namespace yars::statemachine::testing
