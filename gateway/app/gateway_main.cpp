// The program gateway: joins the session of this computer to those of other computers.

#include <unistd.h>

#include <filesystem>
#include <numeric>
#include <random>
#include <set>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "gateway/checks/network_check.hpp"
#include "gateway/exchange/clock_exchange.hpp"
#include "gateway/exchange/event_exchange.hpp"
#include "gateway/exchange/lockstep_exchange.hpp"
#include "gateway/exchange/model_exchange.hpp"
#include "gateway/exchange/state_exchange.hpp"
#include "gateway/exchange/world_exchange.hpp"
#include "runtime/option_text.hpp"
#include "runtime/process.hpp"
#include "runtime/processor_load.hpp"
#include "runtime/program.hpp"

namespace {

using namespace yars;
using namespace yars::gateway;

constexpr std::int64_t kPass_ns = 5'000'000;        // a tick at rate 1
constexpr std::int64_t kLockstepPass_ns = 250'000;  // the roles of a lockstep run wait for each pass
constexpr std::int64_t kMaxEnd_ns = 1'000'000'000;
constexpr std::int64_t kLockstepEnd_ns = 20'000'000;  // until the other hosts have taken what they have acknowledged
constexpr std::int64_t kSilence_ns = 10'000'000'000;  // hosts that can hear each other do so within 0.3 s

// What the gateway needs each time that it joins.
struct Joining {
  radar::NetworkSettings settings;
  std::vector<std::string> peers = {};  // addresses of other computers, which are asked
  Identity identity = {};
  dds::RejoinLimit rejoins = {};
};

// Gateway of one host: in passes of 5 ms it exchanges records between the local segment and the other hosts.
// Inputs: the local segment; samples of other hosts.
// Outputs: samples; records of other hosts in the local segment; NetworkStatus twice a second.
// Source: docs/network.md.
class Gateway {
 public:
  // `joining` must outlive the object.
  Gateway(databuffer::Session& session, const std::string& session_name, dds::Link link, const Joining& joining)
      : link_(std::move(link)),
        session_(&session),
        joining_(&joining),
        hosts_(session, &link_, joining.identity),
        roles_(session, session_name),
        context_{session, &link_, hosts_, roles_},
        maps_(joining.settings.map_rows_per_s) {
    if (!link_.writes(dds::Topic::clock))
      log::info("this host does not set the session clock: it may not write the topic clock");
    const std::uint32_t writable = writable_roles([this](dds::Topic topic) { return link_.writes(topic); });
    for (const Role role : {Role::radar_model, Role::state_machine})
      if ((writable & bit_of(role)) == 0) roles_.bar(role);
  }

  // Waits for the next pass and runs it. Probes and input events are taken as soon as they arrive.
  void step() {
    link_.wait(next_pass_ns_ - databuffer::monotonic_ns());
    hosts_.exchange_probes();
    context_.now_ns = databuffer::monotonic_ns();
    context_.take<yars_net_InputEventSample>(events_);
    if (context_.now_ns < next_pass_ns_) return;
    pass();
    const std::int64_t interval_ns = context_.lockstep ? kLockstepPass_ns : kPass_ns;
    next_pass_ns_ = std::max(next_pass_ns_ + interval_ns, context_.now_ns);
  }

  // As Participants::take_lost_handshake(). The caller then opens a new link and a new shell.
  std::string take_lost_handshake() {
    return link_.participants().take_lost_handshake(context_.now_ns,
                                                    [&](std::string_view name) { return hosts_.hears(name); });
  }

  // Runs further passes until the other hosts have what this one has sent, for 1 s at most. Without them the last tick
  // of a lockstep run would not reach a slower host.
  void finish() {
    const std::int64_t begin_ns = databuffer::monotonic_ns();
    std::int64_t unacknowledged_ns = begin_ns;  // the last time at which something was on its way
    while (hosts_.views().size() > 1 && context_.now_ns - begin_ns < kMaxEnd_ns) {
      step();
      if (!link_.is_acknowledged()) unacknowledged_ns = context_.now_ns;
      if (context_.now_ns - unacknowledged_ns > (context_.lockstep ? kLockstepEnd_ns : 0)) return;
    }
  }

 private:
  void pass() {
    session_->heartbeat();
    context_.lockstep = std::as_const(*session_).layout().lockstep.enabled.load(std::memory_order_acquire) != 0;
    hosts_.set_claims(roles_.held_roles(), clock_.owns(), session_->clock().epoch);
    hosts_.set_conflict(roles_.in_conflict());
    hosts_.exchange(context_.now_ns);
    roles_.update(hosts_, context_.now_ns);
    roles_.heartbeat();
    clock_.exchange(context_);
    lockstep_.begin_pass(context_);
    receive();
    send();
    const bool has_joined = clock_.joined() && !std::exchange(reported_joined_, true);
    if (has_joined) report_joined();
    if (reports_.is_due(has_joined, context_.now_ns)) report();
  }

  void receive() {
    states_.receive(context_);
    events_.receive(context_);
    world_.receive(context_);
    history_.receive(context_);
    maps_.receive(context_);
    if (context_.lockstep) lockstep_.receive(context_, history_.is_empty());
  }

  void send() {
    states_.send(context_);
    events_.send(context_);
    world_.send(context_);
    history_.send(context_);
    maps_.send(context_);
    if (context_.lockstep) lockstep_.send(context_);
  }

  void report_joined() const {
    if (hosts_.views().size() > 1) return log::info("joined the session clock");
    log::info("joined the session clock, alone: " +
              (joining_->peers.empty() ? "the form Network names no other computer"
                                       : "asked " + runtime::joined_by_or(joining_->peers) +
                                             ": none has answered yet; this computer goes on alone and joins them "
                                             "when they come"));
  }

  void report_messages() {
    for (const std::string& message : link_.take_messages(context_.now_ns)) log::warning("Cyclone DDS: " + message);
    for (const dds::Remark& remark : link_.participants().take_remarks(context_.now_ns)) {
      (remark.is_fault ? log::warning : log::info)(remark.text);
      if (!remark.is_fault) continue;
      reported_silence_ = true;
      session_->note(databuffer::NoteKind::loss, remark.note);
    }
    report_silence();
  }

  // Says once that no host has been heard since the start, and what to look at.
  void report_silence() {
    if (reported_silence_ || joining_->peers.empty() || hosts_.age_ns(context_.now_ns) < kSilence_ns) return;
    reported_silence_ = true;
    if (link_.counts(dds::Topic::hosts).received > 0) return;
    const int first_port = dds::first_port(joining_->settings.domain) + 10;
    log::warning("no other host has been heard in 10 s, asked " + runtime::joined_by_or(joining_->peers) +
                 "; the usual reasons: no gateway runs there, it has another session or domain, `security` is on one "
                 "side only, or a firewall closes UDP ports " +
                 std::to_string(first_port) + " to " +
                 std::to_string(first_port + 2 * joining_->settings.participants - 1));
  }

  void report() {
    report_messages();
    std::uint32_t processes = 0;
    for (const databuffer::ProcessInfo& process : session_->processes())
      if (const auto index = databuffer::counted_role(process.name)) processes |= 1U << *index;
    hosts_.set_processes(processes & shown_processes());
    databuffer::NetworkStatus status{};
    status.monotonic_ns = context_.now_ns;
    status.joined = clock_.joined() ? 1 : 0;
    status.domain = static_cast<std::uint32_t>(joining_->settings.domain);
    status.secured = joining_->settings.security.empty() ? 0 : 1;
    status.takeovers = roles_.takeovers();
    status.conflicts = roles_.conflicts();
    status.load = load_.loads({getpid()})[getpid()];
    hosts_.describe(status, context_.now_ns);
    status.topic_count = dds::kTopicCount;
    for (std::size_t i = 0; i < dds::kTopicCount; ++i) status.topics[i] = link_.counts(static_cast<dds::Topic>(i));
    session_->layout().network_status.publish(status);
  }

  dds::Link link_;
  databuffer::Session* session_;
  const Joining* joining_;
  Hosts hosts_;
  Roles roles_;
  Context context_;
  LaneNames lanes_;
  ClockExchange clock_;
  StateExchange states_{lanes_};
  EventExchange events_{lanes_};
  WorldNumbers world_numbers_;
  WorldExchange world_{world_numbers_};
  HistoryExchange history_{lanes_, world_numbers_};
  MapExchange maps_;
  LockstepExchange lockstep_;
  bool reported_joined_ = false;
  bool reported_silence_ = false;
  std::int64_t next_pass_ns_ = 0;
  Pace reports_{500'000'000};
  runtime::LoadMeter load_;
};

// Hash of a configuration's values. The folders of terrain and scenes are left out: they may differ between computers.
std::uint64_t configuration_hash(radar::RadarConfiguration configuration) {
  configuration.terrain.directory.clear();
  for (radar::Scene& scene : configuration.world.scenes)
    scene.file = std::filesystem::path(scene.file).filename().string();
  return host_id(config::print_configuration(configuration));
}

// Hash of the names and sizes of the files in a folder of elevation cells; 0: no folder.
std::uint64_t terrain_hash(const std::string& folder) {
  std::set<std::string> lines;
  std::error_code code;
  for (std::filesystem::recursive_directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code))
    if (entry->is_regular_file(code))
      lines.insert(entry->path().lexically_relative(folder).string() + ' ' + std::to_string(entry->file_size(code)) +
                   '\n');
  const std::string text = std::accumulate(lines.begin(), lines.end(), std::string());
  return text.empty() ? 0 : host_id(text);
}

std::uint64_t random_number() {
  std::random_device source;
  return std::uint64_t{source()} << 32 | source() | 1U;
}

// Number of the segment, made by the first gateway that joins it.
std::uint64_t segment_number(databuffer::Session& session) {
  auto& number = session.layout().network.segment;
  std::uint64_t none = 0;
  number.compare_exchange_strong(none, random_number());
  return number.load();
}

// Checks the settings, and leaves only the peers that can be asked. Output: those of other computers.
error::Expected<std::vector<std::string>> check(radar::NetworkSettings& settings) {
  auto computer = checks::check_computer(settings);
  if (!computer) return tl::unexpected(computer.error());
  for (const std::string& warning : computer->warnings) log::warning(warning);
  settings.peers = std::move(computer->known_peers);
  if (!settings.security.empty()) {
    const auto warnings = checks::check_identity(settings.security, settings.name);
    if (!warnings) return tl::unexpected(warnings.error());
    for (const std::string& warning : *warnings) log::warning(warning);
  }
  return std::move(computer->other_peers);
}

// Joins the session, until the program is to end. Output: true: join again, because a handshake was lost.
error::Expected<bool> join(const runtime::ProgramOptions& options, Joining& joining) {
  auto session = databuffer::Session::open(options.session, "gateway");
  if (!session) return tl::unexpected(session.error());
  const auto role = session->claim(Role::gateway);
  if (!role) return tl::unexpected(error::usage_error(role.error()));
  auto link = dds::Link::open(joining.settings, options.session);
  if (!link) return tl::unexpected(link.error());
  joining.identity.start = random_number();
  joining.identity.segment = segment_number(*session);
  log::info("host " + joining.identity.name + " joins session " + options.session + ", DDS domain " +
            std::to_string(joining.settings.domain) + (joining.settings.security.empty() ? "" : ", encrypted"));
  Gateway shell(*session, options.session, std::move(*link), joining);
  while (!runtime::stop_requested()) {
    shell.step();
    const std::string host = shell.take_lost_handshake();
    if (host.empty() || !joining.rejoins.take(databuffer::monotonic_ns())) continue;
    log::warning("the handshake with the gateway of " + host + " was lost, as on a bad line: joins again");
    shell.finish();
    return true;
  }
  runtime::end_in_order();
  shell.finish();
  return false;
}

error::Expected<void> run(const runtime::ProgramOptions& options, const std::string& network,
                          const std::string& terrain) {
  auto loaded = config::load_network(network, options.config);
  if (!loaded) return tl::unexpected(loaded.error());
  radar::NetworkSettings& settings = loaded->network;
  radar::RadarConfiguration& configuration = loaded->radar;
  if (settings.name.empty()) settings.name = checks::host_name();
  auto peers = check(settings);
  if (!peers) return tl::unexpected(peers.error());
  if (network.empty())
    log::info(loaded->source.empty() ? "no form Network: this computer alone, over the loopback interface"
                                     : "form Network of " + loaded->source);
  if (!terrain.empty()) configuration.terrain.directory = terrain;
  Identity identity{settings.name, static_cast<std::uint32_t>(settings.priority)};
  identity.configuration_hash = configuration_hash(configuration);
  identity.terrain_hash = terrain_hash(configuration.terrain.directory);
  Joining joining{std::move(settings), std::move(*peers), identity};
  error::Expected<bool> again = true;
  while (again && *again) again = join(options, joining);
  return again.map([](bool) {});
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS gateway: joins the session of this computer to those of other computers", "gateway");
  runtime::ProgramOptions options;
  runtime::add_common_options(app, options, runtime::ProgramKind::service);
  std::string network, terrain;
  app.option("--network", network, "GUF file with the form Network: peers, interfaces, domain")
      .value_name("FILE")
      .otherwise("that of the configuration, else this computer alone, over the loopback interface");
  app.option("--terrain", terrain, "folder of elevation cells, compared with that of other computers")
      .value_name("DIR")
      .otherwise("the configuration's");
  return runtime::run_program(argc, argv, app, options, [&] { return run(options, network, terrain); });
}
