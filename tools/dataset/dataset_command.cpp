// `yars dataset`: checks its options and becomes `python3 -m yars.dataset`, which makes the data set.
// Source of option names: docs/commands.md#dataset, docs/datasets.md.

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "tools/command/command.hpp"

namespace yars::tools {

namespace {

struct DatasetOptions {
  std::string specification, out, shard, dask;
  std::optional<int> workers;
  bool verify = false, merge = false, check = false, keys = false;
};

constexpr int kMaxWorkers = 4096;

// Folder with the package `yars`: of this build, or of this installation. Throws CommandFailed if there is none.
std::string package_folder() {
  std::error_code code;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
  const std::filesystem::path prefix = program.parent_path().parent_path();
  for (const char* folder : {"python", "lib/python3/dist-packages"})
    if (std::filesystem::exists(prefix / folder / "yars/dataset/__main__.py")) return (prefix / folder).string();
  throw_failure({"yars dataset", "the Python package yars in " + prefix.string(), "none",
                 "install the Debian package python3-yars, or build the target yars_python"});
}

std::vector<std::string> words_of(const DatasetOptions& options) {
  std::vector<std::string> words;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) words.push_back(name + ("=" + value));
  };
  if (!options.specification.empty()) words.push_back(options.specification);
  add("--out", options.out);
  add("--shard", options.shard);
  add("--dask", options.dask);
  if (options.workers) add("--workers", std::to_string(*options.workers));
  for (const auto& [name, given] : {std::pair{"--verify", options.verify}, std::pair{"--merge", options.merge},
                                    std::pair{"--check", options.check}, std::pair{"--keys", options.keys}})
    if (given) words.emplace_back(name);
  return words;
}

// Replaces this process by Python. Throws CommandFailed if that fails.
[[noreturn]] void become_python(const DatasetOptions& options) {
  const std::string folder = package_folder();
  const char* const given = std::getenv("PYTHONPATH");
  ::setenv("PYTHONPATH", (given == nullptr || *given == '\0' ? folder : folder + ':' + given).c_str(), 1);
  // Debian's Python, for which the package is built; else the one in PATH.
  constexpr const char* kDebian = "/usr/bin/python3";
  const std::string python = ::access(kDebian, X_OK) == 0 ? kDebian : "python3";
  std::vector<std::string> words{python, "-m", "yars.dataset"};
  for (std::string& word : words_of(options)) words.push_back(std::move(word));
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execvp(python.c_str(), arguments.data());
  throw_failure({"yars dataset", "Python as " + python, error::reason_of(errno), "install python3"});
}

}  // namespace

void add_dataset_command(runtime::Command app) {
  auto options = std::make_shared<DatasetOptions>();
  runtime::Command command =
      app.subcommand("dataset", "make training data: patch maps with labels, by a specification");
  command.option("SPECIFICATION", options->specification, "what to make (YAML)")
      .value_name("FILE")
      .otherwise("none, for --keys");
  command.option("--out", options->out, "folder of the data set; one that was interrupted is completed")
      .value_name("DIR")
      .otherwise("none, for --check");
  command.option("--workers", options->workers, "number of processes")
      .range(1, kMaxWorkers)
      .otherwise("one for each processor");
  command.option("--shard", options->shard, "i/N: only every Nth block from block i on, for batch systems")
      .value_name("I/N")
      .otherwise("all blocks");
  command.option("--dask", options->dask, "address of a Dask scheduler, whose workers make the blocks")
      .value_name("ADDRESS")
      .otherwise("this computer");
  command.flag("--verify", options->verify, "read all files, and make what does not fit its hash again");
  command.flag("--merge", options->merge, "only join the parts of all shards");
  command.flag("--check", options->check,
               "only check SPEC: makes and reads its terrain and scenes in a temporary folder, draws the first items");
  command.flag("--keys", options->keys, "print the tables of the keys of a specification");
  command.callback([options] { become_python(*options); });
}

}  // namespace yars::tools
