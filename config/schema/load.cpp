#include "config/schema/load.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <utility>

#include "config/guf/messages.hpp"
#include "config/guf/parser.hpp"
#include "config/schema/form_reader.hpp"
#include "config/schema/message_translation.hpp"
#include "config/schema/schema.hpp"
#include "config/schema/sounding.hpp"
#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

namespace {

namespace fs = std::filesystem;

// Limits for a hostile file. Usual configurations are far below them.
constexpr int kMaxIncludeDepth = 8;
constexpr int kMaxIncludes = 64;  // includes of one configuration; a repeated file counts again

// Text of a regular file. Throws ParseError if the file cannot be read or is larger than kMaxTextBytes. Also throws if
// the path leads to anything else: reading a pipe or a device could block or never end. `subject`: with what an error
// begins, the file or the location of its include.
std::string text_of_file(const fs::path& path, const std::string& subject) {
  std::error_code problem;
  if (!fs::is_regular_file(path, problem)) {
    const bool is_subject = subject == path.string();  // otherwise the subject is the location of an include
    const std::string found = fs::exists(path, problem) ? "something else" : "none";
    throw ParseError{
        error::fail(subject, "a GUF file", found + (is_subject ? "" : " at " + path.string()), "check the path")
            .value()};
  }
  auto text = file::read_regular_file(path, kMaxTextBytes + 1);
  if (!text) {
    throw ParseError{error::fail(subject, "a file that can be read", path.string() + ": " + std::strerror(errno),
                                 "check its permissions")
                         .value()};
  }
  if (text->size() > kMaxTextBytes) {
    throw ParseError{error::fail(subject, "at most " + std::to_string(kMaxTextBytes) + " bytes in a file",
                                 path.string() + " is larger", "split the file")
                         .value()};
  }
  return std::move(*text);
}

bool is_inside(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// "did you mean" with the nearest name of a GUF file in one of the folders, else that the path is to be checked.
std::string advice_on_missing(const std::string& name, const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  std::error_code problem;
  for (const fs::path& folder : folders)
    for (auto it = fs::directory_iterator(folder, problem); it != fs::directory_iterator(); it.increment(problem))
      if (it->path().extension() == ".guf") names.push_back(it->path().filename().string());
  const std::string meant = text::did_you_mean(name, names);
  return meant.empty() ? "check the path" : meant;
}

// Reads a file and its includes as one tree of GUF.
// `( include "part.guf" )` is replaced by all arguments of that file. An include that is the value of `:name`
// or of `:2` needs a file with exactly one argument, without name or position.
// The path in an include is relative to the including file. The included file must be in the folder of the first file
// or below; a name alone may also mean a file that came with YARS. If the first file is in the message syntax
// (config/guf/messages.hpp), all included files are read in that syntax, and the whole tree is then translated to GUF.
// Throws ParseError if a file cannot be read, has an invalid syntax, includes itself or is outside the folder, or if a
// limit is exceeded.
class TreeReader {
 public:
  ParsedText read(const fs::path& path) {
    root_ = fs::weakly_canonical(fs::absolute(path)).parent_path();
    result_.arguments = arguments_of(path, path.string());
    return in_messages_ ? guf_from_messages(std::move(result_)) : std::move(result_);
  }

 private:
  std::vector<Slot> arguments_of(const fs::path& path, const std::string& subject) {
    const std::string text = text_of_file(path, subject);
    if (open_files_.empty()) in_messages_ = is_in_messages(text);
    auto parsed = in_messages_ ? parse_messages(text, path.string()) : parse_text(text, path.string());
    if (!parsed) throw ParseError{parsed.error()};
    result_.tokens += parsed->tokens;
    if (result_.tokens > kMaxTokens) {
      throw ParseError{error::fail(subject, "at most " + std::to_string(kMaxTokens) + " words with all includes",
                                   std::to_string(result_.tokens), "include less")
                           .value()};
    }
    std::move(parsed->warnings.begin(), parsed->warnings.end(), std::back_inserter(result_.warnings));
    open_files_.push_back(fs::weakly_canonical(fs::absolute(path)));
    std::vector<Slot> arguments = expanded(std::move(parsed->arguments));
    open_files_.pop_back();
    return arguments;
  }

  // The arguments that replace the include form `value`.
  std::vector<Slot> included(const Value& value) {
    const Form& form = std::get<Form>(value.data);
    const auto* name = form.slots.size() == 1 ? std::get_if<std::string>(&form.slots[0].value.data) : nullptr;
    if (name == nullptr) reject(value.where, R"(( include "file" ))", text::counted(form.slots.size(), "argument"));
    const fs::path path = path_of_include(fs::path(*value.where.file).parent_path(), *name);
    const fs::path canonical = fs::weakly_canonical(fs::absolute(path));
    if (!is_inside(canonical, root_) && (installed_.empty() || !is_inside(canonical, installed_))) {
      reject(value.where, "an include inside " + root_.string(), path.string(),
             "copy the file there; a file that came with YARS is included by its name alone");
    }
    if (std::error_code problem; !fs::exists(canonical, problem)) {
      reject(value.where, "a GUF file", "none at " + path.string(), advice_on_missing(*name, {root_, installed_}));
    }
    if (std::find(open_files_.begin(), open_files_.end(), canonical) != open_files_.end()) {
      reject(value.where, "an include that does not lead back to its own file", path.string());
    }
    if (open_files_.size() >= static_cast<std::size_t>(kMaxIncludeDepth)) {
      reject(value.where, "at most " + std::to_string(kMaxIncludeDepth) + " files deep", path.string());
    }
    if (++includes_ > kMaxIncludes) {
      reject(value.where, "at most " + std::to_string(kMaxIncludes) + " includes", "one more");
    }
    return arguments_of(path, text_of(value.where));
  }

  // A name without a folder that is not beside the including file means the file that came with YARS.
  fs::path path_of_include(const fs::path& folder, const std::string& name) const {
    const fs::path beside = folder / name;
    const fs::path came_with_yars = installed_ / name;
    std::error_code problem;
    const bool elsewhere = name.find('/') == std::string::npos && !fs::exists(beside, problem) && !installed_.empty();
    return elsewhere && fs::is_regular_file(came_with_yars, problem) ? came_with_yars : beside;
  }

  std::vector<Slot> expanded(std::vector<Slot> arguments) {
    std::vector<Slot> result;
    for (Slot& argument : arguments) {
      const bool by_order = argument.name.empty() && argument.position == 0;
      if (by_order && is_include(argument.value)) {
        auto part = included(argument.value);
        std::move(part.begin(), part.end(), std::back_inserter(result));
        continue;
      }
      argument.value = expanded(std::move(argument.value));
      result.push_back(std::move(argument));
    }
    return result;
  }

  Value expanded(Value value) {
    if (is_include(value)) {
      auto part = included(value);
      if (part.size() != 1 || !part[0].name.empty() || part[0].position != 0) {
        reject(value.where, "a file with one value for the slot", std::to_string(part.size()) + " arguments in it");
      }
      return std::move(part[0].value);
    }
    if (auto* form = std::get_if<Form>(&value.data)) form->slots = expanded(std::move(form->slots));
    if (auto* list = std::get_if<List>(&value.data)) list->items = expanded(std::move(list->items));
    return value;
  }

  std::vector<Value> expanded(std::vector<Value> items) {
    std::vector<Value> result;
    for (Value& item : items) {
      if (!is_include(item)) {
        result.push_back(expanded(std::move(item)));
        continue;
      }
      for (Slot& part : included(item)) {
        if (!part.name.empty()) reject(part.where, "values by position in a list", "the slot :" + part.name);
        if (part.position != 0)
          reject(part.where, "values without :N in a file that a list includes", ":" + std::to_string(part.position));
        result.push_back(std::move(part.value));
      }
    }
    return result;
  }

  static bool is_include(const Value& value) {
    const auto* form = std::get_if<Form>(&value.data);
    return form != nullptr && form->name == "include";
  }

  fs::path root_;
  const fs::path installed_ = file::installed_folder();  // canonical; empty: none
  std::vector<fs::path> open_files_;                     // canonical paths of the open files, the first file first
  bool in_messages_ = false;  // true: the first file and its includes are read in the message syntax
  int includes_ = 0;
  ParsedText result_;
};

error::Expected<ParsedText> read_tree(const fs::path& path) {
  try {
    return TreeReader().read(path);
  } catch (const ParseError& parse_error) {
    return tl::unexpected(parse_error.error);
  } catch (const fs::filesystem_error& problem) {
    return error::fail(path.string(), "a path that the system can follow", problem.code().message());
  }
}

// The GUF tree of a text in memory. Includes of a GUF text stay forms named `include`. An include in the message syntax
// is an error.
error::Expected<ParsedText> tree_of_text(std::string_view text, const std::string& name) {
  if (!is_in_messages(text)) return parse_text(text, name);
  auto messages = parse_messages(text, name);
  if (!messages) return messages;
  try {
    return guf_from_messages(std::move(*messages));
  } catch (const ParseError& parse_error) {
    return tl::unexpected(parse_error.error);
  }
}

error::Expected<LoadedConfiguration> configuration_from(ParsedText tree) {
  LoadedConfiguration loaded;
  loaded.warnings = std::move(tree.warnings);
  const BuilderPointer builder = new_builder();
  try {
    FormReader reader(*builder, loaded.warnings);
    reader.read_all(tree.arguments);
    loaded.notes = reader.notes();
  } catch (const ParseError& parse_error) {
    return tl::unexpected(parse_error.error);
  }
  loaded.radar = std::move(builder->whole);
  set_cross_sections(loaded.radar);
  radar::AtmosphereConfiguration& air = loaded.radar.world.atmosphere;
  if (!air.profile.empty()) {
    const auto fit = profile_of_sounding(air.profile);
    if (!fit) return tl::unexpected(fit.error());
    air.refractivity = fit->refractivity;
    air.refractivity_per_km = fit->per_km;
    air.profile.clear();
  }
  if (builder->has_network) loaded.network = std::move(builder->network);
  return loaded;
}

// Replaces old names of forms and slots by the names in the schema, and rewrites relative paths for the new folder.
class Modernizer {
 public:
  explicit Modernizer(const fs::path& folder) : folder_((fs::current_path() / folder / "").lexically_normal()) {}

  void rename(std::vector<Slot>& arguments) {
    for (Slot& argument : arguments) {
      const auto* form = std::get_if<Form>(&argument.value.data);
      if (form != nullptr && form->name == "def-form") {
        forms_.define(*form, argument.where);
      } else {
        rename(argument.value);
      }
    }
  }

 private:
  void rename(Value& value) {
    if (auto* list = std::get_if<List>(&value.data)) {
      for (Value& item : list->items) rename(item);
    } else if (auto* form = std::get_if<Form>(&value.data)) {
      rename(*form);
    }
  }

  void rename(Form& form) {
    const KnownForm known = forms_.find(form.name);
    if (known.schema != nullptr && !known.defined_in_text) form.name = known.schema->name;
    std::size_t index = 0;
    for (Slot& slot : form.slots) {
      ++index;
      rename(slot.value);
      const SlotSchema* row = known.schema == nullptr ? nullptr : row_of(*known.schema, slot, index);
      if (row == nullptr) continue;
      if (!slot.name.empty()) slot.name = row->name;
      if (std::holds_alternative<PathSlot>(row->binding)) move_path(slot.value);
    }
  }

  static const SlotSchema* row_of(const FormSchema& form, const Slot& slot, std::size_t index) {
    if (!slot.name.empty()) return find_slot(form, slot.name).schema;
    const std::size_t position = slot.position == 0 ? index : static_cast<std::size_t>(slot.position);
    return position <= form.slots.size() ? &form.slots[position - 1] : nullptr;
  }

  void move_path(Value& value) const {
    auto* text = std::get_if<std::string>(&value.data);
    if (text == nullptr || text->empty() || fs::path(*text).is_absolute() || !value.where.file) return;
    const fs::path old_folder =
        (fs::current_path() / fs::path(*value.where.file).parent_path() / "").lexically_normal();
    if (old_folder != folder_) *text = (old_folder / *text).lexically_normal().lexically_relative(folder_).string();
  }

  fs::path folder_;
  FormDefinitions forms_;
};

error::Expected<ConvertedConfiguration> converted_from(ParsedText tree, const std::string& name,
                                                       const fs::path& folder) {
  ConvertedConfiguration converted{{}, std::move(tree.warnings)};
  try {
    FormReader(*new_builder(), converted.warnings).read_all(tree.arguments);
    Modernizer(folder).rename(tree.arguments);
  } catch (const ParseError& parse_error) {
    return tl::unexpected(parse_error.error);
  } catch (const fs::filesystem_error& problem) {
    return error::fail(name, "a current folder, for the paths in the file", problem.code().message());
  }
  converted.text = tree_text(tree.arguments);
  const auto again = parse_text(converted.text, name);  // the text with all includes can exceed the limits of a file
  if (again) return converted;
  return error::fail(name, "what fits into one file of GUF: " + again.error().expected, again.error().found,
                     "convert its parts one by one");
}

}  // namespace

error::Expected<LoadedConfiguration> load_configuration(const std::filesystem::path& path) {
  if (path.empty()) return LoadedConfiguration{};
  return read_tree(path).and_then(configuration_from);
}

error::Expected<LoadedConfiguration> load_configuration_text(std::string_view text, const std::string& name) {
  return tree_of_text(text, name).and_then(configuration_from);
}

std::vector<Fault> faults_of_text(std::string_view text, const std::string& name) {
  const BuilderPointer builder = new_builder();
  std::vector<std::string> warnings;
  FormReader reader(*builder, warnings);
  std::optional<Fault> last;
  try {
    reader.read_all(parse(text, name).arguments);
  } catch (const ParseError& parse_error) {
    last = parse_error.fault;
    if (last->error.expected.empty()) last->error = parse_error.error;  // of the whole text
  }
  std::vector<Fault> faults = reader.unknown();
  if (last) faults.push_back(std::move(*last));
  return faults;
}

error::Expected<radar::RadarConfiguration> load_program_configuration(const std::filesystem::path& path) {
  auto loaded = load_configuration(path);
  if (!loaded) return tl::unexpected(loaded.error());
  for (const auto& warning : loaded->warnings) log::warning(warning);
  return std::move(loaded->radar);
}

error::Expected<ProgramNetwork> load_network(const std::filesystem::path& network,
                                             const std::filesystem::path& configuration) {
  auto whole = load_configuration(configuration);
  if (!whole) return tl::unexpected(whole.error());
  for (const auto& warning : whole->warnings) log::warning(warning);
  ProgramNetwork loaded{{}, std::move(whole->radar), {}};
  if (whole->network) {
    loaded.network = std::move(*whole->network);
    loaded.source = configuration.string();
  }
  if (network.empty()) return loaded;
  auto own = load_configuration(network);
  if (!own) return tl::unexpected(own.error());
  for (const auto& warning : own->warnings) log::warning(warning);
  if (!own->network)
    return error::fail(network.string(), "a form Network, as ( Network :interfaces `( \"eth0\" ) )", "none",
                       "add it; docs/configuration/network.md has its slots");
  if (!loaded.source.empty())
    log::warning("the form Network of " + loaded.source + " is not used: " + network.string() + " has one");
  loaded.network = std::move(*own->network);
  loaded.source = network.string();
  return loaded;
}

error::Expected<ConvertedConfiguration> convert_configuration(const fs::path& path, const fs::path& folder) {
  return read_tree(path).and_then(
      [&](ParsedText tree) { return converted_from(std::move(tree), path.string(), folder); });
}

error::Expected<ConvertedConfiguration> convert_configuration_text(std::string_view text, const std::string& name) {
  const fs::path folder = fs::path(name).parent_path();
  return tree_of_text(text, name).and_then([&](ParsedText tree) {
    return converted_from(std::move(tree), name, folder);
  });
}

}  // namespace yars::config
