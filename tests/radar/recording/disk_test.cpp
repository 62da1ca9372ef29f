// Files of a recording: an existing file, the next file, a disk that becomes full, and a disk with free space again.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>
#include <vector>

#include "tests/radar/recording/made_recording.hpp"

namespace yars::recording {
namespace {

using test::expect_same;
using test::is_begin_of;
using test::items_of_every_kind;
using test::rest_of;
using test::same;

TEST(Recording, ReportsAFullDisk) {
  auto full = RecordingWriter::create("/dev/full", {});
  ASSERT_TRUE(full.has_value()) << full.error().message();
  const auto outcome = full->append(Gap{});
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message().find("free space on the disk"), std::string::npos) << outcome.error().message();
}

TEST(Recording, DoesNotReplaceAnExistingFileUnlessToldTo) {
  const test::TemporaryFile file;
  std::ofstream(file.path()) << "somebody's flight";
  const auto refused = RecordingWriter::create(file.path(), {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message().find("--overwrite"), std::string::npos) << refused.error().message();
  EXPECT_EQ(file.bytes(), "somebody's flight");
  EXPECT_TRUE(RecordingWriter::create(file.path(), {}, Existing::overwritten));
  EXPECT_EQ(file.bytes().find("somebody"), std::string::npos);
}

TEST(Recording, BeginsANextFileAndKeepsThePreviousOneAsBefore) {
  const test::TemporaryFile file;
  const std::filesystem::path before = file.path().string() + ".before";
  auto writer = RecordingWriter::create(file.path(), {"made.guf", "hills"});
  const auto items = items_of_every_kind(600);
  const auto append_all = [&] {
    for (const auto& item : items)
      ASSERT_TRUE(std::visit([&](const auto& record) { return writer->append(record); }, item));
  };
  append_all();
  ASSERT_TRUE(writer->begin_next());
  append_all();
  ASSERT_TRUE(writer->close());
  for (const auto& path : {before, std::filesystem::path(file.path())}) {
    auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader) << path;
    EXPECT_EQ(reader->header().terrain, "hills");
    expect_same(rest_of(*reader), items);
    EXPECT_FALSE(reader->cut_short());
  }
  std::filesystem::remove(before);
}

// A folder has the name FILE.before, so that the previous file cannot be renamed.
TEST(Recording, ReportsAnErrorOtherThanAFullDiskByItsCause) {
  const test::TemporaryFile file;
  const std::filesystem::path before = file.path().string() + ".before";
  std::filesystem::create_directories(before / "in the way");
  auto writer = RecordingWriter::create(file.path(), {});
  ASSERT_TRUE(writer) << writer.error().message();
  const auto outcome = writer->begin_next();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message().find("Is a directory"), std::string::npos) << outcome.error().message();
  EXPECT_EQ(outcome.error().message().find("space"), std::string::npos) << outcome.error().message();
  std::filesystem::remove_all(before);
}

void append_all(RecordingWriter& writer, const std::vector<RecordingItem>& items) {
  for (const auto& item : items)
    ASSERT_TRUE(std::visit([&](const auto& record) { return writer.append(record); }, item));
}

void expect_whole(const std::filesystem::path& path, const std::vector<RecordingItem>& items) {
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message();
  expect_same(rest_of(*reader), items);
  EXPECT_FALSE(reader->cut_short());
}

TEST(Recording, AFileThatCannotBeSetAsideIsSetAsideWhenItCan) {
  const test::TemporaryFile file;
  const std::filesystem::path before = file.path().string() + ".before";
  std::filesystem::create_directory(before);
  auto writer = RecordingWriter::create(file.path(), {});
  const auto items = items_of_every_kind(600);
  append_all(*writer, items);
  ASSERT_FALSE(writer->begin_next());
  for (int attempt = 0; attempt < 2; ++attempt) {
    const auto resumed = writer->resume();
    ASSERT_FALSE(resumed) << "the folder is still in the way";
    EXPECT_NE(resumed.error().message().find(before.string() + ": "), std::string::npos) << resumed.error().message();
    EXPECT_NE(resumed.error().message().find("Is a directory"), std::string::npos) << resumed.error().message();
  }
  std::filesystem::remove(before);
  ASSERT_TRUE(writer->resume());
  EXPECT_EQ(writer->files(), 2U);
  append_all(*writer, items);
  ASSERT_TRUE(writer->close());
  expect_whole(before, items);
  expect_whole(file.path(), items);
  std::filesystem::remove(before);
}

TEST(Recording, AFileThatWasRemovedOrRenamedIsBegunAgain) {
  const test::TemporaryFile file;
  const std::filesystem::path elsewhere = file.path().string() + ".elsewhere";
  auto writer = RecordingWriter::create(file.path(), {});
  const auto items = items_of_every_kind(600);
  append_all(*writer, items);
  ASSERT_TRUE(writer->flush());
  EXPECT_TRUE(writer->check_place());
  std::filesystem::rename(file.path(), elsewhere);
  std::ofstream(file.path()) << "somebody's flight";
  ASSERT_FALSE(writer->check_place());
  EXPECT_FALSE(writer->is_at_path());
  EXPECT_FALSE(writer->append(Gap{}));
  EXPECT_FALSE(writer->resume()) << "another file of this name is never replaced";
  EXPECT_EQ(file.bytes(), "somebody's flight");
  std::filesystem::remove(file.path());
  ASSERT_TRUE(writer->resume());
  append_all(*writer, items);
  ASSERT_TRUE(writer->close());
  expect_whole(file.path(), items);
  EXPECT_TRUE(RecordingReader::open(elsewhere));
  std::filesystem::remove(elsewhere);
}

TEST(Recording, AFileThatWasRemovedIsNotClosedAsIfItWereThere) {
  const test::TemporaryFile file;
  auto writer = RecordingWriter::create(file.path(), {});
  append_all(*writer, items_of_every_kind(600));
  std::filesystem::remove(file.path());
  const auto closed = writer->close();
  ASSERT_FALSE(closed);
  EXPECT_NE(closed.error().message().find("removed or renamed"), std::string::npos) << closed.error().message();
}

// Simulates a full disk: while the object exists, the process can write files of at most 40,000 bytes.
class SmallDisk {
 public:
  SmallDisk() : on_signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = 40'000;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, on_signal_);
  }

 private:
  rlimit before_{};
  void (*on_signal_)(int);
};

error::Expected<void> append_until_full(RecordingWriter& writer, const std::vector<RecordingItem>& items) {
  error::Expected<void> outcome;
  for (std::size_t i = 0; outcome && i < items.size(); ++i)
    outcome = std::visit([&](const auto& record) { return writer.append(record); }, items[i]);
  return outcome;
}

TEST(Recording, OnADiskThatBecomesFullIsReadableToItsLastWholeBlock) {
  const test::TemporaryFile file;
  auto writer = RecordingWriter::create(file.path(), {});
  std::optional<SmallDisk> disk(std::in_place);
  const auto items = items_of_every_kind(3000);
  const auto outcome = append_until_full(*writer, items);
  const auto again = writer->append(Gap{});
  const auto closed = writer->close();
  disk.reset();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message().find("free space on the disk"), std::string::npos) << outcome.error().message();
  EXPECT_FALSE(again.has_value());
  EXPECT_FALSE(closed.has_value());
  EXPECT_EQ(std::filesystem::file_size(file.path()), writer->bytes()) << "no part of a block remains in the file";
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader.has_value());
  const auto found = rest_of(*reader);
  EXPECT_GT(found.size(), 100U);
  EXPECT_TRUE(is_begin_of(found, items));
  EXPECT_TRUE(reader->cut_short());
}

TEST(Recording, ContinuesWhenTheDiskHasSpaceAgain) {
  const test::TemporaryFile file;
  auto writer = RecordingWriter::create(file.path(), {});
  std::optional<SmallDisk> disk(std::in_place);
  const auto items = items_of_every_kind(3000);
  const auto outcome = append_until_full(*writer, items);
  const auto too_early = writer->resume();
  disk.reset();
  EXPECT_FALSE(outcome.has_value());
  EXPECT_FALSE(too_early.has_value()) << "the disk is still full";
  ASSERT_TRUE(writer->resume());
  for (const auto& item : items)
    ASSERT_TRUE(std::visit([&](const auto& record) { return writer->append(record); }, item));
  ASSERT_TRUE(writer->close());
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader.has_value());
  const auto found = rest_of(*reader);
  EXPECT_FALSE(reader->cut_short());
  ASSERT_GT(found.size(), items.size());
  EXPECT_TRUE(std::equal(items.rbegin(), items.rend(), found.rbegin(), same)) << "all items after the interruption";
}

}  // namespace
}  // namespace yars::recording
