// The one table of forms and slots: reading, checking and printing all come from it. Names and positions are those of
// the 1996 report's tables 4 to 26; what YARS adds stands behind the report's positions.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/draft.hpp"

namespace yars::config {

// What a slot holds and where it goes. A null `of` means: checked, and used by nothing yet.
struct NumberSlot {
  double& (*of)(Draft&) = nullptr;
  double si_per_unit = 1.0;  // the field is in SI, the slot in its unit
};
struct IntegerSlot {
  int& (*of)(Draft&) = nullptr;
};
struct CounterSlot {
  std::uint64_t& (*of)(Draft&) = nullptr;
};
struct BooleanSlot {
  bool& (*of)(Draft&) = nullptr;
};
struct TextSlot {
  std::string& (*of)(Draft&) = nullptr;
};
struct PathSlot {  // relative to the file it is written in
  std::string& (*of)(Draft&) = nullptr;
};
struct AngleSlot {  // degrees, or a lat-long form
  double& (*of)(Draft&) = nullptr;
  bool latitude = true;
};
struct ChoiceSlot {
  std::span<const std::string_view> words;
  int (*get)(const Draft&) = nullptr;  // index into words; negative: nothing to print
  void (*set)(Draft&, int) = nullptr;
};
enum class Order { any, ascending, descending };
struct ListSlot {
  std::vector<double>& (*of)(Draft&) = nullptr;
  std::size_t least = 1;
  std::size_t most = 16;
  Order order = Order::any;
};
struct FirstSlot {  // a list of which the first number is taken
  int& (*of)(Draft&) = nullptr;
};
struct PairSlot {
  double& (*first)(Draft&) = nullptr;
  double& (*second)(Draft&) = nullptr;
};
struct SpanSlot {  // `( low high ), low below high; a single number is the whole span
  double& (*low)(Draft&) = nullptr;
  double& (*high)(Draft&) = nullptr;
  bool centred = true;  // a single number n is -n/2 to n/2, else 0 to n
};
struct SymmetricSlot {  // `( -limit limit )
  double& (*of)(Draft&) = nullptr;
};
struct FormSlot {
  std::vector<std::string_view> accepted;
  std::vector<std::string_view> printed;  // which of them print writes, in this order
  bool many = false;                      // a list of forms; one alone is a list of one
  void (*take)(Draft&) = nullptr;         // called with each form read: what it made, from the draft into its place
  void (*give)(Draft&) = nullptr;         // called before print writes the form: the other way
};

using Binding = std::variant<NumberSlot, IntegerSlot, CounterSlot, BooleanSlot, TextSlot, PathSlot, AngleSlot,
                             ChoiceSlot, ListSlot, FirstSlot, PairSlot, SpanSlot, SymmetricSlot, FormSlot>;

struct SlotSchema {
  std::string_view name{};
  std::string_view unit{};  // "deg", "NM", "" for none
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  Binding binding{};
  std::string_view purpose{};
  std::string_view same_as{};   // another slot that print writes instead of this one
  std::string_view old_name{};  // a spelling of 1996, accepted with a warning
  bool before_others = false;   // read first, wherever it stands in its form
};

// A slot that breaks a rule between slots of one form.
struct Complaint {
  std::string_view slot{};
  std::string expected{};
  std::string found{};
};

struct FormSchema {
  std::string_view name{};
  std::string_view base{};  // as in def-form; empty: none
  std::string_view purpose{};
  std::vector<SlotSchema> slots{};  // by position; those of the base first
  bool part_of_value = false;       // a colour, an angle, a point: never outside all parentheses
  std::string_view old_name{};
  void (*begin)(Draft&) = nullptr;
  std::optional<Complaint> (*check)(const Draft&) = nullptr;
  void (*end)(Draft&) = nullptr;
  // A rule with other forms, wherever they stand: looked at when all is read, for the last form that has it.
  std::optional<Complaint> (*agree)(const Draft&) = nullptr;
  std::size_t (*count)(const Draft&) = nullptr;  // how many of them print writes; null: one
  void (*select)(Draft&, std::size_t) = nullptr;
};

const std::vector<FormSchema>& schema();

enum class Spelling { exact, other_case, old_name };
template <class Schema>
struct Found {
  const Schema* schema = nullptr;  // null: there is none
  Spelling spelling = Spelling::exact;
};

// By name; letters' case does not count.
Found<FormSchema> find_form(std::string_view name);
Found<SlotSchema> find_slot(const FormSchema& form, std::string_view name);

// The name nearest to a misspelled one, for "did you mean"; empty when none is near.
std::string_view nearest_slot(const FormSchema& form, std::string_view name);

// Whether anything in YARS uses what the slot holds.
bool is_used(const SlotSchema& slot);

// The kind of value and the range, for messages and the manual: "a number in [0, 60] deg".
std::string value_kind(const SlotSchema& slot);

}  // namespace yars::config
