// Reader: writes the values of a configuration's syntax tree into a ConfigurationBuilder, by the table of schema.hpp.
// Inputs: the top-level arguments of the text, which must be forms.
// Outputs: the builder; warnings for old spellings, unknown forms and slots, unused slots (validated, no effect), and
// lists that do not fit together (slot_value.hpp); notes about lists of forms that a later list replaces.
// Errors: ParseError with the location of the value.
// Order: forms are read in the order of the text. A slot's value in a later form replaces its value in an earlier form.
// A second value of a slot in one form is an error. The forms Devices, Materials and MgDbase, and slots such as
// moreCells, add to what earlier forms gave.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"
#include "config/schema/slot_value.hpp"

namespace yars::config {

// Meaning of the name of a form.
struct KnownForm {
  const FormSchema* schema = nullptr;    // null: unknown, or defined in the text without a built-in base
  std::vector<std::string> added_slots;  // slots that a def-form adds after those of the schema; without effect
  Spelling spelling = Spelling::exact;
  bool defined_in_text = false;
};

// Forms that a text can use: the forms of the schema, and the forms that the text defines with def-form.
class FormDefinitions {
 public:
  // Adds the form that ( def-form name is= base 'slot ... ) defines. A built-in form of this name prevails. Throws
  // ParseError.
  void define(const Form& form, const Location& where);
  // Meaning of a form's name. For an unknown name `schema` is null and `defined_in_text` is false.
  KnownForm find(const std::string& name) const;

 private:
  struct Definition {
    std::string name;
    KnownForm meaning;
  };
  std::vector<Definition> definitions_;
};

// Reads all arguments of one configuration. Throws ParseError.
class FormReader {
 public:
  FormReader(ConfigurationBuilder& builder, std::vector<std::string>& warnings)
      : builder_(builder), warnings_(warnings) {}
  void read_all(const std::vector<Slot>& arguments);
  // Remarks on valid text that may be a mistake: "FILE:LINE:COLUMN: note: TEXT".
  const std::vector<std::string>& notes() const { return notes_; }
  // Unknown forms and slots, which are among the warnings.
  const std::vector<Fault>& unknown() const { return unknown_; }

 private:
  // A slot of a form in the text, with the row of the schema for this slot.
  struct MatchedSlot {
    const SlotSchema* schema;
    const Slot* slot;
  };
  // Rule between forms (FormSchema::check_at_end), and the location of the last form whose schema has this rule.
  struct DeferredCheck {
    std::optional<ConstraintViolation> (*check)(const ConfigurationBuilder&);
    Location where;
  };
  void read_top_level(const Form& form, const Location& where);
  void read_form(const Form& form, const Location& where, const KnownForm& known);
  void defer_check(const FormSchema& schema, const Location& where);
  std::vector<MatchedSlot> match_slots(const Form& form, const KnownForm& known);
  const SlotSchema* row_of(const Slot& slot, int index, const Form& form, const KnownForm& known);
  void read_slot(const SlotSchema& schema, const Value& value, const std::string& form);
  void read_forms(const SlotSchema& schema, const FormSlot& kind, const Value& value, const std::string& form);
  void read_items(const SlotSchema& schema, const FormSlot& kind, const Value& value);
  void read_form_of_slot(const SlotSchema& schema, const FormSlot& kind, const Value& value, bool in_list);
  void warn_unread(const Slot& slot, const Form& form, const KnownForm& known);
  void warn(const Location& where, const std::string& text);
  void warn_unknown(Fault fault);
  void warn_unknown_form(const Location& where, const std::string& name);
  void warn_spelling(const Location& where, const std::string& found, std::string_view modern, Spelling spelling);

  ConfigurationBuilder& builder_;
  std::vector<std::string>& warnings_;
  FormDefinitions forms_;
  std::vector<DeferredCheck> deferred_checks_;
  PairedLists paired_lists_;
  std::vector<std::string> notes_;
  std::vector<Fault> unknown_;
  bool unused_ = false;  // true inside an unused slot: unused slots of the forms in it cause no further warnings
};

}  // namespace yars::config
