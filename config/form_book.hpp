// The forms that a text may use: those of the schema, and those it defines itself with def-form.
#pragma once

#include <string>
#include <vector>

#include "config/schema.hpp"
#include "config/value.hpp"

namespace yars::config {

// What the name of a form stands for.
struct KnownForm {
  const FormSchema* schema = nullptr;  // null: defined in the text, and based on nothing that YARS knows
  std::vector<std::string> own_slots;  // slots that a def-form adds behind those of the schema; nobody reads them
  Spelling spelling = Spelling::exact;
  bool defined_in_text = false;
};

class FormBook {
 public:
  // ( def-form name is= base 'slot ... ). Throws Rejection; a definition of a form that is built in changes nothing.
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

}  // namespace yars::config
