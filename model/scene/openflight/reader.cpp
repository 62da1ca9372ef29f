#include "model/scene/openflight/reader.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "lib/text/plain_text.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/parser.hpp"
#include "model/scene/openflight/records.hpp"
#include "model/terrain/formats/cell_reading.hpp"

namespace yars::model::scene {

namespace {

namespace fs = std::filesystem;

// Reads the first `max_bytes` bytes of a file, or the whole file if it is shorter. A file above kMaxFileBytes is an
// error in both cases.
error::Expected<std::vector<std::byte>> read_bytes(const fs::path& path, std::uintmax_t max_bytes) {
  std::error_code code;
  if (!fs::is_regular_file(path, code))
    return error::fail(path.string(), "an OpenFlight file",
                       code ? error::reason_of(code.value()) : "not a regular file", "give the path of a .flt file");
  const std::uintmax_t size = fs::file_size(path, code);
  if (code) return error::fail(path.string(), "a readable file", error::reason_of(code.value()));
  if (size > kMaxFileBytes)
    return error::fail(path.string(), "at most " + text::counted(kMaxFileBytes, "byte"), text::counted(size, "byte"),
                       "split the scene into several files");
  return terrain::read_file_part(path, 0, std::min(size, max_bytes));
}

void add_counts(FileCounts& sum, const FileCounts& more) {
  sum.vertices += more.vertices;
  sum.faces += more.faces;
  sum.corners += more.corners;
  sum.hidden_faces += more.hidden_faces;
  sum.objects += more.objects;
  sum.meshes += more.meshes;
  sum.materials += more.materials;
  sum.levels_of_detail += more.levels_of_detail;
  sum.instances += more.instances;
  sum.external_references += more.external_references;
}

// The main file of a scene and its external files. Each file is read once.
class FileSet {
 public:
  FileSet(const fs::path& first, NameFilter* filter) : root_(first.parent_path()), filter_(filter) {}

  error::Expected<Model> read_first(const fs::path& path) {
    open_paths_.push_back(path);
    return parse_and_flatten(path);
  }

  std::vector<std::string> take_warnings() { return warnings_.take(); }
  FileCounts counts() const { return counts_; }
  std::vector<std::string> names() const { return names_; }

 private:
  error::Expected<std::shared_ptr<const Model>> read(const fs::path& path) {
    if (const auto known = read_.find(path); known != read_.end()) return known->second;
    if (open_paths_.size() > kMaxReferenceDepth)
      return error::fail(path.string(), "external references at most " + std::to_string(kMaxReferenceDepth) + " deep",
                         "deeper references", "merge some of the files");
    if (++files_ > kMaxFiles)
      return error::fail(path.string(), "at most " + std::to_string(kMaxFiles) + " files in a scene", "more",
                         "split the scene");
    open_paths_.push_back(path);
    auto model = parse_and_flatten(path);
    open_paths_.pop_back();
    if (!model) return tl::unexpected(model.error());
    auto shared = std::make_shared<const Model>(std::move(*model));
    read_.emplace(path, shared);
    return shared;
  }

  error::Expected<Model> parse_and_flatten(const fs::path& path) {
    const std::string subject = path.string();
    error::Expected<NodeTree> tree = [&]() -> error::Expected<NodeTree> {
      const auto bytes = read_bytes(path, kMaxFileBytes);
      if (!bytes) return tl::unexpected(bytes.error());
      return parse_openflight(*bytes, subject);
    }();
    if (!tree) return tl::unexpected(tree.error());
    add_counts(counts_, tree->counts);
    if (open_paths_.size() > 1) names_.push_back(subject);
    return flatten(
        *tree, subject, [this, &path](const std::string& name) { return load_reference(path, name); }, {}, filter_);
  }

  // Loads the external file `name` that the file `from` refers to. Returns null and adds a warning if it has to be
  // skipped.
  error::Expected<std::shared_ptr<const Model>> load_reference(const fs::path& from, std::string name) {
    name = name.substr(0, name.find('<'));
    std::replace(name.begin(), name.end(), '\\', '/');
    std::error_code code;
    const fs::path path = fs::weakly_canonical(from.parent_path() / name, code);
    const auto reason = [&]() -> std::string {
      if (name.empty() || code) return "has no usable name";
      const auto step = std::mismatch(root_.begin(), root_.end(), path.begin(), path.end());
      if (step.first != root_.end()) return "lies outside the folder of the scene";
      if (std::find(open_paths_.begin(), open_paths_.end(), path) != open_paths_.end()) return "leads back to itself";
      if (!fs::is_regular_file(path, code)) return "is not there";
      return {};
    }();
    if (reason.empty()) return read(path);
    warnings_.add("external file " + name + " " + reason + "; it is left out");
    return nullptr;
  }

  fs::path root_;
  NameFilter* filter_;
  std::map<fs::path, std::shared_ptr<const Model>> read_;  // external files
  std::vector<fs::path> open_paths_;                       // chain of references from the main file to the current one
  std::size_t files_ = 0;
  FileCounts counts_;
  std::vector<std::string> names_;  // paths of the external files, in the order in which they were read
  WarningList warnings_;
};

}  // namespace

error::Expected<Model> read_openflight(const fs::path& path, NameFilter* filter) {
  std::error_code code;
  const fs::path canonical = fs::weakly_canonical(path, code);
  FileSet files(canonical, filter);
  auto model = files.read_first(canonical);
  if (!model) return model;
  model->counts = files.counts();
  model->files = files.names();
  for (std::string& warning : files.take_warnings()) model->warnings.push_back(std::move(warning));
  return model;
}

error::Expected<Model> read_openflight(std::span<const std::byte> bytes, const std::string& subject,
                                       FlattenLimits limits) {
  const auto tree = parse_openflight(bytes, subject);
  if (!tree) return tl::unexpected(tree.error());
  return flatten(*tree, subject, {}, limits);
}

error::Expected<Header> read_openflight_header(const fs::path& path) {
  const auto bytes = read_bytes(path, openflight::header::kBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_header(*bytes, path.string());
}

}  // namespace yars::model::scene
