#include "databuffer/log.hpp"

#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "databuffer/repeat_filter.hpp"

namespace yars::databuffer {

namespace {

constexpr std::array<std::string_view, 6> kLevels{"trace", "debug", "info", "warning", "error", "off"};
constexpr const char* kTerminalPattern = "%H:%M:%S.%e %n %l: %v";
constexpr const char* kFilePattern = "%Y-%m-%d %H:%M:%S.%e %n[%P] %l: %v";

// The file's own logger: none without a file.
std::shared_ptr<spdlog::logger>& file_logger() {
  static std::shared_ptr<spdlog::logger> logger;
  return logger;
}

struct Filtered {
  std::mutex mutex;
  RepeatFilter filter{10, 200};
};
Filtered& filtered() {
  static Filtered all;
  return all;
}

std::int64_t now_ns() {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

bool passes(std::string_view text) {
  const std::lock_guard guard(filtered().mutex);
  return filtered().filter.passes(text, now_ns());
}

std::vector<RepeatFilter::LeftOut> left_out() {
  const std::lock_guard guard(filtered().mutex);
  return filtered().filter.take_left_out(now_ns());
}

// The folders on the way to it are the user's alone too.
bool make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return true;
  if (folder.has_parent_path() && folder.parent_path() != folder && !make_folder(folder.parent_path())) return false;
  return mkdir(folder.c_str(), 0700) == 0 || std::filesystem::is_directory(folder, error);
}

std::shared_ptr<spdlog::sinks::sink> open_file(const std::string& path) {
  spdlog::file_event_handlers handlers;
  handlers.after_open = [](const spdlog::filename_t&, std::FILE* file) { fchmod(fileno(file), 0600); };
  auto sink =
      std::make_shared<spdlog::sinks::rotating_file_sink_mt>(path, kLogFileBytes, kOldLogFiles, false, handlers);
  sink->set_pattern(kFilePattern);
  return sink;
}

}  // namespace

bool start_log(const std::string& program, const std::string& level) {
  if (std::find(kLevels.begin(), kLevels.end(), level) == kLevels.end()) return false;
  auto logger = std::make_shared<spdlog::logger>(program, std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern(kTerminalPattern);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
  return true;
}

void start_log_file(const std::string& program, const std::string& folder) {
  try {
    const std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
    if (!make_folder(path)) throw spdlog::spdlog_ex("cannot make it", errno);
    // Where others may write they can plant a link under the log's name.
    if ((std::filesystem::status(path).permissions() & std::filesystem::perms::others_write) !=
        std::filesystem::perms::none)
      throw spdlog::spdlog_ex("any user may write there; name a new folder in it");
    auto sink = open_file((path / (program + ".log")).string());
    file_logger() = std::make_shared<spdlog::logger>(program, sink);
    file_logger()->flush_on(spdlog::level::info);
    spdlog::default_logger()->sinks().push_back(std::move(sink));
    // A disk that fills up later is said once too; standard error goes on.
    for (const auto& logger : {spdlog::default_logger(), file_logger()})
      logger->set_error_handler([](const std::string& problem) {
        static std::atomic<bool> said{false};
        if (!said.exchange(true)) std::fprintf(stderr, "the log file is not written: %s\n", problem.c_str());
      });
  } catch (const std::exception& problem) {
    log_warning("--log-dir: expected a folder to write to, found " + folder + ": " + problem.what() +
                "; no log file is written");
  }
}

void log_left_out() {
  for (const auto& lines : left_out()) spdlog::info("{}", lines.text());
}

void log_debug(std::string_view text) {
  spdlog::debug("{}", text);
}
void log_info(std::string_view text) {
  if (passes(text)) spdlog::info("{}", text);
}
void log_warning(std::string_view text) {
  if (passes(text)) spdlog::warn("{}", text);
}
void log_error(std::string_view text) {
  if (passes(text)) spdlog::error("{}", text);
}
void log_to_file(std::string_view text) {
  if (file_logger()) file_logger()->critical("{}", text);
}

}  // namespace yars::databuffer
