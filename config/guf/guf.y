/* Grammar of GUF: forms, slots, lists. The grammar builds the tree of config/guf/parser.hpp. */
%skeleton "lalr1.cc"
%require "3.8"
%language "c++"
%define api.namespace {yars::config}
%define api.parser.class {GufParser}
%define api.token.prefix {TOKEN_}
%define api.token.constructor
%define api.value.type variant
%define api.value.automove
%define api.location.type {yars::config::Location}
%define parse.error custom
%define parse.lac full
%locations
%param { void* scanner }
%parse-param { yars::config::ScanState& state }

%code requires {
#include <string>
#include <vector>

#include "config/guf/parser.hpp"
}

%code {
/* The location of a construct is that of its first token. */
#define YYLLOC_DEFAULT(Current, Rhs, N) ((Current) = YYRHSLOC(Rhs, (N) ? 1 : 0))

namespace yars::config {
GufParser::symbol_type next_token(void* scanner);
}
static yars::config::GufParser::symbol_type yylex(void* scanner) { return yars::config::next_token(scanner); }
}

%token END 0
%token OPEN CLOSE OPEN_BRACE CLOSE_BRACE COMMA QUOTE IS
%token <double> NUMBER
%token <bool> BOOLEAN
%token <std::string> STRING IDENTIFIER SLOT OLD_SLOT
%token <int> POSITION

%nterm <std::vector<Slot>> arguments
%nterm <Slot> argument
%nterm <Value> value

%start text
%%

text: arguments                         { state.result.arguments = $1; }
    ;

arguments: %empty                       { }
    | arguments argument                { $$ = $1; $$.push_back($2); }
    | arguments COMMA                   { $$ = $1; state.warn_comma(@2); }
    ;

argument: value                         { $$ = Slot{"", 0, @1, $1}; }
    | SLOT value                        { $$ = Slot{$1, 0, @1, $2}; }
    | POSITION value                    { $$ = Slot{"", $1, @1, $2}; }
    | OLD_SLOT value                    {
        std::string name = $1;
        state.warn_old_spelling(@1, name + ":", ":" + name);
        $$ = Slot{std::move(name), 0, @1, $2};
      }
    | IS IDENTIFIER                     { $$ = Slot{"is=", 0, @1, Value{@2, Identifier{$2}}}; }
    ;

value: NUMBER                           { $$ = Value{@1, $1}; }
    | BOOLEAN                           { $$ = Value{@1, $1}; }
    | STRING                            { $$ = Value{@1, $1}; }
    | IDENTIFIER                        { $$ = Value{@1, Identifier{$1}}; }
    | QUOTE IDENTIFIER                  { $$ = Value{@1, Identifier{$2}}; }
    | QUOTE OPEN arguments CLOSE        { $$ = list_value(@1, $3); }
    | OPEN IDENTIFIER arguments CLOSE   { $$ = form_value(@1, $2, $3); }
    | OPEN_BRACE arguments CLOSE_BRACE  { $$ = list_value(@1, $2); warn_braces(state, $$); }
    ;

%%

namespace yars::config {
namespace {

constexpr const char* kFormName = "a name";

/* What the grammar allows here, in terms of the language instead of token names. */
std::string allowed_here(const GufParser::context& context) {
  constexpr int kMaxKinds = GufParser::YYNTOKENS;
  GufParser::symbol_kind_type kinds[kMaxKinds];
  const int count = context.expected_tokens(kinds, kMaxKinds);
  const auto allows = [&](GufParser::symbol_kind_type kind) {
    for (int i = 0; i < count; ++i) {
      if (kinds[i] == kind) return true;
    }
    return false;
  };
  using Kind = GufParser::symbol_kind;
  const bool value = allows(Kind::S_NUMBER);
  if (value && !allows(Kind::S_SLOT)) return "a value for the slot";
  if (allows(Kind::S_CLOSE) && value) return "a value, a slot or )";
  if (allows(Kind::S_CLOSE_BRACE) && value) return "a value or }";
  if (value) return "a form, a value, a slot or the end of the file";
  if (allows(Kind::S_OPEN)) return "( or an identifier after the quote";
  return kFormName;
}

}  // namespace

void GufParser::report_syntax_error(const context& found) const {
  const bool at_end = found.token() == symbol_kind::S_YYEOF;
  const std::string allowed = allowed_here(found);
  reject(found.location(), allowed, at_end ? std::string("the end of the file") : state.spelled,
         allowed == kFormName && !at_end ? "a form is ( name ... ), a list is `( ... )" : "");
}

void GufParser::error(const Location& where, const std::string& message) {
  reject(where, "text that the parser can hold", message, "split the file");
}

}  // namespace yars::config
