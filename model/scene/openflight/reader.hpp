// Reader of an OpenFlight file and its external files into one Model.
// Inputs: a path or bytes, a filter of names. Outputs: a Model; its warnings name the skipped external files.
// A relative path of an external file begins at the folder of the file that names it. Each file is read once.
// Skipped: references without a usable name, to files outside the folder of the main file, to missing files, and back
// to a file that contains the reference, directly or through other files.
// A reference `NAME.flt<node>` loads the whole of NAME.flt.
// Errors: errors of parse_openflight() and flatten(); unreadable files; an exceeded limit (constants below).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "lib/error/error.hpp"
#include "model/scene/openflight/model.hpp"

namespace yars::model::scene {

inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;  // size of one file; bounds memory
inline constexpr int kMaxReferenceDepth = 16;                       // nesting of external references
inline constexpr std::size_t kMaxFiles = 4096;                      // external files of one scene

// Reads a file with its external files. `filter`: names to leave out; null: none. After the call,
// filter->unmatched_error() reports names that matched nothing.
error::Expected<Model> read_openflight(const std::filesystem::path& path, NameFilter* filter = nullptr);

// Reads a file from memory. External references are counted and omitted, without a warning.
error::Expected<Model> read_openflight(std::span<const std::byte> bytes, const std::string& subject,
                                       FlattenLimits limits = {});

// Reads only the header record of a file.
error::Expected<Header> read_openflight_header(const std::filesystem::path& path);

}  // namespace yars::model::scene
