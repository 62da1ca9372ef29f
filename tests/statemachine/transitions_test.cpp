// Effect of each event in each mode, frozen and not frozen, and the legends. Expected values: tables (*.csv) written by
// hand from docs/pilots_manual.md#buttons and #controls.
#include <gtest/gtest.h>

#include <set>

#include "tests/statemachine/csv.hpp"
#include "tests/statemachine/pilot.hpp"

namespace yars::statemachine::testing {
namespace {

const std::vector<std::string> kModes{"OFF", "STBY", "RBM", "HRM",  "MAPS",  "PATCH", "BCN",
                                      "PVU", "AA",   "AGR", "MENU", "AAMAP", "AASET", "AGSET"};

// Field `mode` of fields_of() in a state of the tables.
std::string word_of(const std::string& mode) {
  static const std::map<std::string, std::string> words{{"OFF", "RBM"},  {"STBY", "RBM"}, {"MAPS", "HRM"},
                                                        {"AAMAP", "AA"}, {"AASET", "AA"}, {"AGSET", "PATCH"}};
  const auto word = words.find(mode);
  return word == words.end() ? mode : word->second;
}

// True in states that show a frozen map outside of the normal patch mode.
bool map_stands(const std::string& mode) {
  return mode == "AAMAP" || mode == "AASET" || mode == "AGSET";
}

// False for combinations that cannot occur: OFF forgets the freeze, and freeze is dead in PVU.
bool reachable(const std::string& mode, bool frozen) {
  return !frozen || (mode != "OFF" && mode != "PVU");
}

// One event in one state, with its expected effect.
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

// The fields after an effect such as "mode=HRM range_nm=20". `mode` also sets `running`, except for MENU.
Fields expected_after(Fields fields, const std::string& effect) {
  for (const std::string& change : split(effect, ' ')) {
    const auto equals = change.find('=');
    if (equals == std::string::npos) continue;  // further words of a message
    const std::string name = change.substr(0, equals);
    const std::string value = change.substr(equals + 1);
    fields[name] = name == "message" ? effect.substr(effect.find("message=") + 8) : value;
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

void put_recorder(Inputs& around, const std::string& recorder) {
  around.recorder_present = recorder != "none";
  around.recorder_writing = recorder == "writing";
  around.recorder_failed = recorder == "full";
}

TEST(Transitions, Pb12ActsOnTheRecorderAsTheTableStates) {
  std::size_t cases = 0;
  for (const Row& row : read_csv("recorder.csv"))
    for (const std::string& mode : split(row.at("mode"), '|'))
      for (const std::string& frozen : split(row.at("frozen"), '|'))
        for (const std::string& recorder : split(row.at("recorder"), '|')) {
          if (!reachable(mode, frozen == "yes")) continue;
          SCOPED_TRACE(row.at("event") + " in " + mode + ", frozen " + frozen + ", recorder " + recorder);
          Pilot pilot;
          bring_into(pilot, mode, frozen == "yes");
          put_recorder(pilot.around, recorder);
          pilot.wait();
          pilot.state.message[0] = '\0';
          const Fields before = fields_of(pilot);
          const bool dead = row.at("effect") == "dead";
          EXPECT_EQ(pilot.send(row.at("event")), !dead);
          EXPECT_EQ(fields_of(pilot), dead ? before : expected_after(before, row.at("effect")));
          ++cases;
        }
  EXPECT_GT(cases, 80U);
}

struct FunctionCase {
  Case one;
  radar::CursorFunction function;
};

radar::CursorFunction function_named(const std::string& name) {
  using radar::CursorFunction;
  for (const auto function :
       {CursorFunction::update, CursorFunction::cue, CursorFunction::target, CursorFunction::mark})
    if (name_of(function) == name) return function;
  throw std::runtime_error("no cursor function " + name);
}

std::vector<FunctionCase> function_cases() {
  std::vector<FunctionCase> all;
  for (const Row& row : read_csv("cursor_functions.csv"))
    for (const std::string& function : split(row.at("function"), '|'))
      for (const std::string& mode : split(row.at("mode"), '|'))
        for (const std::string& frozen : split(row.at("frozen"), '|'))
          if (reachable(mode, frozen == "yes"))
            all.push_back({{row.at("event"), mode, frozen == "yes", row.at("effect"), row.at("source")},
                           function_named(function)});
  return all;
}

// The rows of cursor_functions.csv, and all other events with the effects of transitions.csv.
std::vector<FunctionCase> all_function_cases() {
  std::vector<FunctionCase> all = function_cases();
  std::set<std::string> own;
  for (const FunctionCase& row : all) own.insert(row.one.event);
  for (const Case& one : cases()) {
    if (own.count(one.event) != 0 || one.mode == "OFF") continue;
    for (const char* function : {"UPDT", "CUE", "TGT", "MARK"}) all.push_back({one, function_named(function)});
  }
  return all;
}

TEST(Transitions, EveryRowHoldsInEveryCursorFunction) {
  for (const auto& [one, function] : all_function_cases()) {
    SCOPED_TRACE(one.event + " in " + one.mode + (one.frozen ? " frozen, " : ", ") + std::string(name_of(function)) +
                 " (" + one.source + ")");
    Pilot pilot;
    bring_into(pilot, one.mode, one.frozen);
    pilot.state.cursor_function = static_cast<std::uint8_t>(function);
    if (function == radar::CursorFunction::update && one.event == "tdc release") pilot.send("nav error mn 2500 0");
    pilot.wait();
    const Fields before = fields_of(pilot);
    const databuffer::RadarState untouched = pilot.state;

    const bool did = pilot.send(one.event);

    const bool dead = one.effect == "dead";
    EXPECT_EQ(did, !dead);
    if (dead) {
      EXPECT_EQ(std::memcmp(&untouched, &pilot.state, sizeof untouched), 0) << "a dead event changed something";
    }
    Fields expected = expected_after(before, dead ? "" : one.effect);
    // Power off resets the function to MAP. SET keeps a function other than MAP.
    if (one.event == "power off") expected["cursor_function"] = "MAP";
    if (one.event == "pb 18" && expected["set"] != before.at("set")) expected["cursor_function"] = name_of(function);
    EXPECT_EQ(fields_of(pilot), expected);
  }
}

TEST(Transitions, TheTableOfCursorFunctionsHasEveryModeForEveryEventOnce) {
  std::map<std::string, std::multiset<std::string>> named;
  for (const auto& [one, function] : function_cases())
    named[one.event + " " + std::string(name_of(function))].insert(one.mode + (one.frozen ? " frozen" : ""));
  EXPECT_EQ(named.size(), 7U * 4U);
  for (const auto& [event, modes] : named) {
    for (const std::string& mode : kModes) {
      if (mode == "OFF") continue;
      EXPECT_EQ(modes.count(mode), 1U) << event << " in " << mode;
      EXPECT_EQ(modes.count(mode + " frozen"), reachable(mode, true) ? 1U : 0U) << event << " in " << mode;
    }
  }
}

TEST(Transitions, TheTableHasEveryModeForEveryEventOnce) {
  std::map<std::string, std::multiset<std::string>> named;
  for (const Case& one : cases()) named[one.event].insert(one.mode + (one.frozen ? " frozen" : ""));
  for (int button = 1; button <= 20; ++button) EXPECT_EQ(named.count("pb " + std::to_string(button)), 1U) << button;
  std::set<int> kinds;
  for (const auto& entry : named) kinds.insert(databuffer::event_from_text(entry.first)->kind);
  EXPECT_EQ(kinds.size(), 19U) << "a kind of event is missing; `next` is for tours";
  for (const auto& [event, modes] : named) {
    for (const std::string& mode : kModes) {
      EXPECT_EQ(modes.count(mode), 1U) << event << " in " << mode;
      const std::string frozen = mode + " frozen";
      EXPECT_EQ(modes.count(frozen), reachable(mode, true) ? 1U : 0U) << event << " in " << frozen;
    }
  }
}

TEST(Legends, AreThoseOfTheTableInEveryMode) {
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
