// Tests of programs' logs: standard error ("the terminal") and the file of --log-dir.
#include "lib/log/log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "runtime/program.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::runtime {
namespace {

using shm::testing::ChildProcess;
using ::testing::HasSubstr;

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

mode_t mode_of(const std::filesystem::path& path) {
  struct stat status{};
  return stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

// A process has one log. Each test therefore logs in a child process, whose standard error goes to a file.
class Log : public ::testing::Test {
 protected:
  Log()
      : folder_(std::filesystem::temp_directory_path() /
                ("yars_log_" + std::to_string(getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~Log() override { std::filesystem::remove_all(folder_); }

  template <class Body>
  void write(Body body) const {
    ChildProcess child([&] {
      if (std::freopen((folder_ / "stderr").c_str(), "w", stderr) == nullptr) return 1;
      std::setvbuf(stderr, nullptr, _IONBF, 0);  // as before freopen()
      umask(0022);
      log::start("role", "info");
      body();
      return 0;
    });
    ASSERT_EQ(child.wait(), 0);
  }
  std::string terminal() const { return text_of_file(folder_ / "stderr"); }

  const std::filesystem::path folder_;
};

TEST_F(Log, WithoutAFolderWritesToTheTerminalOnly) {
  write([] { log::info("one"); });
  EXPECT_THAT(terminal(), HasSubstr("role info: one"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(Log, TheFileHasTheLinesOfTheTerminalAndTheErrorThatEndedTheProgram) {
  const auto logs = folder_ / "state" / "session";
  write([&] {
    log::start_file("role", logs);
    log::info("one");
    log::debug("two");
    print_failure("role", "three");
  });
  const auto file = text_of_file(logs / "role.log");
  EXPECT_THAT(file, HasSubstr("info: one"));
  EXPECT_THAT(file, ::testing::Not(HasSubstr("two")));
  EXPECT_THAT(file, HasSubstr("three"));
  EXPECT_THAT(terminal(), HasSubstr("role info: one"));
  EXPECT_THAT(terminal(), HasSubstr("role: three\n"));
  EXPECT_EQ(mode_of(logs), 0700u);
  EXPECT_EQ(mode_of(folder_ / "state"), 0700u);
  EXPECT_EQ(mode_of(logs / "role.log"), 0600u);
}

TEST_F(Log, IsRotatedAndTheOldestFileIsRemoved) {
  write([&] {
    log::start_file("role", folder_);
    const std::string line(64 * 1024, 'x');
    const std::size_t lines = (log::kOldLogFiles + 2) * log::kLogFileBytes / line.size();
    for (std::size_t n = 0; n < lines; ++n) log::to_file(std::to_string(n) + line);
  });
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() != ".log") continue;
    ++files;
    EXPECT_LE(entry.file_size(), log::kLogFileBytes) << entry.path();
    EXPECT_EQ(mode_of(entry.path()), 0600u) << entry.path();
  }
  EXPECT_EQ(files, log::kOldLogFiles + 1);
}

TEST_F(Log, AnUnwritableFolderGivesOneWarning) {
  std::ofstream(folder_ / "file") << "in the way";
  write([&] {
    log::start_file("role", folder_ / "file" / "logs");
    log::info("one");
    print_failure("role", "two");
  });
  const auto lines = terminal();
  EXPECT_THAT(lines, HasSubstr("warning: --log-dir: expected a folder to write to"));
  EXPECT_THAT(lines, HasSubstr("role info: one"));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3) << lines;
}

// Two senders with different positions once caused such lines: 31 MB in ten seconds.
TEST_F(Log, AFloodOfSimilarLinesIsLimitedAndCounted) {
  write([&] {
    log::start_file("role", folder_.string());
    for (int i = 0; i < 100'000; ++i) {
      log::info(i % 2 == 0 ? "put the aircraft elsewhere, " + std::to_string(i)
                           : "hears it from port " + std::to_string(i));
      if (i % 1000 == 0) log::warning("bad record " + std::to_string(i));
    }
    log::report_suppressed(log::SuppressedKinds::all);  // as a program does when it ends
  });
  EXPECT_LT(std::filesystem::file_size(folder_ / "role.log"), 20'000U);
  EXPECT_LT(terminal().size(), 20'000U);
  EXPECT_THAT(terminal(), HasSubstr("bad record 0"));
  EXPECT_THAT(terminal(), HasSubstr("bad record 99000 (and 89 more suppressed)"));
}

}  // namespace
}  // namespace yars::runtime
