#include "model/scene/openflight_parser.hpp"

#include "model/scene/tree_parser.hpp"

namespace yars::model::scene {

failure::Expected<NodeTree> parse_openflight(std::span<const std::byte> bytes, const std::string& subject) {
  return TreeParser(bytes, subject).parse();
}

}  // namespace yars::model::scene
