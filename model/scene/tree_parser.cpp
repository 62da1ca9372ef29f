#include "model/scene/tree_parser.hpp"

#include <algorithm>

#include "model/scene/openflight_format.hpp"
#include "model/scene/openflight_header.hpp"
#include "model/scene/openflight_parser.hpp"

namespace yars::model::scene {

using namespace openflight;

failure::Expected<NodeTree> TreeParser::parse() {
  const auto header = parse_header(bytes_, subject_);
  if (!header) return tl::unexpected(header.error());
  tree_.header = *header;
  surfaces_.set_revision(header->revision);
  tree_.nodes.emplace_back();
  current_.node = 0;
  for (;;) {
    const auto record = stream_.next();
    if (!record) return tl::unexpected(record.error());
    if (!*record) break;
    if (const auto done = take(**record); !done) return tl::unexpected(done.error());
  }
  if (!levels_.empty())
    tree_.warnings.emplace_back("the file ends inside " + std::to_string(levels_.size()) + " open levels");
  if (surfaces_.foreign_codes() > 0)
    tree_.warnings.emplace_back("faces with a surface material code beyond 31: " +
                                std::to_string(surfaces_.foreign_codes()) + "; they count as without one");
  tree_.counts.materials = surfaces_.colors().materials();
  tree_.counts.hidden_faces = surfaces_.hidden_faces();
  tree_.kinds = surfaces_.kinds();
  return std::move(tree_);
}

TreeParser::Done TreeParser::take(const Record& record) {
  if (const int step = nesting_of_skipped(record.opcode()); step != 0 || skipped_ > 0) {
    skipped_ = std::max(0, skipped_ + step);
    return {};
  }
  switch (record.opcode()) {
    case kPushLevel:
      return push();
    case kPopLevel:
      return pop();
    case kPushSubface:
      ++subface_level_;
      return push();
    case kPopSubface:
      subface_level_ = std::max(0, subface_level_ - 1);
      return pop();
    case kColorPalette:
      surfaces_.colors().read_colors(record, tree_.header.revision);
      return {};
    case kMaterial:
      surfaces_.colors().read_material(record);
      return {};
    case kFace:
      return add_face(record);
    case kMesh:
      return add_mesh(record);
    case kLocalVertexPool:
      return add_pool(record);
    case kMeshPrimitive:
      return add_primitive(record);
    case kVertexPalette:
      palette_.begin(record);
      return {};
    case kVertexColor:
    case kVertexColorNormal:
    case kVertexColorNormalTexture:
    case kVertexColorTexture:
      return add_vertex(record);
    case kVertexList:
      return add_corners(record);
    case kMatrix:
      return add_matrix(record);
    case kReplicate:
      return add_replication(record);
    case kLongId:
      name_it(record);
      return {};
    default:
      return add_node(record);
  }
}

// +1 and -1 around records that nobody here reads, else 0.
int TreeParser::nesting_of_skipped(std::uint16_t opcode) {
  if (opcode == kPushExtension || opcode == kPushAttribute) return 1;
  return opcode == kPopExtension || opcode == kPopAttribute ? -1 : 0;
}

tl::unexpected<failure::Error> TreeParser::too_many(std::size_t most, const std::string& what) {
  return failure::fail(subject_, "at most " + std::to_string(most) + " " + what, "more", "split the file");
}

TreeParser::Done TreeParser::push() {
  if (levels_.size() >= kDeepestPush) return too_many(kDeepestPush, "levels of records");
  levels_.push_back(current_);
  return {};
}

TreeParser::Done TreeParser::pop() {
  if (levels_.empty())
    return failure::fail(subject_, "as many pop records as push records", "one pop more",
                         "the file is damaged; fetch it again");
  current_ = levels_.back();
  levels_.pop_back();
  return {};
}

}  // namespace yars::model::scene
