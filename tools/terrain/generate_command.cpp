// `yars terrain generate`: writes a made-up landscape as a DTED tree. Each cell has a culture file beside it, unless
// --no-culture is set.

#include "tools/terrain/generate_command.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/dted.hpp"
#include "radar/limits.hpp"
#include "tools/command/command.hpp"
#include "worldgen/terrain/landscape.hpp"

namespace yars::tools {

namespace {

using namespace model::terrain;

// Cells of the area in blocks of 8 x 8: consecutive cells are neighbours and share cached features and relief.
std::vector<CellCorner> corners_of(const TerrainGeneration& request) {
  constexpr int kBlock = 8;
  std::vector<CellCorner> corners;
  for (int south = 0; south < request.cells_lat; south += kBlock)
    for (int west = 0; west < request.cells_lon; west += kBlock)
      for (int row = south; row < std::min(south + kBlock, request.cells_lat); ++row)
        for (int column = west; column < std::min(west + kBlock, request.cells_lon); ++column)
          corners.push_back(worldgen::neighbour_of({request.south, request.west}, row, column));
  return corners;
}

// Generates and writes the cells of an area on several threads. If there are two or more threads for each cell, several
// threads work on one cell.
class Generation {
 public:
  Generation(std::string folder, const TerrainGeneration& request, const parallel::GoesOn& goes_on)
      : folder_(std::move(folder)),
        request_(request),
        goes_on_(goes_on),
        landscape_(request.seed, island_of(request), request.airfields == AirfieldCulture::paved),
        corners_(corners_of(request)),
        progress_(corners_.size()) {
    const int threads =
        request.threads > 0 ? request.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int cells = static_cast<int>(corners_.size());
    workers_ = std::min(threads, cells);
    threads_per_cell_ = cells >= 2 * threads ? 1 : std::max(1, threads / workers_);
  }

  GeneratedCells run() {
    std::vector<std::thread> helpers;
    helping_ = workers_ - 1;
    for (int worker = 1; worker < workers_; ++worker)
      helpers.emplace_back([this] {
        work([this] { return !stop_; });
        const std::lock_guard lock(mutex_);
        --helping_;
        ended_.notify_one();
      });
    work([this] { return ask(); });
    {
      constexpr std::chrono::milliseconds kBetweenQuestions{50};
      std::unique_lock lock(mutex_);
      while (helping_ > 0) {
        ended_.wait_for(lock, kBetweenQuestions);
        lock.unlock();
        ask();
        lock.lock();
      }
    }
    for (std::thread& other : helpers) other.join();
    if (stopped_) throw parallel::Stopped{};
    if (failed_) throw_failure(*failed_);
    return {written_, corners_.size() - written_};
  }

 private:
  static std::optional<worldgen::LandscapeBox> island_of(const TerrainGeneration& request) {
    if (request.edge == LandEdge::cut) return std::nullopt;
    return worldgen::LandscapeBox{request.south, request.west, request.cells_lat, request.cells_lon};
  }

  // Asked by the thread that has called run().
  bool ask() {
    if (!stopped_ && goes_on_ && !goes_on_()) stop_ = stopped_ = true;
    return !stop_;
  }

  void work(const parallel::GoesOn& goes_on) {
    for (std::size_t number = next_++; number < corners_.size() && !stop_; number = next_++) {
      const CellCorner corner = corners_[number];
      try {
        const auto note = request_.sea || landscape_.may_have_land(corner) ? make(corner, goes_on) : leave_out(corner);
        if (!note) return fail(note.error());
        const std::lock_guard lock(mutex_);
        progress_.done(*note);
      } catch (const parallel::Stopped&) {
        return;
      }
    }
  }

  // Generates and writes one cell. Returns a line that describes the cell. Without --sea, no file is written for an
  // all-sea cell, and the line is empty.
  error::Expected<std::string> make(CellCorner corner, const parallel::GoesOn& goes_on) {
    const worldgen::MadeCell made = landscape_.make(corner, dted::kPostsOfLevel[request_.level],
                                                    dted_columns(corner, request_.level), threads_per_cell_, goes_on);
    const bool all_sea = made.cell.highest_m() <= 0;
    if (all_sea && !request_.sea) return leave_out(corner);
    // The culture is written before the cell, so that no new cell is left with an older culture or without its own.
    const std::filesystem::path target = std::filesystem::path(folder_) / dted_name(corner, request_.level);
    const auto culture = request_.culture ? write_culture(culture_path(target), made.culture) : remove_culture(target);
    if (!culture) return tl::unexpected(culture.error());
    const auto path = write_dted(folder_, made.cell, request_.level);
    if (!path) return tl::unexpected(path.error());
    written_ += all_sea ? 0 : 1;
    return path->string() + "  " + std::to_string(std::lround(made.cell.lowest_m())) + " to " +
           std::to_string(std::lround(made.cell.highest_m())) + " m";
  }

  // A cell without a file: one of an earlier landscape goes.
  error::Expected<std::string> leave_out(CellCorner corner) {
    const std::filesystem::path target = std::filesystem::path(folder_) / dted_name(corner, request_.level);
    if (const auto culture = remove_culture(target); !culture) return tl::unexpected(culture.error());
    std::error_code problem;
    std::filesystem::remove(target, problem);
    if (problem) return error::fail(target.string(), "a cell that can be removed", problem.message());
    return std::string();
  }

  void fail(const error::Error& error) {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    if (!failed_) failed_ = error;
  }

  std::string folder_;
  TerrainGeneration request_;
  const parallel::GoesOn& goes_on_;
  worldgen::Landscape landscape_;
  std::vector<CellCorner> corners_;
  int workers_ = 1;
  int threads_per_cell_ = 1;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::size_t> written_ = 0;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> stopped_ = false;  // by goes_on_
  std::mutex mutex_;                   // guards the members below
  std::condition_variable ended_;
  int helping_ = 0;  // threads beside the caller that still work
  Progress progress_;
  std::optional<error::Error> failed_;
};

}  // namespace

GeneratedCells generate_terrain_files(const std::string& folder, const TerrainGeneration& request,
                                      const parallel::GoesOn& goes_on) {
  radar::check_fields(request);
  if (const int most = 90 - request.south; request.cells_lat > most)
    radar::fail({"cells_lat", "at most " + std::to_string(most) + " cells from `south` to the north pole",
                 std::to_string(request.cells_lat), "", ErrorCode::range, 1.0, static_cast<double>(most)});
  return Generation(folder, request, goes_on).run();
}

namespace {

struct TerrainGenerateOptions {
  std::string out;
  TerrainGeneration request;
  bool json = false;
};

}  // namespace

void add_terrain_generate(runtime::Command terrain) {
  const auto options = std::make_shared<TerrainGenerateOptions>();
  runtime::Command command = terrain.subcommand("generate", "a made-up landscape with rivers and towns, as DTED cells");
  command.option("--out", options->out, "folder for the cells").value_name("DIR").required();
  add_request_options(command, options->request);
  add_json_flag(command, options->json);
  command.callback([options] {
    check_folder_name("--out", options->out);
    const GeneratedCells cells = generate_terrain_files(options->out, options->request);
    if (options->json)
      return print_json({{"folder", options->out},
                         {"land_cells", cells.land},
                         {"sea_cells", cells.sea},
                         {"files", options->request.sea ? cells.land + cells.sea : cells.land}});
    std::printf("%s with land in %s; %s with only sea, %s\n", text::counted(cells.land, "cell").c_str(),
                options->out.c_str(), text::counted(cells.sea, "cell").c_str(),
                options->request.sea ? "with files, too" : "without files");
  });
}

}  // namespace yars::tools
