#include "config/convert.hpp"

#include "config/form_book.hpp"
#include "config/form_reader.hpp"
#include "config/read_tree.hpp"
#include "config/rejection.hpp"
#include "config/schema.hpp"
#include "config/tree_text.hpp"

namespace yars::config {
namespace {

namespace fs = std::filesystem;

// Gives forms and slots the names of the schema, and paths the folder of the new file.
class Modernizer {
 public:
  explicit Modernizer(const fs::path& folder) : folder_((fs::current_path() / folder / "").lexically_normal()) {}

  void rename(std::vector<Slot>& arguments) {
    for (Slot& argument : arguments) {
      const auto* form = std::get_if<Form>(&argument.value.data);
      if (form != nullptr && form->name == "def-form") {
        book_.define(*form, argument.where);
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
    const KnownForm known = book_.look_up(form.name);
    if (known.schema != nullptr && !known.defined_in_text) form.name = known.schema->name;
    std::size_t place = 0;
    for (Slot& slot : form.slots) {
      ++place;
      rename(slot.value);
      const SlotSchema* row = known.schema == nullptr ? nullptr : row_of(*known.schema, slot, place);
      if (row == nullptr) continue;
      if (!slot.name.empty()) slot.name = row->name;
      if (std::holds_alternative<PathSlot>(row->binding)) move_path(slot.value);
    }
  }

  static const SlotSchema* row_of(const FormSchema& form, const Slot& slot, std::size_t place) {
    if (!slot.name.empty()) return find_slot(form, slot.name).schema;
    const std::size_t position = slot.position == 0 ? place : static_cast<std::size_t>(slot.position);
    return position <= form.slots.size() ? &form.slots[position - 1] : nullptr;
  }

  void move_path(Value& value) const {
    auto* text = std::get_if<std::string>(&value.data);
    if (text == nullptr || text->empty() || fs::path(*text).is_absolute() || !value.where.file) return;
    const fs::path here = (fs::current_path() / fs::path(*value.where.file).parent_path() / "").lexically_normal();
    if (here != folder_) *text = (here / *text).lexically_normal().lexically_relative(folder_).string();
  }

  fs::path folder_;
  FormBook book_;
};

failure::Expected<ConvertedConfiguration> converted_from(ParsedText tree, const std::string& name,
                                                         const fs::path& folder) {
  ConvertedConfiguration converted{{}, std::move(tree.warnings)};
  try {
    Draft draft;
    FormReader(draft, converted.warnings).read_all(tree.arguments);
    Modernizer(folder).rename(tree.arguments);
  } catch (const Rejection& rejection) {
    return tl::unexpected(rejection.error);
  } catch (const fs::filesystem_error& problem) {
    return failure::fail(name, "a current folder, for the paths in the file", problem.code().message());
  }
  converted.text = tree_text(tree.arguments);
  const auto again = parse_text(converted.text, name);  // with all it includes in one file, it can exceed the limits
  if (again) return converted;
  return failure::fail(name, "what fits into one file of GUF: " + again.error().expected, again.error().found,
                       "convert its parts one by one");
}

}  // namespace

failure::Expected<ConvertedConfiguration> convert_configuration(const fs::path& path, const fs::path& folder) {
  return read_tree(path).and_then(
      [&](ParsedText tree) { return converted_from(std::move(tree), path.string(), folder); });
}

failure::Expected<ConvertedConfiguration> convert_configuration_text(std::string_view text, const std::string& name) {
  const fs::path folder = fs::path(name).parent_path();
  return tree_of_text(text, name).and_then([&](ParsedText tree) {
    return converted_from(std::move(tree), name, folder);
  });
}

}  // namespace yars::config
