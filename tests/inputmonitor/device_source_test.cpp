// Device sources, with a FIFO in place of a device: it appears, sends records, disappears and appears again. Also
// recordings of a device as a file, groups of sources, and a folder that is searched for devices.
#include "inputmonitor/device_source.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "inputmonitor/event_source.hpp"
#include "inputmonitor/source_choice.hpp"
#include "tests/inputmonitor/device_support.hpp"

namespace yars::inputmonitor {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kMaps = R"(( Devices `(
  ( Device "panel" :buttons `( ( Button "button 1" "tdc press" ) ( Button "button 2" "pb 13" ) )
    :axes `( ( Axis "ABS_X" tdcX :low -100 :high 100 :deadZone 0 ) ) ) ) ))";

class Fifo : public ::testing::Test {
 protected:
  Fifo() {
    std::string name = (std::filesystem::temp_directory_path() / "yars_device_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    path_ = folder_ / "panel";
    maps_ = std::make_shared<const std::vector<radar::Device>>(maps_of(kMaps));
  }
  ~Fifo() override {
    unplug();
    std::filesystem::remove_all(folder_);
  }

  void make_fifo() { ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0); }
  std::unique_ptr<DeviceSource> source(const std::string& map_name = {}) {
    auto made = DeviceSource::create(path_, map_name, maps_);
    EXPECT_TRUE(made) << made.error().message();
    return made ? std::move(*made) : nullptr;
  }
  // Requires that the source has opened the FIFO; else open() fails.
  void plug_in() {
    writer_ = open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(writer_, 0);
  }
  void unplug() {
    if (writer_ >= 0) close(writer_);
    writer_ = -1;
  }
  void write_bytes(const std::byte* bytes, std::size_t count) const {
    ASSERT_EQ(write(writer_, bytes, count), ssize_t(count));
  }
  void send(const std::vector<RawEvent>& events) const {
    const auto bytes = bytes_of(events);
    write_bytes(bytes.data(), bytes.size());
  }
  std::vector<std::string> take_after(EventSource& source, std::int64_t milliseconds) {
    now_ns_ += milliseconds * kMillisecond_ns;
    return texts_of(source.take({now_ns_, 0}));
  }
  static std::string report(EventSource& source) {
    std::string all;
    for (const Notice& notice : source.notices()) all += (notice.is_warning ? "! " : "") + notice.text + "\n";
    return all;
  }

  std::filesystem::path folder_;
  std::filesystem::path path_;
  DeviceMaps maps_;
  int writer_ = -1;
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST_F(Fifo, RecordsThatAreWrittenBecomeEvents) {
  make_fifo();
  const auto panel = source();
  EXPECT_THAT(take_after(*panel, 20), IsEmpty()) << "no writer yet";
  plug_in();
  send({key(0x121, 1), kReport, key(0x121, 0), kReport, axis(ABS_X, 50), kReport});
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("pb 13", "tdc 0.5 0"));
  EXPECT_THAT(report(*panel), HasSubstr("uses the map panel"));
}

TEST_F(Fifo, AnIncompleteRecordWaitsForItsRest) {
  make_fifo();
  const auto panel = source();
  plug_in();
  const auto bytes = bytes_of({key(0x121, 1)});
  write_bytes(bytes.data(), 13);
  EXPECT_THAT(take_after(*panel, 20), IsEmpty());
  write_bytes(bytes.data() + 13, bytes.size() - 13);
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("pb 13"));
}

TEST_F(Fifo, TheEndOfTheWriterReleasesControlsAndAnotherWriterMayFollow) {
  make_fifo();
  const auto panel = source();
  plug_in();
  const auto bytes = bytes_of({key(0x121, 1)});
  send({key(0x120, 1), axis(ABS_X, 100)});
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("tdc press", "tdc 1 0"));
  write_bytes(bytes.data(), 13);
  unplug();
  EXPECT_THAT(take_after(*panel, 20), IsEmpty()) << "only an incomplete record came";
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("tdc release", "tdc 0 0"));
  take_after(*panel, 300);
  plug_in();
  send({key(0x121, 1)});
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("pb 13")) << "the incomplete record is discarded";
}

TEST_F(Fifo, AnUnpluggedDeviceReleasesItsControlsAndIsReported) {
  make_fifo();
  const auto panel = source();
  plug_in();
  send({key(0x120, 1), axis(ABS_X, 100)});
  take_after(*panel, 20);
  report(*panel);
  unplug();
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("tdc release", "tdc 0 0"));
  EXPECT_THAT(report(*panel), HasSubstr("! " + path_.string() + " is disconnected; input-monitor waits for it"));
}

TEST_F(Fifo, ADeletedAndRecreatedFifoIsOpenedAgain) {
  make_fifo();
  const auto panel = source();
  plug_in();
  send({key(0x120, 1)});
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("tdc press"));
  std::filesystem::remove(path_);
  EXPECT_THAT(take_after(*panel, 300), ElementsAre("tdc release")) << "although its writer still has it open";
  report(*panel);
  EXPECT_THAT(take_after(*panel, 300), IsEmpty());
  EXPECT_THAT(report(*panel), IsEmpty()) << "reported once";
  unplug();
  make_fifo();
  EXPECT_THAT(take_after(*panel, 300), IsEmpty());
  EXPECT_THAT(report(*panel), HasSubstr("uses the map panel"));
  plug_in();
  send({key(0x121, 1)});
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("pb 13"));
}

TEST_F(Fifo, AMissingDeviceIsOpenedWhenItAppears) {
  const auto panel = source();
  EXPECT_THAT(report(*panel), HasSubstr("is missing; input-monitor waits for it"));
  EXPECT_THAT(take_after(*panel, 300), IsEmpty());
  make_fifo();
  take_after(*panel, 300);
  plug_in();
  send({key(0x121, 1)});
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("pb 13"));
}

TEST_F(Fifo, OneTakeReadsALimitedNumberOfRecords) {
  make_fifo();
  const auto panel = source();
  plug_in();
  std::vector<RawEvent> flood;
  for (int i = 0; i < 1000; ++i) flood.push_back(key(0x121, i % 2));
  send(flood);
  std::size_t takes = 0;
  std::size_t events = 0;
  for (std::size_t found = 1; takes < 100; ++takes) {
    found = take_after(*panel, 0).size();
    EXPECT_LE(found, 128U);
    events += found;
  }
  EXPECT_EQ(events, std::size_t(kPressBurst));
  take_after(*panel, 300);
  EXPECT_THAT(report(*panel), HasSubstr("440 presses dropped"));
}

TEST_F(Fifo, LostEventsReleaseControlsAndAreReported) {
  make_fifo();
  const auto panel = source();
  plug_in();
  send({key(0x120, 1), kReport, kDropped, key(0x121, 1), kReport, key(0x121, 1), kReport});
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("tdc press", "tdc release", "pb 13"));
  take_after(*panel, 300);
  EXPECT_THAT(report(*panel), HasSubstr("lost events, 1 times"));
}

TEST_F(Fifo, ReleaseReleasesAllControls) {
  make_fifo();
  const auto panel = source();
  plug_in();
  send({key(0x120, 1), axis(ABS_X, -100)});
  take_after(*panel, 20);
  EXPECT_THAT(texts_of(panel->release()), ElementsAre("tdc release", "tdc 0 0"));
}

TEST_F(Fifo, APlainFileOfRecordsIsPlayedOnce) {
  const auto bytes = bytes_of({key(0x121, 1), key(0x121, 0)});
  std::ofstream(path_, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  const auto panel = source();
  EXPECT_THAT(take_after(*panel, 20), ElementsAre("pb 13"));
  for (int i = 0; i < 3; ++i) EXPECT_THAT(take_after(*panel, 300), IsEmpty());
  EXPECT_THAT(report(*panel), HasSubstr("was read to its end"));
}

TEST_F(Fifo, AnUnknownMapOrAFileThatIsNoDeviceIsRefused) {
  make_fifo();
  const auto message = [this](const std::filesystem::path& path, const std::string& map) {
    const auto made = DeviceSource::create(path, map, maps_);
    EXPECT_FALSE(made);
    return made ? std::string() : made.error().message();
  };
  EXPECT_THAT(message(path_, "nobody"), HasSubstr("\"nobody\""));
  EXPECT_THAT(message(folder_ / "absent", "nobody"), HasSubstr("\"nobody\""));
  EXPECT_THAT(message("/dev/null", ""), HasSubstr("an input device"));
  EXPECT_THAT(message(folder_, ""), HasSubstr("an input device"));
  maps_ = std::make_shared<const std::vector<radar::Device>>(shipped_maps());
  EXPECT_THAT(message(path_, ""), HasSubstr("evdev:PATH,NAME")) << "a FIFO does not determine its map";
}

TEST_F(Fifo, AGroupReadsAllItsSources) {
  make_fifo();
  std::vector<std::unique_ptr<EventSource>> sources;
  sources.push_back(source());
  sources.push_back(*DeviceSource::create(folder_ / "absent", {}, maps_));
  SourceGroup group(std::move(sources));
  std::vector<pollfd> wanted;
  EXPECT_TRUE(group.add_descriptors(wanted));
  EXPECT_EQ(wanted.size(), 1U);
  plug_in();
  send({key(0x121, 1)});
  group.wait({now_ns_, 0}, 20'000);  // returns when the descriptor is readable
  EXPECT_THAT(take_after(group, 20), ElementsAre("pb 13"));
  EXPECT_FALSE(group.ended());
  EXPECT_THAT(report(group), HasSubstr("absent is missing"));
}

// The names are those of devices in /dev/input. With several maps a FIFO has no fitting map and is not opened.
TEST_F(Fifo, AFolderWithoutDevicesGivesNoEvents) {
  ASSERT_EQ(mkfifo((folder_ / "event7").c_str(), 0600), 0);
  std::ofstream(folder_ / "event8") << "text";
  std::ofstream(folder_ / "mouse0") << "text";
  maps_ = std::make_shared<const std::vector<radar::Device>>(shipped_maps());
  FoundDevicesSource found(folder_, maps_, {});
  EXPECT_THAT(take_after(found, 20), IsEmpty());
  EXPECT_THAT(report(found), IsEmpty());
}

// With a single map the map also applies to a FIFO, so that a FIFO can be found, lost and found again.
TEST_F(Fifo, NewDevicesInAFolderAreOpened) {
  path_ = folder_ / "event7";
  FoundDevicesSource found(folder_, maps_, {});
  EXPECT_THAT(take_after(found, 1000), IsEmpty());
  make_fifo();
  take_after(found, 1000);
  plug_in();
  send({key(0x120, 1)});
  EXPECT_THAT(take_after(found, 20), ElementsAre("tdc press"));
  unplug();
  EXPECT_THAT(take_after(found, 20), ElementsAre("tdc release"));
  EXPECT_THAT(take_after(found, 1000), IsEmpty());
  plug_in();
  send({key(0x121, 1)});
  EXPECT_THAT(take_after(found, 20), ElementsAre("pb 13"));
}

TEST_F(Fifo, ADeviceOfAnotherSourceIsNotOpened) {
  path_ = folder_ / "event7";
  make_fifo();
  FoundDevicesSource found(folder_, maps_, {path_});
  take_after(found, 1000);
  EXPECT_EQ(open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC), -1) << "no reader has opened the FIFO";
}

TEST(DevicePaths, AreInTheOrderOfTheirNumbers) {
  std::string name = (std::filesystem::temp_directory_path() / "yars_device_XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(name.data());
  for (const char* file : {"event10", "event2", "event", "event2x", "js0", "mice"}) std::ofstream(folder / file) << "";
  EXPECT_THAT(device_paths(folder), ElementsAre(folder / "event2", folder / "event10"));
  std::filesystem::remove_all(folder);
  EXPECT_THAT(device_paths(folder), IsEmpty());
}

}  // namespace
}  // namespace yars::inputmonitor
