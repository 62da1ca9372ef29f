// The user's file of defaults, yars.conf: values of options that hold without the option.
// Inputs: a text with one `NAME = VALUE` a line; `#` begins a comment. The file is $YARS_USER_CONFIG, else
// $XDG_CONFIG_HOME/yars/yars.conf, else ~/.config/yars/yars.conf. An empty YARS_USER_CONFIG means no file.
// Outputs: the values by the long name of their option, with ~/ replaced by the home folder.
// Errors: an unknown name, a name given twice, no value, a path that depends on the current folder; with file and line.
// A file that does not exist is none, unless YARS_USER_CONFIG names it.
// Source: docs/commands.md#user-file.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "lib/error/error.hpp"

namespace yars::runtime {

struct UserDefault {
  std::string value;
  int line = 0;
};

struct UserDefaults {
  std::string file;                           // empty: there is none
  std::map<std::string, UserDefault> values;  // by long name: "log-dir"
};

// `file`: name for errors. `home`: folder that ~/ stands for.
error::Expected<UserDefaults> parse_user_defaults(std::string_view text, const std::string& file,
                                                  const std::string& home);

// Path of the user's file as the environment gives it; empty: none.
std::string user_defaults_path();

// Reads the user's file.
error::Expected<UserDefaults> read_user_defaults();

}  // namespace yars::runtime
