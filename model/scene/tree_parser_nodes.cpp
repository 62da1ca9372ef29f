// Groups, objects, switches and what moves them.
#include <array>
#include <cmath>

#include "model/scene/openflight_format.hpp"
#include "model/scene/openflight_parser.hpp"
#include "model/scene/tree_parser.hpp"

namespace yars::model::scene {

using namespace openflight;

TreeParser::Done TreeParser::new_node(NodeKind kind, bool attached) {
  if (tree_.nodes.size() >= kMostNodes) return too_many(kMostNodes, "nodes");
  const auto number = static_cast<std::uint32_t>(tree_.nodes.size());
  tree_.nodes.emplace_back().kind = kind;
  if (attached && parent().node != kNone) link_child(parent().node, number);
  current_ = {.node = number};
  return {};
}

void TreeParser::link_child(std::uint32_t parent, std::uint32_t child) {
  Node& above = tree_.nodes[parent];
  if (above.first_child == kNone)
    above.first_child = child;
  else
    tree_.nodes[above.last_child].next_sibling = child;
  above.last_child = child;
}

TreeParser::Done TreeParser::add_node(const Record& record) {
  switch (record.opcode()) {
    case kGroup:
      return add_group(record);
    case kObject:
      ++tree_.counts.objects;
      return add_named(record, NodeKind::object);
    case kLevelOfDetail:
      return add_level_of_detail(record);
    case kSwitch:
      return add_switch(record);
    case kInstanceDefinition:
      return add_definition(record);
    case kInstanceReference:
      ++tree_.counts.instances;
      return new_node(NodeKind::instance).map([&] {
        tree_.nodes.back().instance = record.number_or<std::uint16_t>(6, 0);
      });
    case kExternalReference:
      ++tree_.counts.external_references;
      return new_node(NodeKind::external).map([&] { tree_.nodes.back().name = record.text(4, 200); });
    case kDegreeOfFreedom:
    case kBinarySeparatingPlane:
    case kRoadSegment:
    case kClipRegion:
    case kExtension:
    case kContinuouslyAdaptive:
    case kRoadConstruction:
      return add_named(record, NodeKind::group);
    case kSound:
    case kPath:
    case kText:
    case kLightSource:
    case kLightPoint:
    case kCurve:
    case kIndexedLightPoint:
    case kLightPointSystem:
      return new_node(NodeKind::ignored);
    default:
      return {};
  }
}

TreeParser::Done TreeParser::add_named(const Record& record, NodeKind kind) {
  return new_node(kind).map([&] { tree_.nodes.back().name = record.text(kNameAt, kNameBytes); });
}

TreeParser::Done TreeParser::add_group(const Record& record) {
  constexpr std::uint32_t kForward = 1U << 30, kSwing = 1U << 29, kBackward = 1U << 26;
  constexpr std::int32_t kBackwardRevision = 1580;  // the bit meant nothing before; a swing alone was an animation
  const auto flags = record.number_or<std::uint32_t>(16, 0);
  const std::uint32_t animation = kForward | (tree_.header.revision >= kBackwardRevision ? kBackward : kSwing);
  return add_named(record, NodeKind::group).map([&] {
    tree_.nodes.back().first_child_only = (flags & animation) != 0;
  });
}

TreeParser::Done TreeParser::add_level_of_detail(const Record& record) {
  ++tree_.counts.levels_of_detail;
  return add_named(record, NodeKind::level_of_detail).map([&] {
    const double switch_out = record.number_or<double>(24, 0.0);
    tree_.nodes.back().switch_out_m = std::isfinite(switch_out) ? switch_out * tree_.header.metres_per_unit : 0.0;
  });
}

TreeParser::Done TreeParser::add_switch(const Record& record) {
  constexpr std::size_t kCurrentAt = 16, kMasksAt = 20, kWordsAt = 24, kFirstWordAt = 28;
  return add_named(record, NodeKind::choice).map([&] {
    const std::size_t current = record.number_or<std::uint32_t>(kCurrentAt, 0);
    const std::size_t words = record.number_or<std::uint32_t>(kWordsAt, 0);
    if (current >= record.number_or<std::uint32_t>(kMasksAt, 0)) return;
    for (std::size_t word = 0; word < words; ++word) {
      const auto mask = record.number<std::uint32_t>(kFirstWordAt + 4 * (current * words + word));
      if (!mask) break;
      tree_.nodes.back().choice_mask.push_back(*mask);
    }
  });
}

TreeParser::Done TreeParser::add_definition(const Record& record) {
  return new_node(NodeKind::group, false).map([&] {
    tree_.definitions[record.number_or<std::uint16_t>(6, 0)] = current_.node;
  });
}

void TreeParser::name_it(const Record& record) {
  constexpr std::size_t kLongestName = 128;
  if (current_.node == kNone || current_.face != kNone || current_.mesh >= 0) return;
  Node& node = tree_.nodes[current_.node];
  if (node.kind != NodeKind::external) node.name = record.text(4, kLongestName);
}

// A face that is moved becomes the content of a node of its own. Records that follow a face at once can do that;
// later the list of its siblings has gone on, and it stays where it is.
TreeParser::Done TreeParser::own_node() {
  const std::uint32_t face = current_.face;
  const std::uint32_t above = parent().node;
  if (tree_.faces.size() != std::size_t{face} + 1 || above == kNone) return {};
  if (auto made = new_node(NodeKind::group); !made) return made;
  Node& before = tree_.nodes[above];
  before.last_face = face_before_;
  if (face_before_ == kNone)
    before.first_face = kNone;
  else
    tree_.faces[face_before_].next = kNone;
  tree_.nodes.back().first_face = tree_.nodes.back().last_face = face;
  current_.face = face;
  return {};
}

TreeParser::Done TreeParser::add_matrix(const Record& record) {
  constexpr std::size_t kNumbers = 16;
  std::array<double, kNumbers> m{};
  for (std::size_t i = 0; i < kNumbers; ++i) {
    m[i] = static_cast<double>(record.number_or<float>(4 + 4 * i, i % 5 == 0 ? 1.0F : 0.0F));
    if (!std::isfinite(m[i]))
      return failure::fail(subject_, "a matrix of finite numbers", "NaN or infinity", "the file is damaged");
  }
  if (is_loose_face())
    if (auto done = own_node(); !done) return done;
  if (current_.node == kNone || is_loose_face()) return {};
  const Affine matrix{{m[0], m[1], m[2]},
                      {m[4], m[5], m[6]},
                      {m[8], m[9], m[10]},
                      tree_.header.metres_per_unit * Vector3{m[12], m[13], m[14]}};
  if (tree_.nodes[current_.node].matrix == kNone) {
    tree_.nodes[current_.node].matrix = static_cast<std::uint32_t>(tree_.matrices.size());
    tree_.matrices.push_back(matrix);
  } else {
    tree_.matrices[tree_.nodes[current_.node].matrix] = matrix;
  }
  return {};
}

TreeParser::Done TreeParser::add_replication(const Record& record) {
  const int copies = record.number_or<std::int16_t>(4, 0);
  if (copies <= 0) return {};
  if (is_loose_face())
    if (auto done = own_node(); !done) return done;
  if (current_.node != kNone && !is_loose_face())
    tree_.nodes[current_.node].replications = static_cast<std::uint16_t>(copies);
  return {};
}

}  // namespace yars::model::scene
