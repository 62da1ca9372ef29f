#include "model/scene/openflight/reader.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "lib/text/plain_text.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/parser.hpp"
#include "model/scene/openflight/record_readers.hpp"
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

// Name of an external reference.
struct ReferenceName {
  fs::path file;       // without drive letter; components separated by /
  bool drive = false;  // the file has, or had, a drive or a server: it is nowhere on this machine
  std::string node;    // empty: the whole file
};

ReferenceName reference_name(std::string_view text) {
  ReferenceName name;
  const std::size_t open = text.find('<');
  if (open != std::string_view::npos) {
    name.node = text::trimmed(text.substr(open + 1));
    if (name.node.ends_with('>')) name.node.pop_back();
  }
  std::string file(text::trimmed(text.substr(0, open)));
  std::ranges::replace(file, '\\', '/');
  const bool letter = file.size() >= 2 && file[1] == ':' && std::isalpha(static_cast<unsigned char>(file[0])) != 0;
  if (letter) file.erase(0, 2);
  name.drive = letter || file.starts_with("//");
  name.file = file;
  return name;
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char one) { return static_cast<char>(std::tolower(one)); });
  return text;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// Finds the files that a scene refers to, inside its root.
class ExternalFinder {
 public:
  explicit ExternalFinder(const fs::path& first) : home_(first.parent_path()), root_(external_root(home_)) {
    for (fs::path above = home_; above != root_; above = above.parent_path()) parents_.push_back(above.parent_path());
  }

  struct Found {
    fs::path file;       // canonical; empty: none
    std::string reason;  // why there is none
    bool moved = false;  // it is not where its name says
  };

  // `from`: folder of the file that names the reference.
  Found find(const fs::path& from, const ReferenceName& name) {
    if (name.file.filename().empty()) return {{}, "has no usable name"};
    bool outside = false;
    std::vector<fs::path> folders{from};
    if (from != home_) folders.push_back(home_);
    if (!name.drive)
      for (const fs::path& folder : folders)
        if (auto file = existing(folder, name.file, outside)) return {*file, {}};
    const std::vector<fs::path> parts = last_parts(name.file);
    for (const fs::path& part : parts) {
      for (const fs::path& folder : folders)
        if (auto file = in_any_case(folder, part, outside)) return {*file, {}, true};
      // A bare name is too little to go by in the folders above.
      if (!part.has_parent_path()) continue;
      for (const fs::path& folder : parents_)
        if (auto file = in_any_case(folder, part, outside)) return {*file, {}, true};
    }
    return {{}, outside ? "lies outside the folder " + root_.string() : "is not there"};
  }

 private:
  // The parts of a path that end with its name, longest first: a/b.flt and b.flt of ../x/../a/b.flt.
  static std::vector<fs::path> last_parts(const fs::path& path) {
    constexpr std::size_t kMaxParts = 8;
    std::vector<fs::path> names;
    for (const fs::path& name : path) {
      if (name == ".." || name.is_absolute())
        names.clear();
      else if (name != "." && !name.empty())
        names.push_back(name);
    }
    std::vector<fs::path> parts;
    for (std::size_t count = std::min(names.size(), kMaxParts); count > 0; --count) {
      fs::path part;
      for (std::size_t i = names.size() - count; i < names.size(); ++i) part /= names[i];
      parts.push_back(part);
    }
    return parts;
  }

  // The file at `path`, seen from `folder`. `outside` becomes true if the path leads out of the root.
  std::optional<fs::path> existing(const fs::path& folder, const fs::path& path, bool& outside) {
    std::error_code code;
    const fs::path file = fs::weakly_canonical(folder / path, code);
    if (code) return std::nullopt;
    if (!is_below(file, root_)) {
      outside = true;
      return std::nullopt;
    }
    if (fs::exists(file, code)) return usable(file, outside);
    return path.is_absolute() ? in_any_case(path.root_path(), path.relative_path(), outside)
                              : in_any_case(folder, path, outside);
  }

  // The same, where names that differ by case only count as equal if no other is there. Most of these files are not
  // there, so the names come from listings, which are read once.
  std::optional<fs::path> in_any_case(const fs::path& folder, const fs::path& path, bool& outside) {
    fs::path at = folder;
    for (const fs::path& name : path) {
      if (name == ".") continue;
      if (name == "..") {
        at = at.parent_path();
        continue;
      }
      std::error_code code;
      fs::path next = at / name;
      if (is_below(at, root_)) {
        const Listing& listing = listing_of(at);
        const auto like = listing.names.find(lower_case(name.string()));
        if (like != listing.names.end() && !std::ranges::binary_search(like->second, name))
          next = at / like->second.front();
        else if (like == listing.names.end() && (listing.whole || !fs::exists(next, code)))
          return std::nullopt;
      }
      at = fs::weakly_canonical(next, code);
      if (code) return std::nullopt;
    }
    return usable(at, outside);
  }

  // The canonical path of a file, if that may be read.
  std::optional<fs::path> usable(const fs::path& file, bool& outside) const {
    std::error_code code;
    if (!is_below(file, root_)) {
      outside = true;
      return std::nullopt;
    }
    const bool may_be_read = is_below(file, home_) || lower_case(file.extension().string()) == ".flt";
    return may_be_read && fs::is_regular_file(file, code) ? std::optional(file) : std::nullopt;
  }

  // Names in a folder by their lower case, each list sorted.
  struct Listing {
    std::unordered_map<std::string, std::vector<fs::path>> names;
    bool whole = true;
  };
  const Listing& listing_of(const fs::path& folder) {
    constexpr std::size_t kMaxNamesListed = 200'000;
    const auto [known, is_new] = listed_.try_emplace(folder);
    Listing& listing = known->second;
    if (!is_new) return listing;
    std::error_code code;
    std::size_t count = 0;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end && listing.whole;
         entry.increment(code)) {
      const fs::path name = entry->path().filename();
      listing.names[lower_case(name.string())].push_back(name);
      listing.whole = ++count < kMaxNamesListed;
    }
    listing.whole &= !code;  // a folder that may be entered but not listed
    for (auto& [key, names] : listing.names) std::ranges::sort(names);
    return listing;
  }

  fs::path home_;                  // folder of the first file
  fs::path root_;                  // no file is read from outside this folder
  std::vector<fs::path> parents_;  // folders above home_, up to root_
  std::map<fs::path, Listing> listed_;
};

// The first file of a scene and its external files. Each file is read once.
class FileSet {
 public:
  FileSet(const fs::path& first, NameFilter* filter) : finder_(first), filter_(filter) {}

  error::Expected<Model> read_first(const fs::path& path) {
    open_paths_.push_back(path);
    auto tree = parse(path);
    if (!tree) return tl::unexpected(tree.error());
    add_counts(counts_, tree->counts);
    auto model = flattened(path, *tree, 0);
    if (!model) return model;
    for (std::string& warning : model->warnings) remarks_.warnings.add(std::move(warning));
    for (std::string& sentence : model->left_out) remarks_.left_out.add(std::move(sentence));
    model->warnings = remarks_.warnings.take();
    model->left_out = remarks_.left_out.take();
    model->counts = counts_;
    model->files = std::move(names_);
    return model;
  }

 private:
  using Part = std::pair<fs::path, std::string>;  // a file, and the name of a node or nothing
  using SharedModel = std::shared_ptr<const Model>;

  // The tree of a file, and its nodes by their names.
  struct NamedTree {
    NodeTree tree;
    std::unordered_map<std::string, std::uint32_t> nodes;
  };
  using SharedTree = std::shared_ptr<const NamedTree>;

  static error::Expected<NodeTree> parse(const fs::path& path) {
    const auto bytes = read_bytes(path, kMaxFileBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_openflight(*bytes, path.string());
  }

  error::Expected<Model> flattened(const fs::path& path, const NodeTree& tree, std::uint32_t first_node) {
    const LoadExternal load = [this, &path](const std::string& name) { return load_reference(path, name); };
    return flatten(tree, path.string(), load, {.filter = filter_, .first_node = first_node});
  }

  // The tree of an external file. Only a file of which single nodes are shown is needed again, and kept.
  error::Expected<SharedTree> tree_of(const fs::path& path, bool keep) {
    if (const auto known = trees_.find(path); known != trees_.end()) return known->second;
    auto tree = parse(path);
    if (!tree) return tl::unexpected(tree.error());
    if (counted_.insert(path).second) {
      add_counts(counts_, tree->counts);
      names_.push_back(path.string());
    }
    auto shared = std::make_shared<NamedTree>(NamedTree{std::move(*tree), {}});
    if (!keep) return shared;
    for (std::uint32_t number = 0; number < shared->tree.nodes.size(); ++number)
      if (const Node& node = shared->tree.nodes[number]; node.kind != NodeKind::external && !node.name.empty())
        shared->nodes.try_emplace(node.name, number);
    trees_.emplace(path, shared);
    return shared;
  }

  // Null: the file has no such node.
  error::Expected<SharedModel> read(const Part& part) {
    if (const auto known = read_.find(part); known != read_.end()) return known->second;
    const auto& [path, node] = part;
    if (open_paths_.size() > kMaxReferenceDepth)
      return error::fail(path.string(), "external references at most " + std::to_string(kMaxReferenceDepth) + " deep",
                         "deeper references", "merge some of the files");
    if (read_.size() >= kMaxFiles)
      return error::fail(path.string(),
                         "at most " + std::to_string(kMaxFiles) + " files, or nodes of files, in a scene", "more",
                         "split the scene");
    const auto tree = tree_of(path, !node.empty());
    if (!tree) return tl::unexpected(tree.error());
    SharedModel shared;
    const auto named = (*tree)->nodes.find(node);
    if (node.empty() || named != (*tree)->nodes.end()) {
      open_paths_.push_back(path);
      auto model = flattened(path, (*tree)->tree, node.empty() ? 0 : named->second);
      open_paths_.pop_back();
      if (!model) return tl::unexpected(model.error());
      for (const std::string& warning : model->warnings) remarks_.warnings.add(path.string() + ": " + warning);
      for (const std::string& sentence : model->left_out) remarks_.left_out.add(path.string() + ": " + sentence);
      shared = std::make_shared<const Model>(std::move(*model));
    }
    read_.emplace(part, shared);
    return shared;
  }

  // Loads the reference `text` of the file `from`. Null: it is left out, and a remark says why.
  error::Expected<SharedModel> load_reference(const fs::path& from, const std::string& text) {
    const ReferenceName name = reference_name(text);
    const auto known = found_.find({from.parent_path(), text});
    if (known == found_.end() && found_.size() >= kMaxNames)
      return error::fail(from.string(), "at most " + std::to_string(kMaxNames) + " different external references",
                         "more", "split the scene");
    const ExternalFinder::Found found = known != found_.end() ? known->second : finder_.find(from.parent_path(), name);
    found_.try_emplace({from.parent_path(), text}, found);
    const std::string shown = text::printable(text);
    std::string reason = found.reason;
    if (std::ranges::find(open_paths_, found.file) != open_paths_.end()) reason = "leads back to itself";
    if (reason.empty()) {
      auto model = read({found.file, name.node});
      if (!model) return model;
      if (*model && found.moved)
        remarks_.warnings.add("external file " + shown + " is not there; " + found.file.string() + " is used for it");
      if (*model) return model;
      reason = "names a node that " + found.file.string() + " does not have";
    }
    remarks_.left_out.add("external file " + shown + " " + reason + "; it is left out");
    return nullptr;
  }

  ExternalFinder finder_;
  NameFilter* filter_;
  std::map<std::pair<fs::path, std::string>, ExternalFinder::Found> found_;  // by folder and text of the reference
  std::map<Part, SharedModel> read_;                                         // external files
  std::map<fs::path, SharedTree> trees_;                                     // files of which single nodes are shown
  std::vector<fs::path> open_paths_;  // chain of references from the first file to the current one
  FileCounts counts_;
  std::set<fs::path> counted_;      // external files in counts_ and names_
  std::vector<std::string> names_;  // paths of the external files, in the order in which they were read
  Remarks remarks_;
};

}  // namespace

fs::path external_root(fs::path folder) {
  for (int i = 0; i < kMaxParentFolders && folder != folder.root_path(); ++i) {
    if (folder.parent_path() == folder.root_path()) break;
    folder = folder.parent_path();
  }
  return folder;
}

error::Expected<Model> read_openflight(const fs::path& path, NameFilter* filter) {
  std::error_code code;
  fs::path first = fs::weakly_canonical(path, code);
  if (code) first = path;  // links in a circle
  auto model = FileSet(first, filter).read_first(first);
  if (model) return model;
  // The message names the file as the user does, and an external file behind it.
  error::Error error = std::move(model.error());
  error.subject = path.string() + (error.subject == first ? "" : ": external file " + error.subject);
  return tl::unexpected(std::move(error));
}

error::Expected<Model> read_openflight(std::span<const std::byte> bytes, const std::string& subject,
                                       FlattenLimits limits) {
  const auto tree = parse_openflight(bytes, subject);
  if (!tree) return tl::unexpected(tree.error());
  return flatten(*tree, subject, {}, {.limits = limits});
}

error::Expected<Header> read_openflight_header(const fs::path& path) {
  constexpr std::size_t kMaxRecordBytes = 65'535;  // limit of the field of a record's length
  const auto bytes = read_bytes(path, kMaxRecordBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_header(*bytes, path.string());
}

}  // namespace yars::model::scene
