// Creation of files in folders where other users may plant files and links: a new file replaces a planted one and never
// writes through it. Also access rights of files and folders, and errors.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <iterator>
#include <string>

#include "lib/file/output_file.hpp"
#include "tests/lib/file/refused_call.hpp"
#include "tests/security/folder.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::file {
namespace {

using shm::testing::ChildProcess;
using test::refusal_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr uid_t kOtherUser = 65533;

class NewFileTest : public test::SecureFolder {
 protected:
  NewFileTest() { before_ = umask(022); }
  ~NewFileTest() override { umask(before_); }

  std::filesystem::path shared_folder(const std::string& name, mode_t mode) const {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path);
    EXPECT_EQ(chmod(path.c_str(), mode), 0);
    return path;
  }
  std::size_t entries(const std::filesystem::path& path) const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path), {}));
  }
  static bool give_to_other_user(const std::filesystem::path& path) {
    return lchown(path.c_str(), kOtherUser, kOtherUser) == 0;
  }
  mode_t before_;
};

TEST_F(NewFileTest, AFileIsReplacedAndNoTemporaryFileStays) {
  const auto path = folder_ / "out.csv";
  ASSERT_TRUE(write_file(path, "first"));
  ASSERT_TRUE(write_file(path, "second"));
  EXPECT_EQ(content_of(path), "second");
  EXPECT_EQ(entries(folder_), 1U);
}

TEST_F(NewFileTest, RightsAre0644LessTheUmaskOr0600) {
  ASSERT_TRUE(write_file(folder_ / "a", "x"));
  ASSERT_TRUE(write_file(folder_ / "b", "x", Rights::user_alone));
  EXPECT_EQ(mode_of(folder_ / "a"), 0644U);
  EXPECT_EQ(mode_of(folder_ / "b"), 0600U);
  umask(0);
  ASSERT_TRUE(write_file(folder_ / "c", "x"));
  ASSERT_TRUE(write_file(folder_ / "d", "x", Rights::user_alone));
  EXPECT_EQ(mode_of(folder_ / "c"), 0644U);
  EXPECT_EQ(mode_of(folder_ / "d"), 0600U);
  umask(077);
  ASSERT_TRUE(write_file(folder_ / "e", "x"));
  EXPECT_EQ(mode_of(folder_ / "e"), 0600U);
}

TEST_F(NewFileTest, APlantedLinkIsReplacedAndItsTargetStays) {
  for (const mode_t mode : {0700U, 0775U, 0777U, 01777U}) {
    const auto open = shared_folder("open" + std::to_string(mode), mode);
    const auto victim = write("victim", "keep this");
    const auto planted = link(open.filename() / "out.png", victim);
    ASSERT_TRUE(write_file(planted, "new"));
    EXPECT_EQ(content_of(victim), "keep this");
    EXPECT_EQ(content_of(planted), "new");
    EXPECT_TRUE(std::filesystem::is_regular_file(std::filesystem::symlink_status(planted)));
  }
}

TEST_F(NewFileTest, APlantedHardLinkIsReplacedAndItsOtherNameKeepsItsContents) {
  const auto victim = write("victim", "keep this");
  const auto open = shared_folder("open", 0775);
  std::filesystem::create_hard_link(victim, open / "out.csv");
  ASSERT_TRUE(write_file(open / "out.csv", "new"));
  EXPECT_EQ(content_of(victim), "keep this");
}

TEST_F(NewFileTest, ALinkInAFolderOfAnotherUserIsNotWrittenThrough) {
  const auto victim = write("victim", "keep this");
  const auto foreign = shared_folder("foreign", 0777);
  const auto planted = link("foreign/out.csv", victim);
  if (!give_to_other_user(planted) || !give_to_other_user(foreign)) GTEST_SKIP() << "chown needs root";
  ASSERT_TRUE(write_file(planted, "new"));
  EXPECT_EQ(content_of(victim), "keep this");
  EXPECT_EQ(content_of(planted), "new");
}

TEST_F(NewFileTest, ALinkOfAnotherUserInThePathIsRefused) {
  const auto private_folder = shared_folder("private", 0700);
  const auto planted = link("way", private_folder);
  ASSERT_TRUE(write_file(planted / "mine.csv", "x")) << "the user's own link is followed";
  if (!give_to_other_user(planted)) GTEST_SKIP() << "chown needs root";
  EXPECT_THAT(refusal_of(write_file(planted / "out.csv", "new")),
              AllOf(HasSubstr(planted.string()), HasSubstr("a link made by user 65533"), HasSubstr("name the folder")));
  EXPECT_EQ(entries(private_folder), 1U);
}

TEST_F(NewFileTest, ACircleOfLinksInThePathIsRefused) {
  link("a", folder_ / "b");
  link("b", folder_ / "a");
  EXPECT_THAT(refusal_of(write_file(folder_ / "a" / "out.csv", "new")), HasSubstr("a circle of links"));
}

TEST_F(NewFileTest, APipeFolderSocketOrLinkToADeviceIsRefused) {
  const auto pipe = fifo("pipe.png");
  EXPECT_THAT(refusal_of(write_file(pipe, "x")), AllOf(HasSubstr(pipe.string()), HasSubstr("found a pipe")));
  std::filesystem::create_directory(folder_ / "folder.png");
  EXPECT_THAT(refusal_of(write_file(folder_ / "folder.png", "x")), HasSubstr("found a folder"));
  EXPECT_THAT(refusal_of(write_file(link("to_pipe.png", pipe), "x")), HasSubstr("found a link to a pipe"));
  EXPECT_THAT(refusal_of(write_file(link("stdout.csv", "/dev/null"), "x")), HasSubstr("found a link to a device"));
  const int number = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{AF_UNIX, {}};
  const auto socket = folder_ / "socket";
  ASSERT_LT(socket.string().size(), sizeof address.sun_path);
  socket.string().copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(number, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_THAT(refusal_of(write_file(socket, "x")), HasSubstr("found a socket"));
  ::close(number);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(NewFileTest, AFullDeviceIsAnErrorAndStaysADevice) {
  EXPECT_THAT(refusal_of(write_file("/dev/full", "x")), HasSubstr("No space left"));
  EXPECT_THAT(refusal_of(write_file("/dev/full", std::string(1'000'000, 'x'))), HasSubstr("No space left"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  EXPECT_TRUE(write_file("/dev/null", "x"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(NewFileTest, TheErrorNamesAMissingFolder) {
  EXPECT_THAT(refusal_of(write_file(folder_ / "no" / "where" / "x.png", "x")),
              AllOf(HasSubstr((folder_ / "no").string()), HasSubstr("found none")));
  EXPECT_THAT(refusal_of(write_file(write("plain", "x") / "x.png", "x")), HasSubstr("a folder, found a file"));
  EXPECT_THAT(refusal_of(write_file(folder_ / std::string(300, 'x'), "x")), HasSubstr("File name too long"));
}

TEST_F(NewFileTest, AnUnfinishedFileLeavesNothing) {
  {
    auto file = NewFile::create(folder_ / "out.csv");
    ASSERT_TRUE(file);
    file->write("half");
  }
  EXPECT_EQ(entries(folder_), 0U);
}

TEST_F(NewFileTest, APipePlantedDuringTheWritingIsNotReplaced) {
  auto file = NewFile::create(folder_ / "out.csv");
  ASSERT_TRUE(file);
  file->write("whole");
  fifo("out.csv");
  EXPECT_THAT(refusal_of(file->finish()), HasSubstr("found a pipe"));
  file = NewFile::create(folder_ / "other.csv");
  EXPECT_EQ(entries(folder_), 1U) << "no temporary file stays";
}

TEST_F(NewFileTest, WithoutUnnamedFilesATemporaryNameIsUsed) {
  const auto victim = write("victim", "keep this");
  const auto planted = link("open/out.csv", victim);
  ChildProcess child([&] {
    if (!test::refuse_nameless_files()) return 77;
    if (!write_file(planted, "new")) return 1;
    {
      auto given_up = NewFile::create(folder_ / "open/second.csv");
      if (!given_up || entries(folder_ / "open") != 2) return 2;
    }
    return entries(folder_ / "open") == 1 ? 0 : 3;
  });
  const int code = child.wait();
  if (code == 77) GTEST_SKIP() << "seccomp filters are not permitted here";
  EXPECT_EQ(code, 0);
  EXPECT_EQ(content_of(planted), "new");
  EXPECT_EQ(content_of(victim), "keep this");
}

// Without random numbers each attempt still has a different name, so that a file planted at one name blocks no other.
TEST_F(NewFileTest, WithoutRandomNumbersTwoTemporaryNamesDiffer) {
  const auto open = shared_folder("open", 0700);
  ChildProcess child([&] {
    if (!test::refuse_nameless_files() || !test::refuse_call(SYS_getrandom, ENOSYS)) return 77;
    const auto first = NewFile::create(open / "first.csv");
    const auto second = NewFile::create(open / "second.csv");
    if (!first || !second) return 1;
    return entries(open) == 2 ? 0 : 2;
  });
  const int code = child.wait();
  if (code == 77) GTEST_SKIP() << "seccomp filters are not permitted here";
  EXPECT_EQ(code, 0);
}

// fdopen() first reads the mode of the descriptor by fcntl(), which the test makes fail.
TEST_F(NewFileTest, AFailureToOpenTheStreamOfADeviceIsReported) {
  ChildProcess child([&] {
    if (!test::refuse_call(SYS_fcntl, ENOMEM)) return 77;
    return refusal_of(write_file("/dev/null", "x")).find("Cannot allocate memory") != std::string::npos ? 0 : 1;
  });
  const int code = child.wait();
  if (code == 77) GTEST_SKIP() << "seccomp filters are not permitted here";
  EXPECT_EQ(code, 0);
}

TEST_F(NewFileTest, AnUnreadableLinkIsReportedByItsOwnReason) {
  std::filesystem::create_directory(folder_ / "there");
  link("way", folder_ / "there");
  ChildProcess child([&] {
    if (!test::refuse_call(SYS_readlinkat, EIO)) return 77;
    return refusal_of(write_file(folder_ / "way" / "out.csv", "x")).find("Input/output error") != std::string::npos ? 0
                                                                                                                    : 1;
  });
  const int code = child.wait();
  if (code == 77) GTEST_SKIP() << "seccomp filters are not permitted here";
  EXPECT_EQ(code, 0);
}

TEST_F(NewFileTest, AKilledWriterLeavesNothing) {
  ChildProcess child([&] {
    auto file = NewFile::create(folder_ / "out.csv");
    raise(SIGKILL);
    return 0;
  });
  EXPECT_EQ(child.wait(), -SIGKILL);
  if (const Descriptor probe(::open(folder_.c_str(), O_TMPFILE | O_RDWR, 0600)); !probe)
    GTEST_SKIP() << "this filesystem has no unnamed files";
  EXPECT_EQ(entries(folder_), 0U);
}

TEST_F(NewFileTest, MissingFoldersAreMadeWith0755LessTheUmaskOr0700) {
  ASSERT_TRUE(write_file_and_folders(folder_ / "w122" / "deep" / "n36.dt1", {}));
  EXPECT_EQ(mode_of(folder_ / "w122"), 0755U);
  umask(0);
  ASSERT_TRUE(Folder::make_private(folder_ / "state" / "logs"));
  EXPECT_EQ(mode_of(folder_ / "state"), 0700U);
  EXPECT_EQ(mode_of(folder_ / "state" / "logs"), 0700U);
}

TEST_F(NewFileTest, AFolderThatOthersMayWriteToIsNotPrivate) {
  EXPECT_THAT(refusal_of(Folder::make_private(shared_folder("all", 01777))), HasSubstr("no other user may write"));
  const auto group = shared_folder("group", 0775);
  EXPECT_TRUE(Folder::make_private(group)) << "the group is the user's own";
  if (chown(group.c_str(), geteuid(), kOtherUser) == 0 && chmod(group.c_str(), 0775) == 0) {
    EXPECT_THAT(refusal_of(Folder::make_private(group)), HasSubstr("group 65533 may"));
  }
  const auto foreign = shared_folder("foreign", 0755);
  if (!give_to_other_user(foreign)) GTEST_SKIP() << "chown needs root";
  ASSERT_EQ(chmod(folder_.c_str(), 0755), 0);
  ChildProcess child([&] {
    if (setgid(kOtherUser - 1) != 0 || setuid(kOtherUser - 1) != 0) return 77;
    return refusal_of(Folder::make_private(foreign)).find("a folder of user 65533") != std::string::npos ? 0 : 1;
  });
  EXPECT_EQ(child.wait(), 0);
}

}  // namespace
}  // namespace yars::file
