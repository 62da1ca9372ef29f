// Forms of a text: those of the schema and those it defines, read into the configuration.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/guf/tree.hpp"
#include "config/schema/schema.hpp"

namespace yars::config {

// What the name of a form stands for.
struct KnownForm {
  const FormSchema* schema = nullptr;  // null: defined in the text, and based on nothing that YARS knows
  std::vector<std::string> own_slots;  // slots that a def-form adds behind those of the schema; nobody reads them
  Spelling spelling = Spelling::exact;
  bool defined_in_text = false;
};

// The forms that a text may use: those of the schema, and those it defines itself with def-form.
class FormBook {
 public:
  // ( def-form name is= base 'slot ... ). Throws ParseError; a definition of a form that is built in changes nothing.
  void define(const Form& form, const Location& where);
  // A form without schema and not defined in the text is unknown.
  KnownForm look_up(const std::string& name) const;

 private:
  struct Definition {
    std::string name;
    KnownForm meaning;
  };
  std::vector<Definition> definitions_;
};

// The tree of a configuration into a draft, by the schema. Reads forms in the order of the text; what comes later wins.
// Throws ParseError.
class FormReader {
 public:
  FormReader(ConfigurationBuilder& draft, std::vector<std::string>& warnings) : draft_(draft), warnings_(warnings) {}
  void read_all(const std::vector<Slot>& arguments);

 private:
  // The slots of one form with the rows they belong to, ready to be read.
  struct Assigned {
    const SlotSchema* schema;
    const Slot* slot;
  };
  // A rule between forms, and the last form that has it.
  struct Agreement {
    std::optional<ConstraintViolation> (*broken)(const ConfigurationBuilder&);
    Location where;
  };
  void read_outermost(const Form& form, const Location& where);
  void read_form(const Form& form, const Location& where, const KnownForm& known);
  void note_agreement(const FormSchema& schema, const Location& where);
  std::vector<Assigned> assign(const Form& form, const KnownForm& known);
  const SlotSchema* row_of(const Slot& slot, int place, const Form& form, const KnownForm& known);
  void read_slot(const SlotSchema& schema, const Value& value, const std::string& form);
  void read_forms(const SlotSchema& schema, const FormSlot& kind, const Value& value);
  void read_form_of_slot(const SlotSchema& schema, const FormSlot& kind, const Value& value, bool in_list);
  void warn_unread(const Slot& slot, const Form& form, const KnownForm& known);
  void warn(const Location& where, const std::string& text);
  void warn_spelling(const Location& where, const std::string& found, std::string_view modern, Spelling spelling);

  ConfigurationBuilder& draft_;
  std::vector<std::string>& warnings_;
  FormBook book_;
  std::vector<Agreement> agreements_;
  bool unused_ = false;  // inside a form that nobody uses: its slots need no word of their own
};

}  // namespace yars::config
