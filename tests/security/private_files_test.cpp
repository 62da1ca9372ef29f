// Files and shared memory of a session are accessible to the user only. Nothing is written through a link that another
// user has placed under the name of a file.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mount.h>

#include <random>

#include "databuffer/session/session.hpp"
#include "display/app/frame_output_shell.hpp"
#include "flightmodel/app/udp_socket_shell.hpp"
#include "flightmodel/bridges/bridge_source.hpp"
#include "lib/log/log.hpp"
#include "radar/recording/recording_io.hpp"
#include "runtime/process.hpp"
#include "tests/security/folder.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/segment_path.hpp"

namespace yars {
namespace {

using recording::RecordingWriter;
using shm::testing::ChildProcess;
using test::refusal_of;
using ::testing::HasSubstr;

class PrivateFiles : public test::SecureFolder {
 protected:
  PrivateFiles() : session_("sec" + std::to_string(getpid())) { before_ = umask(0); }
  ~PrivateFiles() override {
    umask(before_);
    unlink(test::segment_path(session_).c_str());
  }
  const std::string session_;
  mode_t before_;  // umask before the test
};

TEST_F(PrivateFiles, ARecordingHasMode0600WhateverTheUmask) {
  const auto path = folder_ / "new.yars";
  ASSERT_TRUE(RecordingWriter::create(path, {}));
  EXPECT_EQ(mode_of(path), 0600U);
}

TEST_F(PrivateFiles, AFileOverwrittenByARecordingGetsMode0600) {
  const auto path = write("old.yars", "what was there before");
  ASSERT_EQ(mode_of(path), 0666U);
  ASSERT_TRUE(RecordingWriter::create(path, {}, recording::Existing::overwritten));
  EXPECT_EQ(mode_of(path), 0600U);
}

TEST_F(PrivateFiles, ARecordingFollowsNoPlantedLink) {
  const auto victim = write("victim", "keep this");
  const auto planted = link("flight.yars", victim);
  EXPECT_THAT(refusal_of(RecordingWriter::create(planted, {})), HasSubstr("a symbolic link"));
  EXPECT_EQ(content_of(victim), "keep this");
  EXPECT_EQ(mode_of(victim), 0666U);
}

TEST_F(PrivateFiles, ARecordingIntoAPipeThatNobodyReadsIsRefusedAtOnce) {
  EXPECT_FALSE(RecordingWriter::create(fifo("pipe"), {}));
}

TEST_F(PrivateFiles, ADeviceUnderARecordingsNameKeepsItsMode) {
  struct stat before{};
  ASSERT_EQ(stat("/dev/null", &before), 0);
  EXPECT_TRUE(RecordingWriter::create("/dev/null", {}));
  struct stat after{};
  ASSERT_EQ(stat("/dev/null", &after), 0);
  EXPECT_EQ(after.st_mode, before.st_mode);
}

TEST_F(PrivateFiles, FramesAndTheirFolderAreAccessibleToTheUserOnly) {
  runtime::set_private_umask();
  const auto folder = folder_ / "frames";
  auto writer = display::FrameWriter::create(folder);
  ASSERT_TRUE(writer) << writer.error().message();
  ASSERT_TRUE(writer->write({2, 2, 4, std::vector<std::uint8_t>(16)}, 1));
  EXPECT_EQ(mode_of(folder), 0700U);
  EXPECT_EQ(mode_of(folder / "frame_000001.png"), 0600U);
}

// The writer keeps the last 3 frames. Frame 5 cannot be written, because a folder has its name; frame 2 is then kept.
TEST_F(PrivateFiles, AFrameThatCannotBeWrittenRemovesNoOlderFrame) {
  const auto folder = folder_ / "frames";
  const imageio::Image image{2, 2, 4, std::vector<std::uint8_t>(16)};
  const auto frames = [&] {
    std::string names;
    for (int number = 1; number <= 6; ++number)
      if (std::filesystem::is_regular_file(folder / ("frame_00000" + std::to_string(number) + ".png")))
        names += std::to_string(number);
    return names;
  };
  auto writer = display::FrameWriter::create(folder, 3);
  ASSERT_TRUE(writer) << writer.error().message();
  for (int number = 1; number <= 4; ++number) ASSERT_TRUE(writer->write(image, number));
  EXPECT_EQ(frames(), "234");
  std::filesystem::create_directory(folder / "frame_000005.png");
  EXPECT_FALSE(writer->write(image, 5));
  EXPECT_EQ(frames(), "234");
  ASSERT_TRUE(writer->write(image, 3)) << "written again, frame 3 becomes the newest";
  EXPECT_EQ(frames(), "234");
  ASSERT_TRUE(writer->write(image, 6));
  EXPECT_EQ(frames(), "346");
}

TEST_F(PrivateFiles, FramesReturnToAFolderThatWasReplaced) {
  const auto folder = folder_ / "frames";
  const imageio::Image image{2, 2, 4, std::vector<std::uint8_t>(16)};
  auto writer = display::FrameWriter::create(folder, 2);
  ASSERT_TRUE(writer) << writer.error().message();
  ASSERT_TRUE(writer->write(image, 1));
  std::filesystem::remove_all(folder);
  ASSERT_EQ(mkdir(folder.c_str(), 0700), 0);
  for (int number = 2; number <= 4; ++number) ASSERT_TRUE(writer->write(image, number));
  EXPECT_FALSE(std::filesystem::exists(folder / "frame_000002.png")) << "of the newest 2 frames";
  EXPECT_TRUE(std::filesystem::exists(folder / "frame_000004.png"));
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(writer->write(image, 5)) << "a folder that is missing is made again";
  EXPECT_EQ(mode_of(folder), 0700U);
  EXPECT_TRUE(std::filesystem::exists(folder / "frame_000005.png"));
}

TEST_F(PrivateFiles, FramesDoNotReturnToAFolderThatOthersMayWrite) {
  const auto folder = folder_ / "frames";
  const imageio::Image image{2, 2, 4, std::vector<std::uint8_t>(16)};
  auto writer = display::FrameWriter::create(folder);
  ASSERT_TRUE(writer) << writer.error().message();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  ASSERT_EQ(chmod(folder.c_str(), 01777), 0);
  EXPECT_THAT(refusal_of(writer->write(image, 1)), HasSubstr("no other user may write"));
  ASSERT_EQ(chmod(folder.c_str(), 0700), 0);
  EXPECT_TRUE(writer->write(image, 2)) << "each frame tries again";
}

constexpr int kNotPermitted = 77;

// Exit code of a process with a disk of its own of 256 KiB, where two of three frames of 100,000 bytes fit. 0: the
// newest two are there.
int write_frames_to_a_small_disk(const std::filesystem::path& disk) {
  if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=256k,mode=0700") != 0)
    return kNotPermitted;
  imageio::Image noise{160, 160, 4, std::vector<std::uint8_t>(std::size_t{160} * 160 * 4)};
  std::mt19937 generator(1);  // pixels that PNG cannot compress
  for (std::uint8_t& value : noise.pixels) value = static_cast<std::uint8_t>(generator());
  auto writer = display::FrameWriter::create(disk / "frames", 2);
  if (!writer) return 1;
  for (int number = 1; number <= 4; ++number)
    if (!writer->write(noise, number)) return 10 + number;
  const auto has = [&](int number) {
    return std::filesystem::exists(disk / "frames" / ("frame_00000" + std::to_string(number) + ".png"));
  };
  return !has(1) && !has(2) && has(3) && has(4) ? 0 : 2;
}

TEST_F(PrivateFiles, OnAFullDiskTheNextFrameTakesTheOldestOnesSpace) {
  const auto disk = folder_ / "disk";
  std::filesystem::create_directory(disk);
  ChildProcess child([&] { return write_frames_to_a_small_disk(disk); });
  const int code = child.wait();
  if (code == kNotPermitted) GTEST_SKIP() << "takes root";
  EXPECT_EQ(code, 0);
}

TEST_F(PrivateFiles, FramesAreNotWrittenToAFolderThatOthersMayWrite) {
  const auto open = folder_ / "open";
  std::filesystem::create_directories(open);
  ASSERT_EQ(chmod(open.c_str(), 01777), 0);
  EXPECT_THAT(refusal_of(display::FrameWriter::create(open)), HasSubstr("no other user may write"));
}

TEST_F(PrivateFiles, LogsAreNotWrittenToAFolderThatOthersMayWrite) {
  const auto victim = write("victim", "keep this");
  const auto open = folder_ / "open";
  link("open/role.log", victim);
  ASSERT_EQ(chmod(open.c_str(), 01777), 0);
  ChildProcess child([&] {
    log::start("role", "off");
    log::start_file("role", open.string());
    log::to_file("into the link");
    return 0;
  });
  ASSERT_EQ(child.wait(), 0);
  EXPECT_EQ(content_of(victim), "keep this");
}

TEST_F(PrivateFiles, ASegmentHasMode0600WhateverTheUmask) {
  const auto session = databuffer::Session::open(session_, "test");
  ASSERT_TRUE(session) << session.error().message();
  EXPECT_EQ(mode_of(test::segment_path(session_)), 0600U);
}

TEST_F(PrivateFiles, ALinkAtTheNameOfASegmentIsNotFollowed) {
  const auto victim = write("victim", "keep this");
  std::filesystem::create_symlink(victim, test::segment_path(session_));
  EXPECT_FALSE(databuffer::Session::open(session_, "test"));
  EXPECT_FALSE(databuffer::Session::open_read_only(session_));
  EXPECT_EQ(content_of(victim), "keep this");
}

TEST_F(PrivateFiles, ALinkAtTheTemporaryNameOfASegmentIsNotFollowed) {
  const auto victim = write("victim", "keep this");
  const auto building = test::segment_path(session_) + "." + std::to_string(getpid()) + ".tmp";
  std::filesystem::create_symlink(victim, building);
  (void)databuffer::Session::open(session_, "test");
  unlink(building.c_str());
  EXPECT_EQ(content_of(victim), "keep this");
}

TEST_F(PrivateFiles, APipeAtTheNameOfASegmentDoesNotHangAReader) {
  ASSERT_EQ(mkfifo(test::segment_path(session_).c_str(), 0600), 0);
  EXPECT_FALSE(databuffer::Session::open_read_only(session_));
}

TEST(PrivateSockets, ABridgeListensOnTheLoopbackAddressOnly) {
  for (const char* text : {"flightgear:0", "jsbsim:0", "dis:0"}) {
    const auto source = flightmodel::bridges::open_bridge(text);
    ASSERT_TRUE(source) << source.error().message();
    const auto socket = flightmodel::UdpSocket::listen(source->host, source->port);
    ASSERT_TRUE(socket) << socket.error().message();
    EXPECT_EQ(socket->endpoint().address, "127.0.0.1") << text;
  }
}

}  // namespace
}  // namespace yars
