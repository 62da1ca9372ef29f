#include "tools/patch_output.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "databuffer/program.hpp"
#include "lib/imageio/png.hpp"
#include "model/terrain/gdal/map_writer.hpp"
#include "model/terrain/gdal/raster.hpp"
#include "tools/command.hpp"
#include "tools/float_file.hpp"
#include "tools/output_name.hpp"

namespace yars::tools {

namespace {

namespace gdal = model::terrain::gdal;
namespace hrm = model::hrm;

// The map's plane keeps distance and bearing from the aircraft: the plane of the file about it, turned by the bearing
// of the map's middle.
std::array<double, 6> plane_from_pixel(const hrm::PatchGeometry& geometry, int size) {
  const double pixel_m = geometry.window_m() / size;
  const double sine = std::sin(geometry.up().radians());
  const double cosine = std::cos(geometry.up().radians());
  const double left_m = -0.5 * geometry.window_m();
  const double top_m = geometry.distance_m() + 0.5 * geometry.window_m();
  return {left_m * cosine + top_m * sine,  pixel_m * cosine, -pixel_m * sine,
          -left_m * sine + top_m * cosine, -pixel_m * sine,  -pixel_m * cosine};
}

void write_raster(const PatchOutput& output, const hrm::PatchOrder& order, const hrm::PatchProcess& process) {
  const int size = process.image().size;
  gdal::MapPicture picture;
  picture.columns = picture.rows = size;
  picture.origin_latitude_deg = order.apex.latitude_deg;
  picture.origin_longitude_deg = order.apex.longitude_deg;
  picture.plane_from_pixel = plane_from_pixel(process.geometry(), size);
  if (output.pixels == "video") {
    picture.pixels = process.picture();
    picture.description = "video, 0 black to 255 white";
  } else {
    std::vector<float> power(process.image().power.begin(), process.image().power.end());
    std::replace_if(
        power.begin(), power.end(), [](float value) { return value < 0.0F; }, std::numeric_limits<float>::quiet_NaN());
    picture.pixels = std::move(power);
    picture.description = "power as gamma of level ground, before speckle and noise";
  }
  if (auto written = gdal::write_map(output.file, picture); !written) give_up(written.error());
}

}  // namespace

void check_patch_output(const PatchOutput& output) {
  const std::string suffix = ending_of(output.file);
  if (output.pixels != "video" && suffix != ".tif")
    give_up(
        databuffer::usage_error("--pixels", "an --out that ends in .tif", output.file.empty() ? "none" : output.file));
  if (suffix == ".tif" && !gdal::available())
    give_up({output.file, "a YARS built with GDAL to write a GeoTIFF", "one built without it",
             "run `scripts/setup --gdal` and build again, or write a .png"});
  check_file_name("--out", output.file, {".png", ".tif", ".f32"});
}

void write_patch(const PatchOutput& output, const hrm::PatchOrder& order, const hrm::PatchProcess& process) {
  const std::filesystem::path path(output.file);
  const std::string suffix = ending_of(output.file);
  if (suffix == ".f32") {
    if (auto written = write_floats(path, process.image().power); !written) give_up(written.error());
    return;
  }
  if (suffix == ".tif") return write_raster(output, order, process);
  imageio::Image picture{process.image().size, process.image().size, 1, process.picture()};
  if (auto written = imageio::write_png(path, picture); !written) give_up(written.error());
}

}  // namespace yars::tools
