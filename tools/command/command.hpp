// Interface of the subcommands of `yars`. Each add_..._command function registers one subcommand.
// Errors: a callback that fails throws CommandFailed. yars_main prints the message as one line and returns the code.
#pragma once

#include <string>

#include "databuffer/runtime/command_line.hpp"
#include "lib/error/error.hpp"

namespace yars::tools {

struct CommandFailed {
  std::string message;  // empty: yars_main prints nothing
  int code = 1;         // 1 failure, 2 bad usage; other codes are documented at the command
};

// Throws CommandFailed with code 2 for an error of bad usage, else 1.
[[noreturn]] inline void give_up(const error::Error& error) {
  throw CommandFailed{error.message(), error.bad_usage ? 2 : 1};
}

// Options that all subcommands share. They are parsed before any callback runs.
struct CommonOptions {
  std::string session = "default";
  std::string config;  // GUF file; empty: built-in defaults
};

void add_scan_command(databuffer::Command app, const CommonOptions& common);
void add_patch_command(databuffer::Command app, const CommonOptions& common);
void add_trade_command(databuffer::Command app, const CommonOptions& common);
void add_terrain_command(databuffer::Command app, const CommonOptions& common);
void add_scene_command(databuffer::Command app, const CommonOptions& common);
void add_config_command(databuffer::Command app, const CommonOptions& common);
void add_sim_command(databuffer::Command app, const CommonOptions& common);
void add_inject_command(databuffer::Command app, const CommonOptions& common);
void add_note_command(databuffer::Command app, const CommonOptions& common);
void add_status_command(databuffer::Command app, const CommonOptions& common);
void add_watch_command(databuffer::Command app, const CommonOptions& common);
void add_record_command(databuffer::Command app, const CommonOptions& common);
void add_replay_command(databuffer::Command app, const CommonOptions& common);

}  // namespace yars::tools
