#include "shm/segment.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "lib/error/error.hpp"
#include "shm/segment_file.hpp"

namespace yars::shm {

thread_local CreationStep creation_step = nullptr;

namespace {

using error::Expected;
using error::fail;

// Maximum number of attempts to attach or create. An attempt that meets a leaving process pauses 1 ms. Leaving takes
// far less than the resulting 2 s.
constexpr int kAttempts = 2000;
// [ns] 2 s: time for which a full /dev/shm is tolerated, so that other creators can release their memory.
constexpr std::int64_t kMemoryPatience_ns = 2'000'000'000;
constexpr std::int64_t kMemoryPause_ns = 20'000'000;  // 20 ms: between two attempts with a full /dev/shm
constexpr std::size_t kParticipation = 0;             // byte that every participant read-locks

void step(const char* what) {
  if (creation_step != nullptr) creation_step(what);
}

void sleep_ns(std::int64_t duration_ns) {
  const timespec pause{0, static_cast<long>(duration_ns)};
  nanosleep(&pause, nullptr);
}

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

// False if /dev/shm would be too small without any other file.
bool could_ever_hold(std::uint64_t bytes) {
  struct statvfs space{};
  return statvfs(kSegmentFolder, &space) != 0 || space.f_blocks == 0 || space.f_blocks * space.f_frsize >= bytes;
}

std::string file_name_of(const std::string& name) {
  return "yars." + std::to_string(geteuid()) + "." + name;
}

// Removes temporary files of dead creators. Such a file has no lock, or its temporary name is a second name of the
// segment's file.
void remove_dead_temporaries(const std::string& file_name) {
  DIR* folder = opendir(kSegmentFolder);
  if (folder == nullptr) return;
  const std::string prefix = file_name + ".";
  while (const dirent* entry = readdir(folder)) {
    const std::string found = entry->d_name;
    if (!found.starts_with(prefix) || !found.ends_with(".tmp")) continue;
    auto file = SegmentFile::open(found, SegmentFile::Access::read_write);
    if (!file) continue;
    if (file->is_at(path_of(file_name)) || (file->lock(kParticipation, LockKind::write) && file->is_at(path_of(found))))
      unlink(path_of(found).c_str());
  }
  closedir(folder);
}

std::string text_of(const LayoutIdentity& layout) {
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "layout version %" PRIu32 ", %" PRIu64 " bytes, record hash %016" PRIx64,
                layout.version, layout.size, layout.hash);
  return text.data();
}

Expected<void> check_owner(const SegmentFile& file, const std::string& file_name) {
  const struct stat status = file.status();
  if (status.st_uid == geteuid()) return {};
  return fail(path_of(file_name), "a file of user " + std::to_string(geteuid()),
              "a file of user " + std::to_string(status.st_uid),
              "ask that user to remove it, or choose another --session");
}

// Checks the header. Memory after the header may be read only if this check has succeeded.
Expected<void> check_layout(const SegmentFile& file, const std::string& file_name, const LayoutIdentity& wanted) {
  const std::string what_to_do = "end the programs of the other build, or choose another --session";
  if (file.size() < sizeof(SegmentHeader))
    return fail(path_of(file_name), text_of(wanted), std::to_string(file.size()) + " bytes without a header",
                what_to_do);
  const auto* header = static_cast<const SegmentHeader*>(file.memory());
  if (header->magic.load(std::memory_order_acquire) != kSegmentMagic)
    return fail(path_of(file_name), text_of(wanted), "a file that is not a YARS segment", what_to_do);
  const LayoutIdentity found{header->layout_version.load(), header->size.load(), header->hash.load()};
  if (found.version == wanted.version && found.size == wanted.size && found.hash == wanted.hash &&
      file.size() >= wanted.size)
    return {};
  return fail(path_of(file_name), text_of(wanted),
              text_of(found) + " in a file of " + std::to_string(file.size()) + " bytes", what_to_do);
}

tl::unexpected<error::Error> system_failure(const std::string& file_name, std::string expected, int error) {
  const bool full = error == ENOSPC || error == ENOMEM;
  return fail(
      path_of(file_name), std::move(expected), std::strerror(error),
      full ? "delete files in /dev/shm (df /dev/shm shows its use), or enlarge it (mount -o remount,size=256M /dev/shm)"
           : "check the permissions of /dev/shm");
}

void write_header(void* memory, const LayoutIdentity& layout) {
  auto* header = static_cast<SegmentHeader*>(memory);
  header->size.store(layout.size);
  step("header size");
  header->hash.store(layout.hash);
  step("header hash");
  header->layout_version.store(layout.version);
  step("header version");
  header->magic.store(kSegmentMagic, std::memory_order_release);
  step("header magic");
}

// Ends participation. True: this process was the last participant and has unlinked the file. Several processes may
// leave at once. Each releases its read lock first, so that the last process obtains the write lock.
bool leave(SegmentFile& file, const std::string& file_name) {
  file.lock(kParticipation, LockKind::none);
  step("participation given up");
  const bool last = file.lock(kParticipation, LockKind::write) && file.is_at(path_of(file_name));
  step("alone");
  if (last) unlink(path_of(file_name).c_str());
  step("unlinked");
  return last;
}

// Describes a file that exists but cannot be opened as a segment; `error` is the errno value.
tl::unexpected<error::Error> describe_open_error(const std::string& file_name, int error) {
  struct stat there{};
  if (lstat(path_of(file_name).c_str(), &there) != 0 || (S_ISREG(there.st_mode) && there.st_uid == geteuid()))
    return system_failure(file_name, "a segment that can be opened", error);
  const std::string owner = "user " + std::to_string(there.st_uid);
  return fail(
      path_of(file_name), "a segment of user " + std::to_string(geteuid()),
      file::name_of_kind(there.st_mode) + (" of " + owner),
      (there.st_uid == geteuid() ? "remove it" : "ask " + owner + " to remove it") + ", or choose another --session");
}

// Why there is no session of this name: another user's has it, which can be seen in /dev/shm, but not be opened; else
// `otherwise`.
tl::unexpected<error::Error> describe_absence(const std::string& name, tl::unexpected<error::Error> otherwise) {
  DIR* folder = opendir(kSegmentFolder);
  std::optional<std::string> other;
  while (const dirent* entry = folder != nullptr ? readdir(folder) : nullptr) {
    const std::string_view found = entry->d_name;
    if (!found.starts_with("yars.") || !found.ends_with("." + name) || found.size() < 7 + name.size()) continue;
    const std::string_view user = found.substr(5, found.size() - 5 - name.size() - 1);
    if (!user.empty() && user.find_first_not_of("0123456789") == std::string_view::npos) other = user;
  }
  if (folder != nullptr) closedir(folder);
  if (other)
    return fail("session " + name, "a running session of user " + std::to_string(geteuid()),
                "none of that user, but one of user " + *other,
                "run the command as user " + *other + ", or name another session with --session");
  return otherwise;
}

// No set runs in the session; for a program that has no option --session of its own.
tl::unexpected<error::Error> describe_no_set(const std::string& name, std::string found) {
  return fail("session " + name, "a running session", std::move(found),
              "start the set with --session " + name +
                  ", or give the name of a session that runs (`yars --session NAME status`)");
}

using Attempt = Expected<std::optional<SegmentFile>>;  // nullopt: try again

// Maps a file in which this process takes part, and checks its layout. On an error it no longer takes part.
Attempt map_checked(SegmentFile file, const std::string& file_name, const LayoutIdentity& layout) {
  const auto usable = file.map() ? check_layout(file, file_name, layout)
                                 : Expected<void>(system_failure(file_name, "a segment that can be mapped", errno));
  if (usable) return file;
  leave(file, file_name);
  return tl::unexpected(usable.error());
}

// Attaches to the file with this name. A leftover (a file without any lock) is unlinked.
Attempt attach(const std::string& file_name, const LayoutIdentity& layout) {
  auto file = SegmentFile::open(file_name, SegmentFile::Access::read_write);
  if (!file) {
    if (errno == ENOENT) return std::nullopt;
    return describe_open_error(file_name, errno);
  }
  if (const auto owned = check_owner(*file, file_name); !owned) return tl::unexpected(owned.error());
  if (file->lock(kParticipation, LockKind::write)) {
    step("leftover locked");
    if (file->is_at(path_of(file_name))) unlink(path_of(file_name).c_str());
    step("leftover unlinked");
    return std::nullopt;
  }
  // Another process participates, or has write-locked the file: as the last participant that leaves, or because it
  // found the same leftover. While a write lock exists, the read lock fails.
  if (!file->lock(kParticipation, LockKind::read) || !file->is_at(path_of(file_name))) {
    sleep_ns(1'000'000);
    return std::nullopt;
  }
  return map_checked(std::move(*file), file_name, layout);
}

// Attaches to a segment that has participants but no name. nullopt: no such segment was found.
Attempt rejoin(const std::string& file_name, const LayoutIdentity& layout) {
  for (const std::string& path : nameless_files(path_of(file_name))) {
    auto file = SegmentFile::reopen(path, SegmentFile::Access::read_write);
    // A segment without participants has ended. If the read lock fails, its last participant is leaving.
    if (!file || file->could_write_lock(kParticipation) || !file->lock(kParticipation, LockKind::read)) continue;
    if (file->map() && check_layout(*file, file_name, layout)) return file;
  }
  return std::nullopt;
}

// Maps and fills the allocated memory; `error` is the errno value of the allocation, 0 for success.
Expected<void> build(SegmentFile& file, const std::string& file_name, const LayoutIdentity& layout,
                     Segment::Initialize initialize, int error) {
  if (error != 0) return system_failure(file_name, std::to_string(layout.size) + " bytes of shared memory", error);
  if (!file.map()) return system_failure(file_name, "shared memory that can be mapped", errno);
  step("mapped");
  initialize(file.memory());
  step("initialized");
  write_header(file.memory(), layout);
  return {};
}

// Builds a segment without a name and gives it the name. nullopt: try again. Causes: another process gave the name to
// its own segment first; another process took this file for a leftover and locked it first; /dev/shm is full and
// `memory_may_free` is true.
// `memory_may_free`: a full /dev/shm is not yet an error, because other creators may still free memory.
Attempt create(const std::string& file_name, const LayoutIdentity& layout, Segment::Initialize initialize,
               bool memory_may_free) {
  auto file = SegmentFile::create(file_name);
  if (!file) return system_failure(file_name, "a new file in /dev/shm", errno);
  step("created");
  const bool locked = file->lock(kParticipation, LockKind::read);
  step("locked");
  const int error = locked ? file->allocate(layout.size) : 0;
  step("allocated");
  const auto built = locked ? build(*file, file_name, layout, initialize, error) : Expected<void>{};
  const bool linked = locked && built && file->link_as(file_name);
  const int problem = errno;
  step("linked");
  // A nameless file with a lock would look like a segment that has lost its name.
  if (!linked) file->lock(kParticipation, LockKind::none);
  file->remove_temporary();
  step("temporary removed");
  if (error == ENOSPC && memory_may_free && could_ever_hold(layout.size)) {
    sleep_ns(kMemoryPause_ns);
    return std::nullopt;
  }
  if (!built) return tl::unexpected(built.error());
  if (linked) return file;
  if (locked && problem != EEXIST) return system_failure(file_name, "a name for a new file in /dev/shm", problem);
  return std::nullopt;
}

}  // namespace

struct Segment::Core {
  std::string file_name;
  SegmentFile file;
  bool writable;
  bool created;
  // Bit n: this object holds the lock on byte n. Needed, because the operating system grants an object the same lock
  // repeatedly.
  std::atomic<std::uint64_t> held_bytes{0};

  SegmentHeader& header() { return *static_cast<SegmentHeader*>(file.memory()); }
};

Segment::Segment(std::unique_ptr<Core> core) : core_(std::move(core)) {}
Segment::Segment(Segment&&) noexcept = default;
Segment& Segment::operator=(Segment&& other) noexcept {
  std::swap(core_, other.core_);
  return *this;
}

Expected<Segment> Segment::open(const std::string& name, const LayoutIdentity& layout, Initialize initialize) {
  const std::string file_name = file_name_of(name);
  remove_dead_temporaries(file_name);
  const std::int64_t begin_ns = now_ns();
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Attempt joined = attach(file_name, layout);
    if (joined && !*joined) joined = rejoin(file_name, layout);
    if (!joined) return tl::unexpected(joined.error());
    if (*joined) return Segment(std::unique_ptr<Core>(new Core{file_name, std::move(**joined), true, false}));
    // Programs that start together each build a segment, and only one of these segments gets the name. /dev/shm may
    // have space for one segment but not for all. For kMemoryPatience_ns ENOSPC is therefore tolerated.
    Attempt made = create(file_name, layout, initialize, now_ns() - begin_ns < kMemoryPatience_ns);
    if (!made) return tl::unexpected(made.error());
    if (*made) return Segment(std::unique_ptr<Core>(new Core{file_name, std::move(**made), true, true}));
  }
  return fail(path_of(file_name), "a segment to attach to or to create", "programs that keep creating and leaving it",
              "end the programs that use this session, or choose another --session");
}

Expected<Segment> Segment::join(const std::string& name, const LayoutIdentity& layout) {
  const std::string file_name = file_name_of(name);
  Attempt joined = std::nullopt;
  if (auto file = SegmentFile::open(file_name, SegmentFile::Access::read_write)) {
    if (const auto owned = check_owner(*file, file_name); !owned) return tl::unexpected(owned.error());
    // Before the read lock is taken: that lock would keep a set that just starts from replacing a leftover.
    if (file->could_write_lock(kParticipation)) return describe_no_set(name, "a leftover: its programs have died");
    if (!file->lock(kParticipation, LockKind::read) || !file->is_at(path_of(file_name)))
      return fail("session " + name, "a running session", "one that is just ending", "try again");
    joined = map_checked(std::move(*file), file_name, layout);
  } else if (errno == ENOENT) {
    joined = rejoin(file_name, layout);
  } else {
    return describe_open_error(file_name, errno);
  }
  if (!joined) return tl::unexpected(joined.error());
  if (*joined) return Segment(std::unique_ptr<Core>(new Core{file_name, std::move(**joined), true, false}));
  return describe_absence(name, describe_no_set(name, "none: no such session runs"));
}

Expected<Segment> Segment::open_read_only(const std::string& name, const LayoutIdentity& layout) {
  const std::string file_name = file_name_of(name);
  auto file = SegmentFile::open(file_name, SegmentFile::Access::read_only);
  if (!file && errno != ENOENT) return describe_open_error(file_name, errno);
  for (const std::string& path : file ? std::vector<std::string>{} : nameless_files(path_of(file_name))) {
    file = SegmentFile::reopen(path, SegmentFile::Access::read_only);
    if (file && !file->could_write_lock(kParticipation)) break;
    file.reset();
  }
  if (!file)
    return describe_absence(name,
                            fail("session " + name, "a running session", "none of that name",
                                 "start it (scripts/start --session " + name + "), or name another with --session"));
  if (const auto owned = check_owner(*file, file_name); !owned) return tl::unexpected(owned.error());
  if (file->could_write_lock(kParticipation))
    return fail("session " + name, "a running session", "a leftover: all its programs have died",
                "start the session again; the leftover is then replaced");
  if (!file->map()) return system_failure(file_name, "a segment that can be mapped", errno);
  if (const auto matches = check_layout(*file, file_name, layout); !matches) return tl::unexpected(matches.error());
  return Segment(std::unique_ptr<Core>(new Core{file_name, std::move(*file), false, false}));
}

Segment::~Segment() {
  if (!core_ || !core_->writable) return;
  for (std::size_t byte = 1; byte < kLockBytes; ++byte) unlock(byte);
  const std::string file_name = core_->file_name;
  const bool last = leave(core_->file, file_name);
  core_.reset();
  if (last) remove_dead_temporaries(file_name);
}

void* Segment::memory() {
  YARS_REQUIRE(core_->writable, ==, true);
  return core_->file.memory();
}
const void* Segment::memory() const {
  return core_->file.memory();
}
bool Segment::writable() const {
  return core_->writable;
}
bool Segment::created() const {
  return core_->created;
}
bool Segment::has_name() const {
  return core_->file.is_at(path_of(core_->file_name));
}

bool Segment::try_lock(std::size_t byte) {
  YARS_REQUIRE(byte, <, kLockBytes);
  if (!core_->writable) return false;
  const std::uint64_t bit = std::uint64_t{1} << byte;
  if ((core_->held_bytes.fetch_or(bit) & bit) != 0) return false;
  if (!core_->file.lock(byte, LockKind::write)) {
    core_->held_bytes.fetch_and(~bit);
    return false;
  }
  core_->header().holder_pid[byte].store(getpid(), std::memory_order_release);
  return true;
}

void Segment::unlock(std::size_t byte) {
  YARS_REQUIRE(byte, <, kLockBytes);
  const std::uint64_t bit = std::uint64_t{1} << byte;
  if ((core_->held_bytes.load() & bit) == 0) return;
  core_->header().holder_pid[byte].store(0, std::memory_order_release);
  core_->file.lock(byte, LockKind::none);
  core_->held_bytes.fetch_and(~bit);
}

bool Segment::is_locked(std::size_t byte) const {
  YARS_REQUIRE(byte, <, kLockBytes);
  const bool ours = ((core_->held_bytes.load() >> byte) & 1U) != 0;
  return ours || !core_->file.could_write_lock(byte);
}

std::int32_t Segment::holder_pid(std::size_t byte) const {
  return static_cast<const SegmentHeader*>(core_->file.memory())->holder_pid[byte].load(std::memory_order_acquire);
}

}  // namespace yars::shm
