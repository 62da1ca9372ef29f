#include "tests/endtoend/process_set.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "databuffer/json/status_json.hpp"
#include "databuffer/session/session.hpp"

namespace yars::endtoend {

namespace {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

int code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// True for programs that draw. LeakSanitizer's check at the end of such a process sometimes crashes beside Mesa's
// threads. tests/display/gl checks the drawing code for leaks.
bool draws(const std::string& program) {
  const auto name = std::filesystem::path(program).filename();
  return name == "radar-display" || name == "example_host_display";
}

// `program`: a path, or a name that PATH has.
pid_t spawn(const std::string& program, const std::vector<std::string>& command, const std::filesystem::path& output,
            const std::filesystem::path& errors) {
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const bool without_leak_search = draws(program);
  const pid_t child = fork();
  // kill() with the pid -1 would reach all processes of the user.
  if (child < 0) throw std::runtime_error("cannot fork for " + program);
  if (child != 0) return child;
  const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int out = open(output.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0600);
  const int err = open(errors.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0600);
  dup2(in, 0);
  dup2(out, 1);
  dup2(err, 2);
  if (without_leak_search) setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  setenv("YARS_USER_CONFIG", "", 1);  // the file of defaults of whoever runs the tests
  execvp(program.c_str(), arguments.data());
  _exit(127);
}

// Exit code as in Finished. -1: killed after the timeout.
int wait_for(pid_t child, double timeout_s) {
  int status = 0;
  if (eventually([&] { return waitpid(child, &status, WNOHANG) == child; }, timeout_s)) return code_of(status);
  ::kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return -1;
}

std::filesystem::path fresh_folder(const std::string& name) {
  static int counter = 0;
  auto folder = std::filesystem::temp_directory_path() /
                ("yars_test_" + name + "_" + std::to_string(getpid()) + "_" + std::to_string(++counter));
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

bool eventually(const std::function<bool()>& condition, double timeout_s) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

namespace {

std::vector<std::string> words_of(const char* text) {
  std::istringstream stream(text == nullptr ? "" : text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string in_bin(const std::string& name) {
  return std::string(YARS_BIN_DIR) + "/" + name;
}

Finished run(const std::string& program, const std::vector<std::string>& command, double timeout_s) {
  const auto folder = fresh_folder("run");
  const pid_t child = spawn(program, command, folder / "output", folder / "errors");
  Finished finished;
  finished.code = wait_for(child, timeout_s);
  finished.output = read_file(folder / "output");
  finished.errors = read_file(folder / "errors");
  std::filesystem::remove_all(folder);
  return finished;
}

}  // namespace

Finished run_program(const std::vector<std::string>& command, double timeout_s) {
  return run(in_bin(command.front()), command, timeout_s);
}

Finished run_tool(const std::vector<std::string>& command, double timeout_s) {
  return run(command.front(), command, timeout_s);
}

bool tool_exists(const std::string& name) {
  return run_tool({"sh", "-c", "command -v " + name}).code == 0;
}

std::vector<std::string> faults_in(const nlohmann::json& status) {
  if (status.is_null()) return {"no status"};
  std::vector<std::string> faults;
  for (const std::string reason : status["health"]["reasons"])
    if (!reason.starts_with("too slow")) faults.push_back(reason);
  return faults;
}

ProcessSet::ProcessSet(const std::string& session)
    : session_(session + "-" + std::to_string(getpid())), folder_(fresh_folder(session)) {}

ProcessSet::~ProcessSet() {
  for (const auto& [name, pid] : pids_) ::kill(pid, SIGKILL);
  for (const auto& [name, pid] : pids_) waitpid(pid, nullptr, 0);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
  std::filesystem::remove("/dev/shm/yars." + std::to_string(getuid()) + "." + session_, ignored);
}

void ProcessSet::start(const std::string& name, std::vector<std::string> arguments) {
  std::vector<std::string> command{arguments.front(), "--session", session_};
  command.insert(command.end(), arguments.begin() + 1, arguments.end());
  command.front() = in_bin(command.front());
  const std::vector<std::string> entry = words_of(std::getenv("YARS_TEST_HOSTS"));
  command.insert(command.begin(), entry.begin(), entry.end());
  start_tool(name, command);
}

void ProcessSet::start_tool(const std::string& name, const std::vector<std::string>& command) {
  pids_[name] = spawn(command.front(), command, folder_ / (name + ".out"), folder_ / (name + ".log"));
  commands_[name] = command;
}

int ProcessSet::start_again(const std::string& name) {
  const int code = wait(name);
  start_tool(name, commands_.at(name));
  return code;
}

void ProcessSet::kill(const std::string& name, int signal) {
  ::kill(pids_.at(name), signal);
}

int ProcessSet::wait(const std::string& name, double timeout_s) {
  const int code = wait_for(pids_.at(name), timeout_s);
  pids_.erase(name);
  return code;
}

bool ProcessSet::runs(const std::string& name) {
  const auto found = pids_.find(name);
  if (found == pids_.end()) return false;
  siginfo_t info{};
  // WNOWAIT leaves an ended process to wait().
  return waitid(P_PID, static_cast<id_t>(found->second), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

std::string ProcessSet::log_of(const std::string& name) const {
  return read_file(folder_ / (name + ".log"));
}

std::string ProcessSet::output_of(const std::string& name) const {
  return read_file(folder_ / (name + ".out"));
}

std::map<std::string, int> ProcessSet::end_all() {
  for (const auto& [name, pid] : pids_) ::kill(pid, SIGTERM);
  std::map<std::string, int> codes;
  for (const auto& [name, pid] : pids_) codes[name] = wait_for(pid, 20.0);
  pids_.clear();
  return codes;
}

Finished ProcessSet::yars(std::vector<std::string> arguments, double timeout_s) const {
  arguments.insert(arguments.begin(), {"yars", "--session", session_});
  return run_program(arguments, timeout_s);
}

bool ProcessSet::is_recorded() const {
  const auto now = status();
  return !now.is_null() && now["recorder"].is_object() && now["recorder"]["writing"] == true;
}

nlohmann::json ProcessSet::status() const {
  const auto session = databuffer::Session::open_read_only(session_);
  return session ? nlohmann::json(databuffer::status_json(databuffer::status_of(*session, session_)))
                 : nlohmann::json();
}

nlohmann::json ProcessSet::watch() const {
  const auto session = databuffer::Session::open_read_only(session_);
  return session ? nlohmann::json(databuffer::watch_json(databuffer::watch_of(*session))) : nlohmann::json();
}

bool ProcessSet::wait_until(const std::function<bool(const nlohmann::json&)>& condition, double timeout_s) const {
  return eventually(
      [&] {
        const auto object = watch();
        return !object.is_null() && condition(object);
      },
      timeout_s);
}

bool ProcessSet::segment_exists() const {
  return std::filesystem::exists("/dev/shm/yars." + std::to_string(getuid()) + "." + session_);
}

std::filesystem::path shared_data() {
  const std::filesystem::path data = std::filesystem::path(YARS_SOURCE_DIR) / ".." / "shared" / "data";
  return std::filesystem::exists(data) ? std::filesystem::canonical(data) : std::filesystem::path();
}

}  // namespace yars::endtoend
