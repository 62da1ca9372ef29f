// Reads an OpenFlight file with all that it refers to into one model. External files are sought beside the file that
// names them and nowhere outside the folder of the first; a name that leads out of it, one that is missing and one that
// leads back to a file being read are warnings, and what they would show is left out. A file referred to often is read
// once. `NAME.flt<node>` shows the whole file. Errors: those of parse_openflight and flatten; files that cannot be
// read, are larger than kLargestFile, nest deeper than kDeepestReference, or are more than kMaxFiles.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "lib/error/error.hpp"
#include "model/scene/openflight/model.hpp"

namespace yars::model::scene {

inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
inline constexpr int kMaxReferenceDepth = 16;
inline constexpr std::size_t kMaxFiles = 4096;

// `filter`: what is left out, null: nothing. It remembers what names there are; who asks for its complaint is told of
// names that nothing has.
error::Expected<Model> read_openflight(const std::filesystem::path& path, NameFilter* filter = nullptr);

// From memory; external references are counted and left out.
error::Expected<Model> read_openflight(std::span<const std::byte> bytes, const std::string& subject,
                                       FlattenLimits limits = {});

// The header alone.
error::Expected<Header> read_openflight_header(const std::filesystem::path& path);

}  // namespace yars::model::scene
