#include "lib/log/log.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "lib/file/output_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::log {

namespace {

// Key of a line: the text before ", found", with each run of digits replaced by '#'. Lines of one kind have equal keys.
std::string key_of(std::string_view line) {
  std::string key;
  for (const char letter : line.substr(0, line.find(", found"))) {
    const bool digit = letter >= '0' && letter <= '9';
    if (!digit)
      key += letter;
    else if (key.empty() || key.back() != '#')
      key += '#';
  }
  return key;
}

}  // namespace

RepeatFilter::Kind& RepeatFilter::kind_of(std::string_view line, std::int64_t now_ns) {
  std::erase_if(kinds_, [now_ns](const Kind& kind) {
    return now_ns - kind.begin_ns >= kWindow_ns && kind.suppressed.count == 0;
  });
  std::string key = key_of(line);
  const auto found = std::ranges::find(kinds_, key, &Kind::key);
  if (found != kinds_.end()) return *found;
  if (kinds_.size() + 1 >= kMaxKinds) evict_oldest();
  return kinds_.emplace_back(Kind{std::move(key), now_ns, 0, {}});
}

void RepeatFilter::evict_oldest() {
  Kind& oldest = kinds_.front();
  if (const std::uint64_t more = oldest.suppressed.count; more > 0) {
    if (evicted_.suppressed.count == 0) evicted_.begin_ns = oldest.begin_ns;
    evicted_.suppressed.line = std::move(oldest.suppressed.line);
    evicted_.suppressed.count += more;
  }
  kinds_.erase(kinds_.begin());
}

bool RepeatFilter::passes(std::string_view line, std::int64_t now_ns) {
  if (now_ns - window_begin_ns_ >= kWindow_ns) {
    window_begin_ns_ = now_ns;
    passed_in_window_ = 0;
  }
  Kind& kind = kind_of(line, now_ns);
  if (kind.passed < max_per_kind_ && passed_in_window_ < max_total_) {
    ++kind.passed;
    ++passed_in_window_;
    return true;
  }
  kind.suppressed.line = line;
  ++kind.suppressed.count;
  return false;
}

std::vector<RepeatFilter::SuppressedLines> RepeatFilter::take_suppressed(std::int64_t now_ns, bool all) {
  std::vector<SuppressedLines> counts;
  const auto take = [&](Kind& kind) {
    const bool over = all || now_ns - kind.begin_ns >= kWindow_ns;
    if (over && kind.suppressed.count > 0) counts.push_back(std::exchange(kind.suppressed, {}));
    return over;
  };
  take(evicted_);
  std::erase_if(kinds_, take);
  return counts;
}

namespace {

constexpr std::array<std::string_view, 6> kLevels{"trace", "debug", "info", "warning", "error", "off"};
constexpr const char* kTerminalPattern = "%H:%M:%S.%e %n %l: %v";
constexpr const char* kFilePattern = "%Y-%m-%d %H:%M:%S.%e %n[%P] %l: %v";

// Logger that writes to the log file only; null without a log file.
std::shared_ptr<spdlog::logger>& file_logger() {
  static std::shared_ptr<spdlog::logger> logger;
  return logger;
}

// Rate limit of info(), warning() and error(), all lines together.
struct Filtered {
  std::mutex mutex;
  RepeatFilter filter{10, 200};  // maximum number of lines per window: of one kind, of all kinds
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

std::vector<RepeatFilter::SuppressedLines> take_suppressed(SuppressedKinds which) {
  const std::lock_guard guard(filtered().mutex);
  return filtered().filter.take_suppressed(now_ns(), which == SuppressedKinds::all);
}

// spdlog sink that writes to a file::LogFile. spdlog's own file sinks are not used, because they follow a symbolic link
// at the log's path.
class FileSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit FileSink(file::LogFile file) : file_(std::move(file)) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    if (auto written = file_.append({line.data(), line.size()}); !written)
      throw spdlog::spdlog_ex(written.error().message());
  }
  void flush_() override {}

  file::LogFile file_;
};

error::Expected<std::shared_ptr<spdlog::sinks::sink>> open_file(const std::string& program, const std::string& folder) {
  auto opened = file::Folder::make_private(folder);
  if (!opened) return tl::unexpected(opened.error());
  auto file = file::LogFile::open(std::move(*opened), program, {kLogFileBytes, kOldLogFiles});
  if (!file) return tl::unexpected(file.error());
  auto sink = std::make_shared<FileSink>(std::move(*file));
  sink->set_pattern(kFilePattern);
  return sink;
}

}  // namespace

bool start(const std::string& program, const std::string& level) {
  if (std::find(kLevels.begin(), kLevels.end(), level) == kLevels.end()) return false;
  auto logger = std::make_shared<spdlog::logger>(program, std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern(kTerminalPattern);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
  return true;
}

void start_file(const std::string& program, const std::string& folder) {
  try {
    auto opened = open_file(program, folder);
    if (!opened) {
      warning("--log-dir: expected a folder to write to; " + opened.error().message() + "; no log file is written");
      return;
    }
    auto sink = std::move(*opened);
    file_logger() = std::make_shared<spdlog::logger>(program, sink);
    file_logger()->flush_on(spdlog::level::info);
    spdlog::default_logger()->sinks().push_back(std::move(sink));
    // A later write error, such as a full disk, is reported once. Output to standard error continues.
    for (const auto& logger : {spdlog::default_logger(), file_logger()})
      logger->set_error_handler([](const std::string& problem) {
        static std::atomic<bool> reported{false};
        if (!reported.exchange(true)) std::fprintf(stderr, "the log file is not written: %s\n", problem.c_str());
      });
  } catch (const std::exception& problem) {
    warning("--log-dir: expected a folder to write to, found " + folder + ": " + problem.what() +
            "; no log file is written");
  }
}

void report_suppressed(SuppressedKinds which) {
  for (const auto& lines : take_suppressed(which)) spdlog::info("{}", text::printable(lines.text()));
}

void debug(std::string_view text) {
  spdlog::debug("{}", text::printable(text));
}
void info(std::string_view text) {
  if (passes(text)) spdlog::info("{}", text::printable(text));
}
void warning(std::string_view text) {
  if (passes(text)) spdlog::warn("{}", text::printable(text));
}
void error(std::string_view text) {
  if (passes(text)) spdlog::error("{}", text::printable(text));
}
void to_file(std::string_view text) {
  if (file_logger()) file_logger()->critical("{}", text::printable(text));
}

}  // namespace yars::log
