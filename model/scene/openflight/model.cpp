#include "model/scene/openflight/model.hpp"

#include <algorithm>
#include <cmath>

#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"
#include "model/scene/openflight/node_tree.hpp"

namespace yars::model::scene {

namespace {

struct ProjectedPoint {
  double u = 0.0, v = 0.0;
};

// Twice the signed area of the triangle (a, b, c); positive for a left turn at b.
double turn(ProjectedPoint a, ProjectedPoint b, ProjectedPoint c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// Projects corners along the coordinate axis with the largest component of the normal. Orientation is kept.
std::vector<ProjectedPoint> projected(std::span<const Vector3> corners, Vector3 normal) {
  std::vector<ProjectedPoint> projection;
  projection.reserve(corners.size());
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  for (const Vector3& corner : corners) {
    if (z >= x && z >= y)
      projection.push_back(normal.z > 0 ? ProjectedPoint{corner.x, corner.y} : ProjectedPoint{corner.y, corner.x});
    else if (x >= y)
      projection.push_back(normal.x > 0 ? ProjectedPoint{corner.y, corner.z} : ProjectedPoint{corner.z, corner.y});
    else
      projection.push_back(normal.y > 0 ? ProjectedPoint{corner.z, corner.x} : ProjectedPoint{corner.x, corner.z});
  }
  return projection;
}

// True for a polygon that turns right at no corner and goes around once. A pentagram goes around twice. In each
// circuit, the change of u along the edges changes its sign twice.
bool is_convex(const std::vector<ProjectedPoint>& projection) {
  const std::size_t n = projection.size();
  double previous = 0.0;  // change of u along the previous edge on which u changes
  for (std::size_t i = 0; i < n; ++i)
    if (const double growth = projection[(i + 1) % n].u - projection[i].u; growth != 0.0) previous = growth;
  int reversals = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const ProjectedPoint a = projection[i], b = projection[(i + 1) % n];
    if (turn(a, b, projection[(i + 2) % n]) < 0.0) return false;
    if (b.u == a.u) continue;
    reversals += (b.u > a.u) != (previous > 0.0) ? 1 : 0;
    previous = b.u - a.u;
  }
  return reversals <= 2;
}

bool inside(ProjectedPoint p, ProjectedPoint a, ProjectedPoint b, ProjectedPoint c) {
  return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

bool same(ProjectedPoint a, ProjectedPoint b) {
  return a.u == b.u && a.v == b.v;
}

// True if the corner at `at` is an ear: the polygon turns left there, and the triangle of this corner and its two
// neighbours contains no other corner.
bool is_ear(const std::vector<ProjectedPoint>& projection, const std::vector<std::uint32_t>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const ProjectedPoint a = projection[ring[(at + n - 1) % n]], b = projection[ring[at]],
                       c = projection[ring[(at + 1) % n]];
  if (turn(a, b, c) <= 0.0) return false;
  for (const std::uint32_t other : ring) {
    const ProjectedPoint p = projection[other];
    if (same(p, a) || same(p, b) || same(p, c)) continue;
    if (inside(p, a, b, c)) return false;
  }
  return true;
}

void clip_ears(const std::vector<ProjectedPoint>& projection, std::vector<std::array<std::uint32_t, 3>>& found) {
  std::vector<std::uint32_t> ring(projection.size());
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<std::uint32_t>(i);
  std::size_t at = 0;
  std::size_t not_ears = 0;  // consecutive corners that are not ears
  // A polygon that crosses itself can give triangles that turn right. They face the other side and are left out.
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (turn(projection[a], projection[b], projection[c]) >= 0.0) found.push_back({a, b, c});
  };
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    at %= n;
    // A polygon without ears crosses itself or is degenerate. Its current corner is cut off as if it were an ear.
    if (not_ears < n && !is_ear(projection, ring, at)) {
      ++not_ears;
      ++at;
      continue;
    }
    add(ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    at = at == 0 ? 0 : at - 1;
    not_ears = 0;
  }
  add(ring[0], ring[1], ring[2]);
}

}  // namespace

Vector3 newell_normal(std::span<const Vector3> corners) {
  // Corners are taken relative to the first corner, which avoids cancellation far from the origin.
  Vector3 sum;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum = sum + cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

void triangulate(std::span<const Vector3> corners, std::vector<std::array<std::uint32_t, 3>>& found) {
  found.clear();
  // Ear clipping takes at least quadratic time. A concave polygon with more corners than this limit counts as damaged
  // and becomes a fan.
  constexpr std::size_t kMaxEarClippingCorners = 512;
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    found.push_back({0, 1, 2});
    return;
  }
  const Vector3 normal = newell_normal(corners);
  if (dot(normal, normal) == 0.0) return;
  const std::vector<ProjectedPoint> projection = projected(corners, normal);
  if (corners.size() > kMaxEarClippingCorners || is_convex(projection)) {
    for (std::uint32_t i = 2; i < corners.size(); ++i) found.push_back({0, i - 1, i});
    return;
  }
  clip_ears(projection, found);
}

namespace {

constexpr double kMaxCoordinate_m = 1e7;  // limit of |x|, |y|, |z|; a polygon with a corner beyond it counts as damaged
// [m] If |x| or |y| of the first vertex exceeds this, Model::base is set. Coordinates are stored as float, with a
// resolution of 4 mm at 50 km and 8 mm at 100 km.
constexpr double kFarOrigin_m = 50'000;
// [m^2] Lower limit of twice the area. A polygon or triangle below it has no reliable normal and is left out.
constexpr double kMinDoubleArea_m2 = 1e-10;

std::array<float, 3> floats(Vector3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
bool is_valid_position(Vector3 position) {
  return std::abs(position.x) < kMaxCoordinate_m && std::abs(position.y) < kMaxCoordinate_m &&
         std::abs(position.z) < kMaxCoordinate_m;
}

class Flattener {
 public:
  Flattener(const NodeTree& tree, std::string subject, const LoadExternal& load, FlattenOptions options)
      : tree_(tree),
        subject_(std::move(subject)),
        load_(load),
        limits_(options.limits),
        filter_(options.filter),
        first_node_(options.first_node),
        remarks_(tree.remarks) {
    model_.header = tree.header;
    model_.counts = tree.counts;
    model_.objects.emplace_back();
    for (const SurfaceKind& kind : tree.kinds) kind_numbers_.push_back(kinds_.number_of(kind));
    if (first_node_ != 0) return;
    // As many as without copies and two-sided faces.
    model_.vertices.reserve(tree.corners.size());
    model_.triangles.reserve(tree.corners.size() / 2);
  }

  error::Expected<Model> run() {
    if (const auto done = visit(first_node_, Transform{}, 0, 0); !done) return tl::unexpected(done.error());
    if (invalid_ > 0)
      remarks_.left_out.add("polygons with coordinates that are not numbers or exceed 10,000 km: " +
                            std::to_string(invalid_) + "; they are left out");
    if (degenerate_ > 0)
      remarks_.warnings.add("triangles without area: " + std::to_string(degenerate_) + "; they are left out");
    model_.warnings = remarks_.warnings.take();
    model_.left_out = remarks_.left_out.take();
    model_.kinds = kinds_.kinds();
    return std::move(model_);
  }

 private:
  using Done = error::Expected<void>;

  // Visits a node. Without replications its matrix applies once. With n replications there are n + 1 copies: the first
  // stays in place, and the matrix applies to each further copy once more than to the copy before.
  Done visit(std::uint32_t number, const Transform& above, std::uint32_t object, int depth) {
    const Node& node = tree_.nodes[number];
    if (depth > kMaxNodeDepth)
      return error::fail(subject_, "nodes nested at most " + std::to_string(kMaxNodeDepth) + " deep",
                         "deeper nesting, as when an instance contains itself", "correct the file's instances");
    if (node.kind == NodeKind::ignored) return {};
    if (filter_ != nullptr && filter_->leaves_out(node.name)) return {};
    if (node.matrix == kNone) return visit_once(node, above, object, depth);
    const Transform& matrix = tree_.matrices[node.matrix];
    Transform moved = node.replications > 0 ? Transform{} : matrix;
    for (int copy = 0; copy <= node.replications; ++copy) {
      if (auto done = visit_once(node, above * moved, object, depth); !done) return done;
      moved = matrix * moved;
    }
    return {};
  }

  Done visit_once(const Node& node, const Transform& above, std::uint32_t object, int depth) {
    if (auto done = count_visits(1); !done) return done;
    const Transform transform = node.pose == kNone ? above : above * tree_.matrices[node.pose];
    if (node.kind == NodeKind::object) {
      if (auto done = check_objects(1); !done) return done;
      object = static_cast<std::uint32_t>(model_.objects.size());
      model_.objects.push_back(node.name);
    }
    if (node.kind == NodeKind::external) return add_external(node, transform, object);
    if (node.kind == NodeKind::instance) {
      const auto definition = tree_.definitions.find(node.instance);
      if (definition == tree_.definitions.end()) {
        remarks_.left_out.add("an instance of definition " + std::to_string(node.instance) +
                              ", which the file does not have; the instance is left out");
        return {};
      }
      if (auto done = visit(definition->second, transform, object, depth + 1); !done) return done;
    }
    for (std::uint32_t face = node.first_face; face != kNone; face = tree_.faces[face].next)
      if (auto done = add_face(tree_.faces[face], transform, object); !done) return done;
    return visit_children(node, transform, object, depth);
  }

  Done visit_children(const Node& node, const Transform& transform, std::uint32_t object, int depth) {
    std::uint32_t position = 0;
    for (std::uint32_t child = node.first_child; child != kNone; child = tree_.nodes[child].next_sibling, ++position) {
      if (tree_.nodes[child].is_coarser) continue;
      if (!shows(node, position)) continue;
      if (auto done = visit(child, transform, object, depth + 1); !done) return done;
      if (node.first_child_only) break;
    }
    return {};
  }

  Done count_visits(std::size_t more) {
    visits_ += more;
    if (visits_ <= limits_.visits) return {};
    return error::fail(subject_, "at most " + std::to_string(limits_.visits) + " nodes and corners with their copies",
                       "more", "split the file, or use fewer instances and replications");
  }

  Done check_limits(std::size_t triangles, std::size_t vertices) {
    if (model_.triangles.size() + triangles <= limits_.triangles &&
        model_.vertices.size() + vertices <= limits_.vertices)
      return {};
    return error::fail(subject_,
                       "at most " + std::to_string(limits_.triangles) + " triangles and " +
                           std::to_string(limits_.vertices) + " vertices",
                       "more", "split the scene into several files");
  }

  Done check_objects(std::size_t more) {
    if (model_.objects.size() + more <= limits_.objects) return {};
    return error::fail(subject_, "at most " + std::to_string(limits_.objects) + " objects with their copies", "more",
                       "split the scene into several files");
  }

  Done add_external(const Node& node, const Transform& transform, std::uint32_t object) {
    if (!load_) return {};
    const auto loaded = load_(node.name);
    if (!loaded) return tl::unexpected(loaded.error());
    if (!*loaded) return {};
    const Model& other = **loaded;
    if (auto done = count_visits(other.kinds.size()); !done) return done;
    if (auto done = check_limits(other.triangles.size(), other.vertices.size()); !done) return done;
    if (auto done = check_objects(other.objects.size() - 1); !done) return done;
    const auto first_vertex = static_cast<std::uint32_t>(model_.vertices.size());
    for (const ModelVertex& vertex : other.vertices) {
      const Vector3 at = transformed_point(transform, vector_of(vertex.position_m) + other.base);
      if (!is_valid_position(at))
        return error::fail(subject_, "an external file within 10,000 km of the origin", node.name + " farther away",
                           "correct the matrix of the reference");
      append(at, transformed_normal(transform, vector_of(vertex.normal)));
    }
    // Objects of the external file stay separate objects. Faces of that file outside any object become part of the
    // object that contains the reference.
    const auto first_object = static_cast<std::uint32_t>(model_.objects.size());
    model_.objects.insert(model_.objects.end(), other.objects.begin() + 1, other.objects.end());
    std::vector<std::uint16_t> kinds;
    for (const SurfaceKind& kind : other.kinds) kinds.push_back(kinds_.number_of(kind));
    const bool mirrored = mirrors(transform);
    for (ModelTriangle triangle : other.triangles) {
      for (std::uint32_t& corner : triangle.corners) corner += first_vertex;
      if (mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
      triangle.object = triangle.object == 0 ? object : first_object + triangle.object - 1;
      triangle.kind = kinds[triangle.kind];
      model_.triangles.push_back(triangle);
    }
    model_.polygons += other.polygons;
    return {};
  }

  // Collects the corners in model space, counter-clockwise seen from the front of the face. Returns false for an
  // invalid position.
  bool gather(const TreeFace& face, const Transform& transform) {
    positions_.clear();
    normals_.clear();
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const TreeVertex& vertex = tree_.vertices[tree_.corners[face.first_corner + i]];
      const Vector3 at = transformed_point(transform, vertex.position);
      if (!is_valid_position(at)) return false;
      positions_.push_back(at);
      normals_.push_back(transformed_normal(transform, vector_of(vertex.normal)));
    }
    if (mirrors(transform)) {
      std::reverse(positions_.begin(), positions_.end());
      std::reverse(normals_.begin(), normals_.end());
    }
    return true;
  }

  Done add_face(const TreeFace& face, const Transform& transform, std::uint32_t object) {
    if (auto done = count_visits(face.count + std::size_t{1}); !done) return done;
    if (face.count < 3) return {};
    if (!gather(face, transform)) {
      ++invalid_;
      return {};
    }
    Vector3 facet = newell_normal(positions_);
    const double size = length(facet);
    triangulate(positions_, triangles_);
    degenerate_ += face.count - 2 - triangles_.size();
    if (!(size > kMinDoubleArea_m2) || triangles_.empty()) {
      degenerate_ += triangles_.size();
      return {};
    }
    facet = (1.0 / size) * facet;
    if (auto done = check_limits(2 * triangles_.size(), 2 * positions_.size()); !done) return done;
    if (face.subface_level > 0)
      for (Vector3& at : positions_) at += static_cast<double>(kSubfaceLift_m * face.subface_level) * facet;
    ++model_.polygons;
    emit(face, object, facet, false);
    if (face.two_sided) emit(face, object, -1.0 * facet, true);
    return {};
  }

  void emit(const TreeFace& face, std::uint32_t object, Vector3 facet, bool back) {
    const auto first = static_cast<std::uint32_t>(model_.vertices.size());
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      Vector3 normal = back ? -1.0 * normals_[i] : normals_[i];
      const double size = length(normal);
      const bool given = size > 1e-6 && std::isfinite(size) && dot(normal, facet) > 0.0;
      append(positions_[i], given ? (1.0 / size) * normal : facet);
    }
    for (const auto& t : triangles_) {
      const Vector3 area = cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
      if (!(length(area) > kMinDoubleArea_m2)) {
        degenerate_ += back ? 0 : 1;
        continue;
      }
      const std::array<std::uint32_t, 3> corners{first + t[0], first + t[back ? 2 : 1], first + t[back ? 1 : 2]};
      model_.triangles.push_back({corners, object, kind_numbers_[face.kind]});
    }
  }

  void append(Vector3 position, Vector3 normal) {
    if (model_.vertices.empty() && std::max(std::abs(position.x), std::abs(position.y)) > kFarOrigin_m)
      model_.base = {std::round(position.x), std::round(position.y), 0.0};
    const double size = length(normal);
    model_.vertices.push_back({floats(position - model_.base), floats(size > 0.0 ? (1.0 / size) * normal : normal)});
  }

  const NodeTree& tree_;
  std::string subject_;
  const LoadExternal& load_;
  FlattenLimits limits_;
  NameFilter* filter_;
  Model model_;
  std::uint32_t first_node_;
  Remarks remarks_;
  KindTable kinds_;
  std::vector<std::uint16_t> kind_numbers_;  // for each entry of NodeTree::kinds: its index into kinds_
  std::size_t visits_ = 0;
  std::uint64_t invalid_ = 0;                            // polygons with an invalid position
  std::uint64_t degenerate_ = 0;                         // triangles without area
  std::vector<Vector3> positions_, normals_;             // current face
  std::vector<std::array<std::uint32_t, 3>> triangles_;  // current face: corner numbers
};

}  // namespace

error::Expected<Model> flatten(const NodeTree& tree, const std::string& subject, const LoadExternal& load,
                               FlattenOptions options) {
  return Flattener(tree, subject, load, options).run();
}

}  // namespace yars::model::scene
