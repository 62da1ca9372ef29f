// Names of what is left out of a scene: objects, groups and levels of detail by their names, external files by theirs;
// with all that is below them. In a name `*` stands for any letters and `?` for one; upper and lower case are one.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lib/failure/error.hpp"

namespace yars::model::scene {

class NameFilter {
 public:
  // Names apart by commas, blanks about them are of no account; empty: nothing is left out.
  explicit NameFilter(std::string_view names);

  // Remembers the name, and which of those wanted it met.
  bool leaves_out(const std::string& name);

  // The names that another one was asked about.
  void add_seen(const NameFilter& other) { seen_.insert(other.seen_.begin(), other.seen_.end()); }

  // Of the names wanted, those that nothing had that was asked about.
  std::vector<std::string> unmet() const;
  // Nothing, or what is wrong with the first of them: it lists names that are near to it. `subject`: where they were
  // sought.
  std::optional<failure::Error> complaint(const std::string& subject) const;

 private:
  struct Wanted {
    std::string name;
    bool met = false;
  };
  std::vector<Wanted> wanted_;
  std::set<std::string> seen_;
};

}  // namespace yars::model::scene
