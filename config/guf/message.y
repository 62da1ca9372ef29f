/* Grammar of the message syntax of 1996: [ name := ] keyword: value, values in braces. Tree: messages.hpp. */
%skeleton "lalr1.cc"
%require "3.8"
%language "c++"
%define api.namespace {yars::config}
%define api.parser.class {MessageParser}
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

#include "config/guf/messages.hpp"
}

%code {
/* The location of a construct is that of its first token. */
#define YYLLOC_DEFAULT(Current, Rhs, N) ((Current) = YYRHSLOC(Rhs, (N) ? 1 : 0))

namespace yars::config {
MessageParser::symbol_type next_word(void* scanner);
}
static yars::config::MessageParser::symbol_type yylex(void* scanner) { return yars::config::next_word(scanner); }
}

%token END 0
%token OPEN CLOSE COMMA INCLUDE
%token <double> NUMBER
%token <bool> BOOLEAN
%token <std::string> STRING IDENTIFIER KEYWORD INSTANCE
%token <yars::config::Form> COORDINATE

%nterm <std::vector<Slot>> arguments
%nterm <Slot> message
%nterm <Value> value

%start text
%%

text: arguments                         { state.result.arguments = $1; }
    ;

arguments: %empty                       { }
    | arguments value                   { $$ = $1; $$.push_back(Slot{"", 0, @2, $2}); }
    | arguments message                 { $$ = $1; $$.push_back($2); }
    | arguments INSTANCE message        {
        $$ = $1;
        $$.push_back(Slot{kInstance, 0, @2, Value{@2, Identifier{$2}}});
        $$.push_back($3);
      }
    | arguments INCLUDE STRING          { $$ = $1; $$.push_back(include_slot(@2, $3)); }
    | arguments COMMA                   { $$ = $1; }
    ;

message: KEYWORD value                  { $$ = Slot{$1, 0, @1, $2}; }
    ;

value: NUMBER                           { $$ = Value{@1, $1}; }
    | BOOLEAN                           { $$ = Value{@1, $1}; }
    | STRING                            { $$ = Value{@1, $1}; }
    | IDENTIFIER                        { $$ = Value{@1, Identifier{$1}}; }
    | COORDINATE                        { $$ = Value{@1, $1}; }
    | OPEN arguments CLOSE              { $$ = Value{@1, Form{kBraces, $2}}; }
    ;

%%

namespace yars::config {
namespace {

/* What the grammar allows here, in terms of the language instead of token names. */
std::string allowed_here(const MessageParser::context& context) {
  constexpr int kMaxKinds = MessageParser::YYNTOKENS;
  MessageParser::symbol_kind_type kinds[kMaxKinds];
  const int count = context.expected_tokens(kinds, kMaxKinds);
  const auto allows = [&](MessageParser::symbol_kind_type kind) {
    for (int i = 0; i < count; ++i) {
      if (kinds[i] == kind) return true;
    }
    return false;
  };
  using Kind = MessageParser::symbol_kind;
  const bool value = allows(Kind::S_NUMBER);
  if (value && !allows(Kind::S_KEYWORD)) return "a value for the keyword";
  if (allows(Kind::S_CLOSE)) return "a message, a value or }";
  if (value) return "a message, as Radar: { ... }, or the end of the file";
  if (allows(Kind::S_KEYWORD)) return "a keyword with its colon after :=";
  return "the name of a file in quotes after #include";
}

}  // namespace

void MessageParser::report_syntax_error(const context& found) const {
  const bool at_end = found.token() == symbol_kind::S_YYEOF;
  reject(found.location(), allowed_here(found), at_end ? std::string("the end of the file") : state.spelled);
}

void MessageParser::error(const Location& where, const std::string& message) {
  reject(where, "text that the parser can hold", message, "split the file");
}

}  // namespace yars::config
