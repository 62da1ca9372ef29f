// Option --json of the commands that print facts, and the output of one JSON object.
// Inputs: a command; an object. Outputs: the object on standard output. Text that is not valid UTF-8, as in a file
// name, is replaced.
// Source of the fields: docs/commands.md#json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/command_line.hpp"

namespace yars::tools {

enum class JsonLines { one, many };

// Adds --json: prints one JSON object in place of text.
runtime::Option add_json_flag(runtime::Command command, bool& json,
                              const std::string& help = "print one JSON object in place of text");

// Prints the object and a line feed. JsonLines::many: indented, for people.
void print_json(const nlohmann::ordered_json& object, JsonLines lines = JsonLines::one);

}  // namespace yars::tools
