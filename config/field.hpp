#pragma once

#include "config/draft.hpp"

// NOLINTBEGIN(bugprone-macro-parentheses): a path of fields cannot stand in parentheses.
// For the rows of the schema: the function that names one field of a draft, as `YARS_FIELD(radar.seed)`.
#define YARS_FIELD(path)                       \
  [](::yars::config::Draft & draft) -> auto& { \
    return draft.path;                         \
  }
// NOLINTEND(bugprone-macro-parentheses)
