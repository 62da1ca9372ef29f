#include "databuffer/messages/input_event.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

using error::Expected;
using Words = std::vector<std::string_view>;

// Kind of operands that follow the verb.
enum class Operand { none, word, steps, integer, number, pair, error, name };

// Text form of one event: verb and operands.
struct Form {
  std::string_view verb;
  Operand operand;
  std::string_view word;  // word, steps and error: literal text to match; other operands: description for messages
  EventKind kind;
  int argument;  // word and error: argument of the event; steps: sign of the argument; else unused
};

template <class Enum>
constexpr int code(Enum value) {
  return static_cast<int>(value);
}

constexpr std::array kForms{
    Form{"pb", Operand::integer, "1..20", EventKind::push_button, 0},
    Form{"tdc", Operand::pair, "X Y (-1..1)", EventKind::tdc, 0},
    Form{"tdc", Operand::word, "press", EventKind::tdc_press, 0},
    Form{"tdc", Operand::word, "release", EventKind::tdc_release, 0},
    Form{"cursor", Operand::pair, "RIGHT DOWN (0..1)", EventKind::cursor, 0},
    Form{"coolie", Operand::word, "up", EventKind::castle_up, 0},
    Form{"acq", Operand::word, "fwd", EventKind::acquisition, 1},
    Form{"acq", Operand::word, "aft", EventKind::acquisition, -1},
    Form{"freeze", Operand::none, "", EventKind::freeze, 0},
    Form{"elevation", Operand::number, "DEGREES (-60..60)", EventKind::elevation, 0},
    Form{"elevation", Operand::steps, "up", EventKind::elevation_step, 1},
    Form{"elevation", Operand::steps, "down", EventKind::elevation_step, -1},
    Form{"mode", Operand::word, "ag", EventKind::master_mode, code(radar::Master::air_to_ground)},
    Form{"mode", Operand::word, "aa", EventKind::master_mode, code(radar::Master::air_to_air)},
    Form{"mode", Operand::word, "agr", EventKind::master_mode, code(radar::Master::ranging)},
    Form{"radar", Operand::word, "rbm", EventKind::radar_mode, code(radar::Mode::rbm)},
    Form{"radar", Operand::word, "hrm", EventKind::radar_mode, code(radar::Mode::hrm)},
    Form{"radar", Operand::word, "bcn", EventKind::radar_mode, code(radar::Mode::beacon)},
    Form{"radar", Operand::word, "pvu", EventKind::radar_mode, code(radar::Mode::pvu)},
    Form{"power", Operand::word, "off", EventKind::power, code(radar::Power::off)},
    Form{"power", Operand::word, "stby", EventKind::power, code(radar::Power::standby)},
    Form{"power", Operand::word, "opr", EventKind::power, code(radar::Power::operate)},
    Form{"nav", Operand::word, "mn", EventKind::navigator, code(radar::Navigator::mission)},
    Form{"nav", Operand::word, "ins", EventKind::navigator, code(radar::Navigator::ins)},
    Form{"nav", Operand::word, "toggle", EventKind::navigator, -1},
    Form{"nav", Operand::error, "error mn", EventKind::navigator_error, code(radar::Navigator::mission)},
    Form{"nav", Operand::error, "error ins", EventKind::navigator_error, code(radar::Navigator::ins)},
    Form{"nav", Operand::error, "drift mn", EventKind::navigator_drift, code(radar::Navigator::mission)},
    Form{"nav", Operand::error, "drift ins", EventKind::navigator_drift, code(radar::Navigator::ins)},
    Form{"sp", Operand::name, "NAME (like 2, 2., 2.1, 2.01)", EventKind::sequence_point, 0},
    Form{"altimeter", Operand::word, "ok", EventKind::altimeter, 1},
    Form{"altimeter", Operand::word, "fail", EventKind::altimeter, 0},
    Form{"contrast", Operand::word, "up", EventKind::contrast, 1},
    Form{"contrast", Operand::word, "down", EventKind::contrast, -1},
    Form{"next", Operand::none, "", EventKind::next, 0},
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& character : lower) character = static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  return lower;
}

bool is_verb(std::string_view word) {
  return std::ranges::any_of(kForms, [word](const Form& form) { return form.verb == word; });
}

std::string text_of(const Form& form) {
  std::string text(form.verb);
  if (!form.word.empty()) text += ' ' + std::string(form.word);
  if (form.operand == Operand::steps) text += " [STEPS]";
  if (form.operand == Operand::error) text += form.kind == EventKind::navigator_error ? " N_FT E_FT" : " N_FPS E_FPS";
  return text;
}

std::vector<std::string> all_verbs() {
  std::vector<std::string> verbs;
  for (const Form& form : kForms)
    if (verbs.empty() || verbs.back() != form.verb) verbs.emplace_back(form.verb);
  return verbs;
}

// The forms of a verb; for an unknown verb, the list of all verbs.
std::string expected_forms(std::string_view verb) {
  std::string list;
  for (const Form& form : kForms)
    if (form.verb == verb) list += (list.empty() ? "" : " | ") + text_of(form);
  if (!list.empty()) return list;
  for (const std::string& known : all_verbs()) list += (list.empty() ? "" : ", ") + known;
  return "an event, which begins with one of " + list;
}

// Controls that have no event of their own, because push buttons of the display operate them.
// Source: docs/pilots_manual.md#buttons, real beam map.
struct OnButtons {
  std::string_view word;
  std::string_view buttons;
};
constexpr std::array kOnButtons{OnButtons{"range", "'pb 13' lengthens it, 'pb 14' shortens it"},
                                OnButtons{"gain", "'pb 3' steps it"},
                                OnButtons{"brightness", "'pb 4' raises it, 'pb 5' lowers it"},
                                OnButtons{"scan", "'pb 9' steps its width"},
                                OnButtons{"channel", "'pb 19' steps it"},
                                OnButtons{"band", "'pb 20' steps it"},
                                OnButtons{"sniff", "'pb 18' switches it"},
                                OnButtons{"declutter", "'pb 2' switches it"}};

// Advice for a word that is, or resembles, one of kOnButtons; empty: it resembles none.
std::string advice_on_buttons(std::string_view word) {
  std::vector<std::string> known;
  known.reserve(kOnButtons.size());
  for (const OnButtons& row : kOnButtons) known.emplace_back(row.word);
  constexpr std::size_t kShort = 4;  // words so short must match exactly: "rain" is not a misspelled "gain"
  const auto meant = text::nearest_word(word, known);
  if (!meant || (meant->size() <= kShort && *meant != word)) return {};
  const auto* row = std::ranges::find(kOnButtons, *meant, &OnButtons::word);
  return "the " + *meant + " is on buttons of the display: " + std::string(row->buttons) + " in RBM";
}

// Splits the first word where its letters end: "pb13" becomes "pb 13". False: there is nothing to split.
bool split_first(Words& words) {
  const auto letters = static_cast<std::size_t>(
      std::ranges::find_if(words[0], [](char c) { return std::isalpha(static_cast<unsigned char>(c)) == 0; }) -
      words[0].begin());
  if (letters == 0 || letters == words[0].size()) return false;
  const std::string_view first = words[0];
  const std::size_t next = first.find_first_not_of("-_:=", letters);
  if (next == std::string_view::npos) return false;
  // A minus sign belongs to the number, except in "pb-13".
  const bool is_signed = first[letters] == '-' && !first.starts_with("pb");
  words[0] = first.substr(0, letters);
  words.insert(words.begin() + 1, first.substr(is_signed ? letters : next));
  return true;
}

// Words that other programs and pilots use for an operand.
constexpr std::array<std::array<std::string_view, 3>, 8> kSynonyms{{{"power", "on", "opr"},
                                                                    {"power", "operate", "opr"},
                                                                    {"power", "standby", "stby"},
                                                                    {"acq", "up", "fwd"},
                                                                    {"acq", "forward", "fwd"},
                                                                    {"acq", "down", "aft"},
                                                                    {"acq", "back", "aft"},
                                                                    {"coolie", "forward", "up"}}};

// The event that a misspelled text most likely means, with verb and first operand corrected. nullopt: no verb is near.
std::optional<std::string> corrected(Words words) {
  if (words.empty()) return std::nullopt;
  if (!is_verb(words[0])) split_first(words);
  const auto verb = is_verb(words[0]) ? std::string(words[0]) : text::nearest_word(words[0], all_verbs());
  if (!verb) return std::nullopt;
  std::vector<std::string> operands;
  for (const Form& form : kForms)
    if (form.verb == *verb && (form.operand == Operand::word || form.operand == Operand::steps))
      operands.emplace_back(form.word);
  if (words.size() > 1) {
    for (const auto& [of, synonym, word] : kSynonyms)
      if (of == *verb && synonym == words[1]) words[1] = word;
  }
  std::string event = *verb;
  for (std::size_t i = 1; i < words.size(); ++i)
    event += ' ' + (i == 1 ? text::nearest_word(words[i], operands) : std::nullopt).value_or(std::string(words[i]));
  return event;
}

// Stores the argument. False if `value` is nullopt: the text was not a 16-bit integer.
bool put_argument(InputEvent& event, std::optional<std::int16_t> value) {
  if (value) event.argument = *value;
  return value.has_value();
}

bool put_steps(InputEvent& event, const Form& form, const Words& words) {
  if (words.size() < 2 || words.size() > 3 || words[1] != form.word) return false;
  const auto count = words.size() == 3 ? text::whole_number<std::int16_t>(words[2]) : std::int16_t{1};
  if (!count || *count < 1) return false;
  return put_argument(event, static_cast<std::int16_t>(*count * form.argument));
}

// Parses x from words[first], and y from the next word. Without a next word y is 0.
bool put_numbers(InputEvent& event, const Words& words, std::size_t first = 1) {
  const auto x = text::finite_number(words[first]);
  const auto y = words.size() > first + 1 ? text::finite_number(words[first + 1]) : 0.0;
  if (!x || !y) return false;
  event.x = *x;
  event.y = *y;
  return true;
}

// Parses "error mn 2500 0": quantity (error or drift), navigator, north, east.
bool put_error(InputEvent& event, const Form& form, const Words& words) {
  return words.size() == 5 && std::string(words[1]) + ' ' + std::string(words[2]) == form.word &&
         put_numbers(event, words, 3);
}

// Fills the event from the words; false if they do not match the form.
bool read_form(InputEvent& event, const Form& form, const Words& words) {
  event.kind = static_cast<std::uint16_t>(form.kind);
  event.argument = static_cast<std::int16_t>(form.argument);
  switch (form.operand) {
    case Operand::none:
      return words.size() == 1;
    case Operand::word:
      return words.size() == 2 && words[1] == form.word;
    case Operand::steps:
      return put_steps(event, form, words);
    case Operand::integer:
      return words.size() == 2 && put_argument(event, text::whole_number<std::int16_t>(words[1]));
    case Operand::number:
      return words.size() == 2 && put_numbers(event, words);
    case Operand::pair:
      return words.size() == 3 && put_numbers(event, words);
    case Operand::error:
      return put_error(event, form, words);
    case Operand::name:
      if (words.size() == 2) set_text(event, words[1]);
      return words.size() == 2;
  }
  return false;
}

// True if the event has this text form.
bool has_form(const Form& form, const InputEvent& event) {
  if (static_cast<std::uint16_t>(form.kind) != event.kind) return false;
  if (form.operand == Operand::word || form.operand == Operand::error) return event.argument == form.argument;
  if (form.operand == Operand::steps) return event.argument * form.argument > 0;
  return true;
}

std::string operand_text(const Form& form, const InputEvent& event) {
  const int steps = event.argument * form.argument;
  switch (form.operand) {
    case Operand::none:
      return {};
    case Operand::word:
      return ' ' + std::string(form.word);
    case Operand::steps:
      return ' ' + std::string(form.word) + (steps == 1 ? "" : ' ' + std::to_string(steps));
    case Operand::integer:
      return ' ' + std::to_string(event.argument);
    case Operand::number:
      return ' ' + text::text_of_number(event.x);
    case Operand::pair:
      return ' ' + text::text_of_number(event.x) + ' ' + text::text_of_number(event.y);
    case Operand::error:
      return ' ' + std::string(form.word) + ' ' + text::text_of_number(event.x) + ' ' + text::text_of_number(event.y);
    case Operand::name:
      return ' ' + std::string(event.text, std::find(event.text, event.text + sizeof event.text, '\0'));
  }
  return {};
}

}  // namespace

void set_text(InputEvent& event, std::string_view name) {
  name = name.substr(0, name.find('\0'));  // a zero byte ends the name; later bytes must not reach the record
  std::fill_n(event.text, sizeof event.text, '\0');
  std::copy_n(name.data(), std::min(name.size(), sizeof event.text), event.text);
}

namespace {

// The event that the words spell. Its numbers may be out of range.
std::optional<InputEvent> spelled(const Words& words) {
  for (const Form& form : kForms) {
    InputEvent event{};
    if (!words.empty() && form.verb == words[0] && read_form(event, form, words)) return event;
  }
  return std::nullopt;
}

// A parsed event is validated here, so that no consumer refuses it later.
std::optional<InputEvent> parsed(const Words& words) {
  auto event = spelled(words);
  return event && !validate(*event) ? event : std::nullopt;
}

// The event with its numbers moved into range; nullopt for kinds whose numbers are not clamped.
std::optional<InputEvent> in_range(InputEvent event) {
  switch (static_cast<EventKind>(event.kind)) {
    case EventKind::push_button:
      event.argument = std::clamp<std::int16_t>(event.argument, 1, radar::kBezelButtons);
      break;
    case EventKind::tdc:
      event.x = std::clamp(event.x, -1.0, 1.0);
      event.y = std::clamp(event.y, -1.0, 1.0);
      break;
    case EventKind::cursor:
      event.x = std::clamp(event.x, 0.0, 1.0);
      event.y = std::clamp(event.y, 0.0, 1.0);
      break;
    case EventKind::elevation:
      event.x = std::clamp(event.x, -kMaxElevation_deg, kMaxElevation_deg);
      break;
    case EventKind::elevation_step:
      event.argument = std::clamp<std::int16_t>(event.argument, -kMaxElevationSteps, kMaxElevationSteps);
      break;
    default:
      return std::nullopt;
  }
  return validate(event) ? std::nullopt : std::optional(event);
}

// Advice about words that are no event: "did you mean 'pb 13'?", or the buttons to press instead; may be empty.
std::string advice_on(const Words& words) {
  if (words.empty()) return {};
  if (std::string buttons = is_verb(words[0]) ? "" : advice_on_buttons(words[0]); !buttons.empty()) return buttons;
  const auto meant = corrected(words);
  if (!meant) return {};
  const Words correction = text::words_of(*meant);
  auto event = parsed(correction);
  if (const auto near = event ? event : spelled(correction); near && !event) event = in_range(*near);
  return event ? "did you mean '" + text_of(*event) + "'?" : std::string();
}

}  // namespace

std::string event_forms() {
  std::string lines;
  std::string_view verb;
  for (const Form& form : kForms) {
    if (!lines.empty()) lines += form.verb == verb ? " | " : "\n";
    lines += text_of(form);
    verb = form.verb;
  }
  return lines;
}

Expected<InputEvent> event_from_text(std::string_view text) {
  const std::string lower = lower_case(text);
  const Words words = text::words_of(lower);
  if (const auto event = parsed(words)) return *event;
  const std::string_view verb = words.empty() ? std::string_view() : words[0];
  const std::string advice = advice_on(words);
  // A correction of an unknown verb needs no list of verbs.
  return error::fail("event", advice.empty() || is_verb(verb) ? expected_forms(verb) : "an event",
                     '"' + std::string(text) + '"', advice);
}

std::string text_of(const InputEvent& event) {
  const auto form =
      std::ranges::find_if(kForms, [&event](const Form& candidate) { return has_form(candidate, event); });
  if (form == kForms.end())
    return "unknown event (kind " + std::to_string(event.kind) + ", argument " + std::to_string(event.argument) + ')';
  return std::string(form->verb) + operand_text(*form, event);
}

}  // namespace yars::databuffer
