#include "tools/command/json_output.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace yars::tools {

runtime::Option add_json_flag(runtime::Command command, bool& json, const std::string& help) {
  return command.flag("--json", json, help);
}

void print_json(const nlohmann::ordered_json& object, JsonLines lines) {
  const int indent = lines == JsonLines::one ? -1 : 2;
  std::printf("%s\n", object.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

}  // namespace yars::tools
