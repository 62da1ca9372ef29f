// `yars note`: a line into the flight recorder of a running session; for scripts that look after it.
#include <string>

#include "databuffer/session.hpp"
#include "tools/command.hpp"
#include "tools/restart_note.hpp"

namespace yars::tools {

namespace {

struct NoteOptions {
  std::string text;
  std::string restarted;  // role; empty = a plain note
};

void note(const CommonOptions& common, const NoteOptions& options) {
  if (auto running = databuffer::Session::open_read_only(common.session); !running) give_up(running.error());
  auto session = databuffer::Session::open(common.session, "yars note");
  if (!session) give_up(session.error());
  if (options.restarted.empty())
    session->note(databuffer::NoteKind::supervision, options.text);
  else {
    session->count_restart(options.restarted);
    session->note(databuffer::NoteKind::supervision, std::string(kRestartNote) + options.text, options.restarted);
  }
}

}  // namespace

void add_note_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("note", "a line into the session's flight recorder, for `yars status`");
  auto options = std::make_shared<NoteOptions>();
  command->add_option("TEXT", options->text, "what happened; 87 characters are kept")->required();
  command->add_option("--restarted", options->restarted, "the role that was started again, and TEXT says why");
  command->callback([&common, options] { note(common, *options); });
}

}  // namespace yars::tools
