// Any bytes as an OpenFlight file: a model within limits, or an error. The input modifies a small file with all kinds
// of records in pieces of (offset in two bytes, length, bytes), so that the reader gets past its header. Input that
// begins with a header record is itself the file.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/model/scene/openflight/every_record.hpp"

using namespace yars::model::scene;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::byte> well_formed = every_record();
  static constexpr FlattenLimits kLimits{.triangles = 100'000, .vertices = 300'000, .visits = 1'000'000};
  std::vector<std::byte> file;
  if (size >= 4 && data[0] == 0 && data[1] == 1) {
    file.resize(size);
    std::memcpy(file.data(), data, size);
  } else {
    file = well_formed;
    const std::uint8_t* const end = data + size;
    while (end - data >= 3) {
      const std::size_t offset = (data[0] * 256U + data[1]) % file.size();
      const std::size_t length =
          std::min({std::size_t{data[2]}, static_cast<std::size_t>(end - data - 3), file.size() - offset});
      std::memcpy(file.data() + offset, data + 3, length);
      data += 3 + length;
    }
  }
  (void)read_openflight(file, "fuzz", kLimits);
  return 0;
}
