#include "model/terrain/formats/jpeg2000.hpp"

#include <openjpeg.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>

#include "lib/error/error.hpp"
#include "lib/memory/byte_order.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::terrain {

namespace {

constexpr int kMaxSide = 1 << 15;  // [posts] more than any cell has; products of two sides fit into 32 bits

struct DestroyCodec {
  void operator()(opj_codec_t* codec) const { opj_destroy_codec(codec); }
};
struct DestroyImage {
  void operator()(opj_image_t* image) const { opj_image_destroy(image); }
};
struct DestroyStream {
  void operator()(opj_stream_t* stream) const { opj_stream_destroy(stream); }
};
using Codec = std::unique_ptr<opj_codec_t, DestroyCodec>;
using Image = std::unique_ptr<opj_image_t, DestroyImage>;
using Stream = std::unique_ptr<opj_stream_t, DestroyStream>;

constexpr auto kFailed = static_cast<OPJ_SIZE_T>(-1);

// Input buffer of OpenJPEG's read callbacks.
struct Source {
  std::span<const std::byte> bytes;
  std::size_t at = 0;
};

OPJ_SIZE_T read_source(void* buffer, OPJ_SIZE_T count, void* user) {
  auto& source = *static_cast<Source*>(user);
  const std::size_t got = std::min(count, source.bytes.size() - source.at);
  if (got == 0) return kFailed;
  std::memcpy(buffer, source.bytes.data() + source.at, got);
  source.at += got;
  return got;
}
OPJ_BOOL seek_source(OPJ_OFF_T offset, void* user) {
  auto& source = *static_cast<Source*>(user);
  if (offset < 0 || static_cast<std::size_t>(offset) > source.bytes.size()) return OPJ_FALSE;
  source.at = static_cast<std::size_t>(offset);
  return OPJ_TRUE;
}
OPJ_OFF_T skip_source(OPJ_OFF_T count, void* user) {
  const auto& source = *static_cast<Source*>(user);
  return seek_source(static_cast<OPJ_OFF_T>(source.at) + count, user) == OPJ_TRUE ? count : -1;
}

// Output buffer of OpenJPEG's write callbacks. OpenJPEG seeks back to fill in lengths.
struct Sink {
  std::vector<std::byte> bytes;
  std::size_t at = 0;
};

OPJ_BOOL seek_sink(OPJ_OFF_T offset, void* user) {
  if (offset < 0) return OPJ_FALSE;
  auto& sink = *static_cast<Sink*>(user);
  sink.at = static_cast<std::size_t>(offset);
  if (sink.bytes.size() < sink.at) sink.bytes.resize(sink.at);
  return OPJ_TRUE;
}
OPJ_SIZE_T write_sink(void* buffer, OPJ_SIZE_T count, void* user) {
  auto& sink = *static_cast<Sink*>(user);
  sink.bytes.resize(std::max(sink.bytes.size(), sink.at + count));
  std::memcpy(sink.bytes.data() + sink.at, buffer, count);
  sink.at += count;
  return count;
}
OPJ_OFF_T skip_sink(OPJ_OFF_T count, void* user) {
  const auto& sink = *static_cast<Sink*>(user);
  return seek_sink(static_cast<OPJ_OFF_T>(sink.at) + count, user) == OPJ_TRUE ? count : -1;
}

// OpenJPEG's first error message, which names the cause.
struct Messages {
  std::string first;
};
void keep_first(const char* text, void* user) {
  auto& messages = *static_cast<Messages*>(user);
  if (!messages.first.empty()) return;
  messages.first = text;
  while (!messages.first.empty() && messages.first.back() == '\n') messages.first.pop_back();
}
void ignore(const char* /*text*/, void* /*user*/) {}

void listen(opj_codec_t* codec, Messages& messages) {
  opj_set_error_handler(codec, keep_first, &messages);
  opj_set_warning_handler(codec, ignore, nullptr);
  opj_set_info_handler(codec, ignore, nullptr);
}

Image image_of(const HeightGrid& grid) {
  opj_image_cmptparm_t component{};
  component.dx = component.dy = 1;
  component.w = static_cast<OPJ_UINT32>(grid.columns);
  component.h = static_cast<OPJ_UINT32>(grid.rows);
  component.prec = 16;
  component.sgnd = 1;
  Image image(opj_image_create(1, &component, OPJ_CLRSPC_GRAY));
  if (!image) return image;
  image->x1 = component.w;
  image->y1 = component.h;
  std::copy(grid.heights.begin(), grid.heights.end(), image->comps[0].data);
  return image;
}

error::Error coding_failed(const Messages& messages) {
  return {"JPEG 2000", "heights that can be coded", messages.first.empty() ? "a failure" : messages.first, {}};
}

Stream stream_over(Source& source) {
  Stream stream(opj_stream_create(OPJ_J2K_STREAM_CHUNK_SIZE, OPJ_TRUE));
  opj_stream_set_user_data(stream.get(), &source, nullptr);
  opj_stream_set_user_data_length(stream.get(), source.bytes.size());
  opj_stream_set_read_function(stream.get(), read_source);
  opj_stream_set_skip_function(stream.get(), skip_source);
  opj_stream_set_seek_function(stream.get(), seek_source);
  return stream;
}

// Returns the first property of the image that differs from rows x columns signed 16-bit heights, as text for an error.
// Empty if the image is as expected.
std::string mismatch_of(const opj_image_t& image, int rows, int columns) {
  if (image.numcomps != 1) return std::to_string(image.numcomps) + " components";
  const opj_image_comp_t& heights = image.comps[0];
  if (image.x0 != 0 || image.y0 != 0 || static_cast<int>(image.x1) != columns || static_cast<int>(image.y1) != rows ||
      heights.dx != 1 || heights.dy != 1)
    return std::to_string(image.x1) + " x " + std::to_string(image.y1);
  if (heights.prec != 16 || heights.sgnd != 1)
    return std::to_string(heights.prec) + (heights.sgnd == 1 ? " bits signed" : " bits unsigned");
  return {};
}

int reduced_side(int side, int reduction) {
  return ((side - 1) >> reduction) + 1;
}

}  // namespace

error::Expected<std::vector<std::byte>> encode_jpeg2000(const HeightGrid& grid, int reductions) {
  YARS_REQUIRE(std::min(grid.rows, grid.columns), >=, 2);
  YARS_REQUIRE(std::max(grid.rows, grid.columns), <=, kMaxSide);
  opj_cparameters_t parameters;
  opj_set_default_encoder_parameters(&parameters);
  parameters.tcp_numlayers = 1;
  parameters.tcp_rates[0] = 0;  // lossless
  parameters.cp_disto_alloc = 1;
  parameters.irreversible = 0;
  parameters.numresolution = reductions + 1;
  parameters.prog_order = OPJ_RLCP;  // coarse levels first in the file
  Messages messages;
  const Image image = image_of(grid);
  const Codec codec(opj_create_compress(OPJ_CODEC_JP2));
  const Stream stream(opj_stream_create(OPJ_J2K_STREAM_CHUNK_SIZE, OPJ_FALSE));
  if (!image || !codec || !stream) return tl::unexpected(coding_failed(messages));
  listen(codec.get(), messages);
  Sink sink;
  opj_stream_set_user_data(stream.get(), &sink, nullptr);
  opj_stream_set_write_function(stream.get(), write_sink);
  opj_stream_set_skip_function(stream.get(), skip_sink);
  opj_stream_set_seek_function(stream.get(), seek_sink);
  if (opj_setup_encoder(codec.get(), &parameters, image.get()) != OPJ_TRUE ||
      opj_start_compress(codec.get(), image.get(), stream.get()) != OPJ_TRUE ||
      opj_encode(codec.get(), stream.get()) != OPJ_TRUE || opj_end_compress(codec.get(), stream.get()) != OPJ_TRUE)
    return tl::unexpected(coding_failed(messages));
  return std::move(sink.bytes);
}

error::Expected<HeightGrid> decode_jpeg2000(std::span<const std::byte> file, const std::string& subject, int rows,
                                            int columns, int reduction) {
  Source source{file};
  Messages messages;
  const Stream stream = stream_over(source);
  const Codec codec(opj_create_decompress(OPJ_CODEC_JP2));
  if (!stream || !codec) return error::fail(subject, "memory to decode a JPEG 2000 picture", "none");
  listen(codec.get(), messages);
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  parameters.cp_reduce = static_cast<OPJ_UINT32>(reduction);
  opj_image_t* read = nullptr;
  const bool opened = opj_setup_decoder(codec.get(), &parameters) == OPJ_TRUE &&
                      opj_decoder_set_strict_mode(codec.get(), OPJ_TRUE) == OPJ_TRUE &&
                      opj_read_header(stream.get(), codec.get(), &read) == OPJ_TRUE;
  const Image image(read);
  if (!opened)
    return error::fail(subject, "a JPEG 2000 picture with " + std::to_string(reduction) + " reductions",
                       messages.first.empty() ? "other bytes" : messages.first, "pack the cell again");
  // Checked before decoding, because the decoder allocates memory for the size that the header states.
  if (const std::string mismatch = mismatch_of(*image, rows, columns); !mismatch.empty())
    return error::fail(subject, std::to_string(columns) + " x " + std::to_string(rows) + " signed 16-bit heights",
                       mismatch, "pack the cell again");
  if (opj_decode(codec.get(), stream.get(), image.get()) != OPJ_TRUE || image->comps[0].data == nullptr)
    return error::fail(subject, "a whole JPEG 2000 picture", messages.first.empty() ? "a damaged one" : messages.first,
                       "pack the cell again");
  const opj_image_comp_t& decoded = image->comps[0];
  HeightGrid grid{reduced_side(rows, reduction), reduced_side(columns, reduction), {}};
  if (static_cast<int>(decoded.w) != grid.columns || static_cast<int>(decoded.h) != grid.rows)
    return error::fail(subject, std::to_string(grid.columns) + " x " + std::to_string(grid.rows) + " heights",
                       std::to_string(decoded.w) + " x " + std::to_string(decoded.h), "pack the cell again");
  grid.heights.resize(static_cast<std::size_t>(decoded.w) * decoded.h);
  std::transform(decoded.data, decoded.data + grid.heights.size(), grid.heights.begin(), [](OPJ_INT32 height) {
    using Limits = std::numeric_limits<std::int16_t>;
    return static_cast<std::int16_t>(std::clamp<OPJ_INT32>(height, Limits::min(), Limits::max()));
  });
  return grid;
}

GridSize jpeg2000_size(std::span<const std::byte> head) {
  // [bytes] Offset of the image header box: lengths of the signature box, of the file type box, and of the header of
  // the JP2 header box. Source: ISO/IEC 15444-1 annex I.
  constexpr std::size_t kImageHeader = 12 + 20 + 8;
  if (head.size() < kJpeg2000HeadBytes) return {};
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  if (text.substr(4, 4) != "jP  " || text.substr(kImageHeader + 4, 4) != "ihdr") return {};
  const auto side = [&](std::size_t at) {
    const auto value = memory::big_endian<std::uint32_t>(head, at);
    return value >= 2 && value <= kMaxSide ? static_cast<int>(value) : 0;
  };
  const GridSize size{side(kImageHeader + 8), side(kImageHeader + 12)};
  return size.rows == 0 || size.columns == 0 ? GridSize{} : size;
}

namespace {

std::size_t index_of(int row, int column, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

// Grid of half the size. Each post is the mean of two by two posts without their voids; void if all of them are void.
HeightGrid halved(const HeightGrid& fine) {
  HeightGrid coarse{(fine.rows + 1) / 2, (fine.columns + 1) / 2, {}};
  coarse.heights.reserve(index_of(coarse.rows, 0, coarse.columns));
  for (int row = 0; row < coarse.rows; ++row)
    for (int column = 0; column < coarse.columns; ++column) {
      long sum = 0;
      long count = 0;
      for (int down = 2 * row; down < std::min(2 * row + 2, fine.rows); ++down)
        for (int right = 2 * column; right < std::min(2 * column + 2, fine.columns); ++right) {
          const std::int16_t height = fine.heights[index_of(down, right, fine.columns)];
          if (height == kVoidPost) continue;
          sum += height;
          ++count;
        }
      coarse.heights.push_back(count == 0 ? kVoidPost : static_cast<std::int16_t>(sum / count));
    }
  return coarse;
}

// Bilinear interpolation of coarse posts at a fine post. A coarse post lies at the centre of the posts it averages.
std::int16_t between(const HeightGrid& coarse, int fine_row, int fine_column) {
  const auto locate = [](int fine, int count) {
    const double position = std::clamp((fine - 0.5) / 2.0, 0.0, static_cast<double>(count - 1));
    const int first = std::min(static_cast<int>(position), std::max(0, count - 2));
    return std::pair(first, position - first);
  };
  const auto [row, down] = locate(fine_row, coarse.rows);
  const auto [column, right] = locate(fine_column, coarse.columns);
  const int next_row = std::min(row + 1, coarse.rows - 1);
  const int next_column = std::min(column + 1, coarse.columns - 1);
  const auto at = [&coarse](int r, int c) {
    return static_cast<double>(coarse.heights[index_of(r, c, coarse.columns)]);
  };
  const double upper = at(row, column) + right * (at(row, next_column) - at(row, column));
  const double lower = at(next_row, column) + right * (at(next_row, next_column) - at(next_row, column));
  return static_cast<std::int16_t>(std::lround(upper + down * (lower - upper)));
}

}  // namespace

void fill_voids(HeightGrid& grid) {
  if (std::find(grid.heights.begin(), grid.heights.end(), kVoidPost) == grid.heights.end()) return;
  if (grid.rows == 1 && grid.columns == 1) {
    grid.heights[0] = 0;
    return;
  }
  HeightGrid coarse = halved(grid);
  fill_voids(coarse);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      std::int16_t& height = grid.heights[index_of(row, column, grid.columns)];
      if (height == kVoidPost) height = between(coarse, row, column);
    }
}

}  // namespace yars::model::terrain
