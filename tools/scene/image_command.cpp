// `yars scene image`: writes the plan view of an OpenFlight file as PNG.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "lib/imageio/png.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/openflight/reader.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

// Plan view of an OpenFlight model, north up. The highest surface is visible. Shading: Lambert, light from the
// north-west. Each pixel is the mean of kSamples x kSamples samples.

enum class PlanColors { file, material };

// Area of a plan view. West and south edges are offsets from Model::base, the origin of the vertex positions.
struct PlanFrame {
  double west_m = 0.0, south_m = 0.0, metres_per_pixel = 1.0;
  int width = 0, height = 0;  // [pixels]
};

// Frame of the whole model with a margin of 2 % on each side. `width`: longer side [pixels].
PlanFrame plan_frame(const model::scene::Model& model, int width);

imageio::Image draw_plan(const model::scene::Model& model, const PlanFrame& frame, PlanColors colors);

namespace {

using namespace model::scene;

constexpr int kSamples = 2;                      // samples along one side of a pixel
constexpr std::uint32_t kBackground = 0xC8CDB4;  // RGB of samples without a surface

// RGB by surface material code (docs/spec/formats.md#dfad): 0 none, 1 metal, 2 part metal, 3 stone, 4 composition,
// 5 earth, 6 water, 7 sand, 8 rock, 9 paved, 10 soil, 11 marsh, 12 trees, 13 snow.
constexpr std::array<std::uint32_t, 14> kByMaterial{0xFF00FF, 0xD24A3A, 0xE08A4A, 0xB59A7A, 0xD8CFB8,
                                                    0x8A6A3A, 0x3A6AB5, 0xE0D090, 0x6E6A66, 0x707078,
                                                    0x9AA060, 0x5A8A7A, 0x3A7A3A, 0xF4F6FA};

// Corner of a triangle: x and y in samples, right and down from the upper left of the image; z: height [m] above
// Model::base. nx, ny, nz: normal (east, north, up).
struct Corner {
  double x = 0, y = 0, z = 0, nx = 0, ny = 0, nz = 0;
};

// Z-buffer: for each sample, the height and the shaded colour of the highest surface.
class Canvas {
 public:
  explicit Canvas(const PlanFrame& frame) : width_(frame.width * kSamples), height_(frame.height * kSamples) {
    const std::size_t samples = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    heights_.assign(samples, -std::numeric_limits<float>::infinity());
    colors_.assign(samples, kBackground);
  }

  void draw(const std::array<Corner, 3>& c, std::uint32_t rgb) {
    // Twice the signed area. Rows count downwards, so a face whose front is up has a negative area.
    // Other faces are not drawn.
    const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
    if (!(area < 0.0)) return;
    const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
    // Clamped before the conversion to int: corners far outside a small window exceed the range of int.
    const int first_x = static_cast<int>(std::clamp(std::ceil(left - 0.5), 0.0, 1.0 * width_));
    const int last_x = static_cast<int>(std::clamp(std::floor(right - 0.5), -1.0, width_ - 1.0));
    const int first_y = static_cast<int>(std::clamp(std::ceil(top - 0.5), 0.0, 1.0 * height_));
    const int last_y = static_cast<int>(std::clamp(std::floor(bottom - 0.5), -1.0, height_ - 1.0));
    for (int y = first_y; y <= last_y; ++y)
      for (int x = first_x; x <= last_x; ++x) sample(c, area, x, y, rgb);
  }

  imageio::Image picture() const {
    imageio::Image image{width_ / kSamples, height_ / kSamples, 3, {}};
    for (int row = 0; row < image.height; ++row)
      for (int column = 0; column < image.width; ++column) {
        std::array<unsigned, 3> sum{};
        for (int y = 0; y < kSamples; ++y)
          for (int x = 0; x < kSamples; ++x) {
            const std::uint32_t rgb = colors_[index(column * kSamples + x, row * kSamples + y)];
            for (unsigned channel = 0; channel < 3; ++channel) sum[channel] += rgb >> (16 - 8 * channel) & 0xFFU;
          }
        for (const unsigned total : sum)
          image.pixels.push_back(static_cast<std::uint8_t>(total / (kSamples * kSamples)));
      }
    return image;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  void sample(const std::array<Corner, 3>& c, double area, int x, int y, std::uint32_t rgb) {
    // Barycentric coordinates a, b, d of the sample's centre for the corners 0, 1, 2.
    const double px = x + 0.5, py = y + 0.5;
    const double b = ((px - c[0].x) * (c[2].y - c[0].y) - (py - c[0].y) * (c[2].x - c[0].x)) / area;
    const double d = ((c[1].x - c[0].x) * (py - c[0].y) - (c[1].y - c[0].y) * (px - c[0].x)) / area;
    const double a = 1.0 - b - d;
    if (a < 0.0 || b < 0.0 || d < 0.0) return;
    const auto height = static_cast<float>(a * c[0].z + b * c[1].z + d * c[2].z);
    const std::size_t at = index(x, y);
    if (height <= heights_[at]) return;
    heights_[at] = height;
    // Lambert's cosine, light from the north-west, 45 deg above the horizontal. 0.3 is ambient light.
    const double nx = a * c[0].nx + b * c[1].nx + d * c[2].nx;
    const double ny = a * c[0].ny + b * c[1].ny + d * c[2].ny;
    const double nz = a * c[0].nz + b * c[1].nz + d * c[2].nz;
    const double light = std::max(0.0, (-0.5 * nx + 0.5 * ny + 0.7071 * nz) / std::sqrt(nx * nx + ny * ny + nz * nz));
    const double brightness = std::min(1.0, 0.3 + light);
    std::uint32_t shaded = 0;
    for (unsigned shift : {16U, 8U, 0U})
      shaded |= static_cast<std::uint32_t>(brightness * (rgb >> shift & 0xFFU)) << shift;
    colors_[at] = shaded;
  }

  int width_, height_;
  std::vector<float> heights_;
  std::vector<std::uint32_t> colors_;
};

std::uint32_t color_of(const SurfaceKind& kind, PlanColors colors) {
  if (colors == PlanColors::file) return kind.color_rgb;
  return kind.material < kByMaterial.size() ? kByMaterial[kind.material] : kByMaterial[0];
}

}  // namespace

PlanFrame plan_frame(const Model& model, int width) {
  double west = 0, east = 0, south = 0, north = 0;
  bool first = true;
  for (const ModelVertex& vertex : model.vertices) {
    const double x = static_cast<double>(vertex.position_m[0]), y = static_cast<double>(vertex.position_m[1]);
    west = first ? x : std::min(west, x);
    east = first ? x : std::max(east, x);
    south = first ? y : std::min(south, y);
    north = first ? y : std::max(north, y);
    first = false;
  }
  // 1.04: margin of 2 % on each side. 1e-3 m: minimum extent, against division by zero.
  const double side = std::max({east - west, north - south, 1e-3}) * 1.04;
  PlanFrame frame;
  frame.metres_per_pixel = side / width;
  frame.width = std::clamp(static_cast<int>(std::ceil((east - west) * 1.04 / frame.metres_per_pixel)), 16, width);
  frame.height = std::clamp(static_cast<int>(std::ceil((north - south) * 1.04 / frame.metres_per_pixel)), 16, width);
  frame.west_m = (west + east) / 2 - frame.width * frame.metres_per_pixel / 2;
  frame.south_m = (south + north) / 2 - frame.height * frame.metres_per_pixel / 2;
  return frame;
}

imageio::Image draw_plan(const Model& model, const PlanFrame& frame, PlanColors colors) {
  Canvas canvas(frame);
  const double scale = kSamples / frame.metres_per_pixel;
  const double rows = frame.height * kSamples;
  for (const ModelTriangle& triangle : model.triangles) {
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const ModelVertex& vertex = model.vertices[triangle.corners[i]];
      const auto& p = vertex.position_m;
      const auto& n = vertex.normal;
      corners[i] = {(static_cast<double>(p[0]) - frame.west_m) * scale,
                    rows - (static_cast<double>(p[1]) - frame.south_m) * scale,
                    static_cast<double>(p[2]),
                    static_cast<double>(n[0]),
                    static_cast<double>(n[1]),
                    static_cast<double>(n[2])};
    }
    canvas.draw(corners, color_of(model.kinds[triangle.kind], colors));
  }
  return canvas.picture();
}

namespace {

struct SceneImageOptions {
  std::string file;
  std::string out;
  std::vector<std::string> without;
  int width = 1024;
  bool material = false;
  std::vector<double> window;  // [m] west and south edge from the file's origin, side of the square; empty: all
};

constexpr double kMinWindow_m = 0.1;  // smaller windows would show the rounding of float coordinates
constexpr double kMaxWindow_m = 1e6;  // maximum side of the window
constexpr double kMaxEdge_m = 1e7;    // maximum |west| and |south| of the edges; the reader omits polygons beyond

// Error of bad usage for a window that cannot be drawn; nullopt for any other window.
std::optional<error::Error> window_problem(const std::vector<double>& window) {
  using text::text_of_number;
  if (!(window[2] >= kMinWindow_m && window[2] <= kMaxWindow_m))
    return error::usage_error(
        "--window", "a side of " + text_of_number(kMinWindow_m) + " to " + text_of_number(kMaxWindow_m) + " m",
        text_of_number(window[2]) + " m", "give WEST SOUTH SIDE in metres");
  for (const double edge_m : {window[0], window[1]})
    if (!(std::abs(edge_m) <= kMaxEdge_m))
      return error::usage_error("--window", "edges within " + text_of_number(kMaxEdge_m) + " m of the origin",
                                text_of_number(edge_m) + " m", "give WEST SOUTH SIDE in metres");
  return std::nullopt;
}

void draw(const SceneImageOptions& options) {
  check_file_name("--out", options.out, {".png"});
  if (!options.window.empty())
    if (const auto problem = window_problem(options.window)) throw_failure(*problem);
  model::scene::NameFilter filter = name_filter(options.without);
  const auto model = model::scene::read_openflight(options.file, &filter);
  if (!model) throw_failure(model.error());
  if (const auto problem = filter.unmatched_error(options.file)) throw_failure(*problem);
  for (const auto* sentences : {&model->warnings, &model->left_out})
    for (const std::string& sentence : *sentences) warn_as("yars scene image")(options.file + ": " + sentence);
  PlanFrame frame = plan_frame(*model, options.width);
  if (!options.window.empty())
    frame = {options.window[0] - model->base.x, options.window[1] - model->base.y, options.window[2] / options.width,
             options.width, options.width};
  const PlanColors colors = options.material ? PlanColors::material : PlanColors::file;
  if (const auto written = imageio::write_png(options.out, draw_plan(*model, frame, colors)); !written)
    throw_failure(written.error());
  if (!model->left_out.empty())
    throw_failure({options.file, "a file that is read whole",
                   text::counted(model->left_out.size(), "part") + " left out, named above",
                   "repair the file, or leave the parts out with --without"});
}

}  // namespace

void add_scene_image(runtime::Command scene) {
  const auto options = std::make_shared<SceneImageOptions>();
  runtime::Command command = scene.subcommand("image", "draw a plan view as PNG, north up, shaded by normals");
  command.option("--scene,FILE", options->file, "OpenFlight file").value_name("FILE").required();
  command.option("--out", options->out, "PNG file").value_name("FILE").required();
  command.option("--width", options->width, "[pixels] of the longer side").range(16, 8192);
  command.option("--window", options->window, "[m] WEST, SOUTH edge from the origin, SIDE of square")
      .values(3)
      .otherwise("the whole model");
  add_without(command, options->without);
  command.flag("--material", options->material, "colours by surface material code; magenta: code 0, or above 13");
  command.callback([options] { draw(*options); });
}

}  // namespace yars::tools
