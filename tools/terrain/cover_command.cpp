#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "lib/file/output_file.hpp"
#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/formats/cover_legend.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/pack.hpp"
#include "model/terrain/gdal/land_cover.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tools/command/command.hpp"
#include "tools/terrain/terrain_folders.hpp"

namespace yars::tools {

// `yars terrain cover`: copies a folder of elevation and writes culture beside each cell, from rasters of land cover.

namespace {

using namespace model::terrain;
namespace fs = std::filesystem;

constexpr int kFinest = 10800;  // posts per degree

struct CoverOptions {
  std::vector<std::string> rasters;
  std::string legend, terrain, out;
  std::string posts = "auto";
  bool json = false;
};

// Grid of a culture: that of a level of DTED, or three times as fine as level 2.
struct CultureGrid {
  int north, east;  // intervals per degree
};
CultureGrid culture_grid(CellCorner corner, int posts_per_degree) {
  const int level = posts_per_degree == 1200 ? 1 : 2;
  const int times = posts_per_degree == kFinest ? 3 : 1;
  return {posts_per_degree, times * (dted_columns(corner, level) - 1)};
}

// The coarsest grid that has the detail of the raster.
int posts_for(double pixels_per_degree) {
  constexpr double kEnough = 0.8;
  for (const int posts : {1200, 3600})
    if (posts >= kEnough * pixels_per_degree) return posts;
  return kFinest;
}

// A legend of config/legends by its name, or a file.
std::string legend_path(const std::string& name) {
  return file::installed_file(name.ends_with(".csv") ? name : name + ".csv");
}

error::Expected<CoverLegend> legend_of(const std::string& name) {
  auto legend = read_cover_legend(name);
  if (legend && legend->size() > gdal::kMaxClasses)
    return error::fail(name, "at most " + std::to_string(gdal::kMaxClasses) + " classes",
                       std::to_string(legend->size()));
  return legend;
}

class CoverRun {
 public:
  explicit CoverRun(const CoverOptions& options) : options_(options) {
    check_folder_name("--out", options.out);
    const std::string legend = legend_path(options.legend);
    legend_ = value_of(legend_of(legend));
    for (const CoverClass& row : legend_)
      classes_.push_back({row.values, row.material == static_cast<std::uint8_t>(Material::water)});
    for (const std::string& raster : options.rasters) {
      const auto summary = value_of(gdal::describe_cover(raster));
      for (const gdal::RasterCell& cell : summary.cells)
        rasters_[slot_of({cell.south_deg, cell.west_deg})].push_back(raster);
      finest_ = std::max(finest_, summary.pixels_per_degree);
    }
    FileSentences unused;
    index_ = value_of(index_directory(options.terrain, &unused));
    problems_ = std::move(unused.problems);
    for (const std::string& raster : options.rasters) made_of_ += stamp_of(raster);
    made_of_ += options.posts + "\n" + value_of(file::read_text_file(legend));
    if (lies_in(options.out, options.terrain))
      throw_failure(error::Error{"yars terrain cover", "--out outside of --terrain",
                                 options.out + " inside of " + options.terrain,
                                 "give another folder: the input is never overwritten", error::ErrorCode::argument});
  }

  void run() {
    // A run that was cut off goes on if it has the same rasters, legend and posts.
    const auto before = file::read_text_file(note());
    goes_on_ = before && *before == made_of_;
    if (const auto written = file::write_file_and_folders(note(), std::as_bytes(std::span(made_of_))); !written)
      throw_failure(written.error());
    Progress progress(index_.size());
    for (const auto& [slot, file] : index_) {
      const auto covered = rasters_.find(slot);
      const auto culture =
          write_cell(corner_of_slot(slot), file, covered == rasters_.end() ? nullptr : &covered->second);
      if (!culture) problems_.push_back(culture.error().message());
      progress.done(culture ? *culture : "");
    }
    scene_files_ = copy_scenes(options_.terrain, options_.out, problems_);
    report();
  }

 private:
  template <class T>
  static T value_of(error::Expected<T>&& found) {
    if (!found) throw_failure(found.error());
    return std::move(*found);
  }

  fs::path note() const { return fs::path(options_.out) / "cover.txt"; }

  // Path, size and time of a file.
  static std::string stamp_of(const fs::path& path) {
    std::error_code code;
    return fs::absolute(path).string() + " " + std::to_string(fs::file_size(path, code)) + " " +
           std::to_string(fs::last_write_time(path, code).time_since_epoch().count()) + "\n";
  }
  static bool is_newer(const fs::path& made, const fs::path& source) {
    std::error_code absent, code;
    const auto time = fs::last_write_time(made, absent);
    return !absent && time > fs::last_write_time(source, code) && !code;
  }

  // Returns the written culture; empty: none.
  error::Expected<std::string> write_cell(CellCorner corner, const CellFile& file,
                                          const std::vector<fs::path>* rasters) {
    const fs::path path = culture_path(target_of(corner, file));
    ++cells_;
    // A culture is written after the elevation.
    if (goes_on_ && rasters != nullptr && is_newer(path, file.path)) {
      ++kept_;
      files_.push_back(path.string());
      return path.string();
    }
    if (const auto copied = copy_elevation(corner, file); !copied) return tl::unexpected(copied.error());
    std::optional<Culture> before;
    if (file.culture) {
      auto culture = read_culture(*file.culture, corner);
      if (!culture) return tl::unexpected(culture.error());
      before = std::move(*culture);
    }
    if (rasters == nullptr) {
      if (!before) return std::string();
      if (const auto written = write_culture(path, *before); !written) return tl::unexpected(written.error());
      return std::string();
    }
    const CultureGrid grid =
        culture_grid(corner, options_.posts == "auto" ? posts_for(finest_) : std::stoi(options_.posts));
    auto cover = gdal::read_cover(*rasters, classes_, corner.south_deg, corner.west_deg, grid.north, grid.east);
    if (!cover) return tl::unexpected(cover.error());
    for (const auto& [value, pixels] : cover->unknown) unknown_[value] += pixels;
    if (!cover->unknown.empty()) fs::remove(note());  // so that the next run says it again
    notes_.insert(cover->notes.begin(), cover->notes.end());
    const Culture culture = made(corner, *cover, before ? &*before : nullptr);
    if (const auto written = write_culture(path, culture); !written) return tl::unexpected(written.error());
    files_.push_back(path.string());
    return path.string();
  }

  // A cell of a raster becomes a pack, because the raster may hold several. Other files are copied as they are.
  fs::path target_of(CellCorner corner, const CellFile& file) const {
    const bool raster = file.format == CellFormat::raster;
    return fs::path(options_.out) /
           (raster ? fs::path(pack_name(corner)) : file.path.lexically_relative(options_.terrain));
  }

  error::Expected<void> copy_elevation(CellCorner corner, const CellFile& file) const {
    if (file.format == CellFormat::raster) {
      const auto reading = read_cell(file, corner);
      if (!reading) return tl::unexpected(reading.error());
      if (const auto written = write_pack(options_.out, reading->cell); !written)
        return tl::unexpected(written.error());
      return {};
    }
    const fs::path to = target_of(corner, file);
    std::error_code code;
    fs::create_directories(to.parent_path(), code);
    fs::copy_file(file.path, to, fs::copy_options::overwrite_existing, code);
    const fs::path side = fs::path(file.path).replace_extension(".side");
    if (!code && file.format == CellFormat::pack && fs::exists(side))
      fs::copy_file(side, fs::path(to).replace_extension(".side"), fs::copy_options::overwrite_existing, code);
    if (!code) fs::permissions(to, fs::perms::owner_write, fs::perm_options::add, code);
    if (code) return error::fail(to.string(), "a copy of " + file.path.string(), error::reason_of(code.value()));
    return {};
  }

  // Posts without a class keep their cover of before.
  Culture made(CellCorner corner, const gdal::CoverPosts& cover, const Culture* before) {
    std::vector<std::uint8_t> bytes(cover.classes.size());
    for (int row = 0; row < cover.rows; ++row)
      for (int column = 0; column < cover.columns; ++column) {
        const std::size_t post =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(cover.columns) + static_cast<std::size_t>(column);
        const std::uint8_t winner = cover.classes[post], land = cover.land[post];
        if (winner == gdal::kNoClass) {
          if (before != nullptr)
            bytes[post] = cover_byte(before->nearest(static_cast<double>(row) / (cover.rows - 1),
                                                     static_cast<double>(column) / (cover.columns - 1)));
          continue;
        }
        ++posts_[winner];
        const auto material =
            land == gdal::kNoClass ? static_cast<std::uint8_t>(Material::water) : legend_[land].material;
        bytes[post] = cover_byte({material, cover.water[post] / 255.0});
      }
    return {corner, cover.rows, cover.columns, bytes};
  }

  void report() const {
    for (const std::string& problem : problems_) std::fprintf(stderr, "problem: %s\n", problem.c_str());
    for (const std::string& note : notes_) std::fprintf(stderr, "note: %s\n", note.c_str());
    if (options_.json) {
      nlohmann::ordered_json classes = nlohmann::ordered_json::object(), unknown = nlohmann::ordered_json::object();
      for (const auto& [number, posts] : posts_) classes[legend_[number].name] = posts;
      for (const auto& [value, pixels] : unknown_) unknown[std::to_string(value)] = pixels;
      print_json({{"cells", cells_},
                  {"scene_files", scene_files_},
                  {"kept", kept_},
                  {"files", files_},
                  {"posts", classes},
                  {"unknown", unknown},
                  {"problems", problems_},
                  {"notes", notes_}});
    } else {
      std::printf("%s, %s\n", text::counted(cells_, "cell").c_str(),
                  text::counted(files_.size(), "culture file").c_str());
      if (kept_ > 0) std::printf("%s of an earlier run\n", text::counted(kept_, "culture file").c_str());
      for (const auto& [number, posts] : posts_)
        std::printf("%12zu posts  %s: %s\n", posts, legend_[number].name.c_str(), material_text(number).c_str());
    }
    std::fflush(stdout);
    if (files_.empty() && problems_.empty())
      throw CommandFailed{"yars terrain cover: expected rasters over a cell of " + options_.terrain +
                          ", found none; see `yars terrain info`"};
    if (!unknown_.empty())
      throw CommandFailed{"yars terrain cover: expected a line of the legend for each class, found none for " +
                          unknown_text() + "; add lines to a copy of the legend, and give it with --legend FILE.csv"};
    if (!problems_.empty())
      throw CommandFailed{"yars terrain cover: expected cells that can be covered, found " +
                          std::to_string(problems_.size()) + " problems; see above"};
  }

  std::string material_text(std::uint8_t number) const {
    const std::uint8_t material = legend_[number].material;
    const std::string_view name = material_name(material);
    return name.empty() ? "material " + std::to_string(material) : std::string(name);
  }

  // The values with the most pixels.
  std::string unknown_text() const {
    constexpr std::size_t kShown = 5;
    std::vector<std::pair<std::size_t, int>> most;
    for (const auto& [value, pixels] : unknown_) most.emplace_back(pixels, value);
    std::ranges::sort(most, std::greater<>());
    std::string all;
    for (std::size_t i = 0; i < std::min(kShown, most.size()); ++i)
      all.append(i > 0 ? ", " : "")
          .append(std::to_string(most[i].second) + " (")
          .append(text::counted(most[i].first, "pixel") + ")");
    return all + (most.size() > kShown ? " and others" : "");
  }

  const CoverOptions options_;
  CoverLegend legend_;
  std::vector<gdal::PixelClass> classes_;  // of legend_
  DirectoryIndex index_;
  std::map<std::size_t, std::vector<fs::path>> rasters_;  // by slot of the cell
  double finest_ = 0.0;                                   // [pixels/deg]
  std::string made_of_;                                   // what the cultures follow from, as text
  bool goes_on_ = false;                                  // cultures of an earlier run with the same `made_of_` stay
  std::size_t cells_ = 0, kept_ = 0, scene_files_ = 0;
  std::vector<std::string> files_, problems_;
  std::set<std::string> notes_;
  std::map<std::uint8_t, std::size_t> posts_;  // by class of the legend
  std::map<int, std::size_t> unknown_;         // pixels by value
};

}  // namespace

void add_terrain_cover(runtime::Command terrain) {
  const auto options = std::make_shared<CoverOptions>();
  runtime::Command command = terrain.subcommand("cover", "elevation with materials from rasters of land cover");
  command
      .option("--from", options->rasters, "raster of land cover; repeatable, the first with a class at a post counts")
      .value_name("RASTER")
      .required();
  command
      .option("--legend", options->legend,
              "worldcover, corine, nlcd, copernicus, or a file: class, name, material, source")
      .value_name("NAME|FILE.csv")
      .required();
  command.option("--terrain", options->terrain, "folder of elevation cells").value_name("DIR").required();
  command.option("--out", options->out, "folder for the elevation with its culture").value_name("DIR").required();
  command
      .option("--posts", options->posts, "posts of the culture per degree; auto: the fewest with the rasters' detail")
      .one_of({"auto", "1200", "3600", "10800"});
  add_json_flag(command, options->json);
  command.callback([options] { CoverRun(*options).run(); });
}

}  // namespace yars::tools
