#include "config/load.hpp"

#include "config/form_reader.hpp"
#include "config/read_tree.hpp"
#include "config/rejection.hpp"

namespace yars::config {
namespace {

failure::Expected<LoadedConfiguration> configuration_from(ParsedText tree) {
  LoadedConfiguration loaded;
  loaded.warnings = std::move(tree.warnings);
  Draft draft;
  try {
    FormReader(draft, loaded.warnings).read_all(tree.arguments);
  } catch (const Rejection& rejection) {
    return tl::unexpected(rejection.error);
  }
  loaded.radar = std::move(draft.radar);
  return loaded;
}

}  // namespace

failure::Expected<LoadedConfiguration> load_configuration(const std::filesystem::path& path) {
  if (path.empty()) return LoadedConfiguration{};
  return read_tree(path).and_then(configuration_from);
}

failure::Expected<LoadedConfiguration> load_configuration_text(std::string_view text, const std::string& name) {
  return tree_of_text(text, name).and_then(configuration_from);
}

}  // namespace yars::config
