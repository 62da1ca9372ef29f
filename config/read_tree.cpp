#include "config/read_tree.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "config/message_text.hpp"
#include "config/message_translation.hpp"
#include "config/rejection.hpp"

namespace yars::config {
namespace {

namespace fs = std::filesystem;

// The text of a regular file; a pipe or a device could block or never end.
std::string text_of_file(const fs::path& path, const std::string& subject) {
  std::error_code problem;
  if (!fs::is_regular_file(path, problem)) {
    const std::string found = fs::exists(path, problem) ? " is no file" : " does not exist";
    throw Rejection{failure::fail(subject, "a GUF file", path.string() + found, "check the path").value()};
  }
  if (fs::file_size(path, problem) > kMaxTextBytes) {
    throw Rejection{failure::fail(subject, "at most " + std::to_string(kMaxTextBytes) + " bytes in a file",
                                  path.string() + " is larger", "split the file")
                        .value()};
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (file.bad() || !file.is_open()) {
    throw Rejection{failure::fail(subject, "a file that can be read", path.string(), "check its permissions").value()};
  }
  return text;
}

bool is_inside(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

class TreeReader {
 public:
  ParsedText read(const fs::path& path) {
    root_ = fs::weakly_canonical(path).parent_path();
    result_.arguments = arguments_of(path, path.string());
    return in_messages_ ? guf_from_messages(std::move(result_)) : std::move(result_);
  }

 private:
  std::vector<Slot> arguments_of(const fs::path& path, const std::string& subject) {
    const std::string text = text_of_file(path, subject);
    if (open_.empty()) in_messages_ = is_in_messages(text);
    auto parsed = in_messages_ ? parse_messages(text, path.string()) : parse_text(text, path.string());
    if (!parsed) throw Rejection{parsed.error()};
    result_.tokens += parsed->tokens;
    if (result_.tokens > kMaxTokens) {
      throw Rejection{failure::fail(subject, "at most " + std::to_string(kMaxTokens) + " words with all includes",
                                    std::to_string(result_.tokens), "include less")
                          .value()};
    }
    std::move(parsed->warnings.begin(), parsed->warnings.end(), std::back_inserter(result_.warnings));
    open_.push_back(fs::weakly_canonical(path));
    std::vector<Slot> arguments = expanded(std::move(parsed->arguments));
    open_.pop_back();
    return arguments;
  }

  // The arguments that an include form stands for.
  std::vector<Slot> included(const Value& value) {
    const Form& form = std::get<Form>(value.data);
    const auto* name = form.slots.size() == 1 ? std::get_if<std::string>(&form.slots[0].value.data) : nullptr;
    if (name == nullptr) reject(value.where, R"(( include "file" ))", std::to_string(form.slots.size()) + " arguments");
    const fs::path path = fs::path(*value.where.file).parent_path() / *name;
    const fs::path canonical = fs::weakly_canonical(path);
    if (!is_inside(canonical, root_)) {
      reject(value.where, "an include inside " + root_.string(), path.string(), "copy the file there");
    }
    if (std::find(open_.begin(), open_.end(), canonical) != open_.end()) {
      reject(value.where, "an include that does not come back to its own file", path.string());
    }
    if (open_.size() >= static_cast<std::size_t>(kMaxIncludeDepth)) {
      reject(value.where, "at most " + std::to_string(kMaxIncludeDepth) + " files deep", path.string());
    }
    if (++includes_ > kMaxIncludes) {
      reject(value.where, "at most " + std::to_string(kMaxIncludes) + " includes", "one more");
    }
    return arguments_of(path, text_of(value.where));
  }

  std::vector<Slot> expanded(std::vector<Slot> arguments) {
    std::vector<Slot> result;
    for (Slot& argument : arguments) {
      const bool by_place = argument.name.empty() && argument.position == 0;
      if (by_place && is_include(argument.value)) {
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
      if (part.size() != 1 || !part[0].name.empty()) {
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
  std::vector<fs::path> open_;  // the files being read, from the first to the innermost
  bool in_messages_ = false;    // the first file is, and with it what it includes
  int includes_ = 0;
  ParsedText result_;
};

}  // namespace

failure::Expected<ParsedText> read_tree(const fs::path& path) {
  try {
    return TreeReader().read(path);
  } catch (const Rejection& rejection) {
    return tl::unexpected(rejection.error);
  } catch (const fs::filesystem_error& problem) {
    return failure::fail(path.string(), "a path that the system can follow", problem.code().message());
  }
}

failure::Expected<ParsedText> tree_of_text(std::string_view text, const std::string& name) {
  if (!is_in_messages(text)) return parse_text(text, name);
  auto messages = parse_messages(text, name);
  if (!messages) return messages;
  try {
    return guf_from_messages(std::move(*messages));
  } catch (const Rejection& rejection) {
    return tl::unexpected(rejection.error);
  }
}

}  // namespace yars::config
