// Reader of an OpenFlight file and its external files into one Model.
// Inputs: a path or bytes, a filter of names. Outputs: a Model; Model::left_out names the external files that it lacks.
// An external file is looked for where its name says: from the folder of the file that names it, then from that of the
// first file. If it is not there, its name and its last folders, longest part first, are looked for from the same
// folders and from those above the first file. Model::warnings then say which file is used. Case counts only where two
// names differ in nothing else. Drive letters and the names of servers are ignored.
// Roots: no file is read from outside external_root(), by any path or link. Outside the folder of the first file, the
// name has to end in .flt.
// `NAME.flt<node>` shows only the node of this name, with its own transform but without those above it in its file.
// Left out: references without a usable name, to files outside the root, to missing files and nodes, and back to a file
// that contains the reference, directly or through other files.
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
inline constexpr std::size_t kMaxFiles = 4096;                      // external files of one scene, or nodes of files
inline constexpr std::size_t kMaxNames = 65'536;                    // different names of references in one scene
inline constexpr int kMaxParentFolders = 3;                         // see external_root()

// Folder in and below which a scene may refer to external files: kMaxParentFolders above the folder of the first file,
// so that models may share files as those of a CDB do, but never the root of the file system. `folder`: of the first
// file, canonical.
std::filesystem::path external_root(std::filesystem::path folder);

// Reads a file with its external files. `filter`: names to leave out; null: none. After the call,
// filter->unmatched_error() reports names that matched nothing.
error::Expected<Model> read_openflight(const std::filesystem::path& path, NameFilter* filter = nullptr);

// Reads a file from memory. External references are counted and omitted, without a warning.
error::Expected<Model> read_openflight(std::span<const std::byte> bytes, const std::string& subject,
                                       FlattenLimits limits = {});

// Reads only the header record of a file, of any length.
error::Expected<Header> read_openflight_header(const std::filesystem::path& path);

}  // namespace yars::model::scene
