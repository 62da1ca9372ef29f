// One scan and one patch map over the built-in hills, by the library <yars/radar.hpp>.
//   c++ -std=c++20 first_picture.cpp $(pkg-config --cflags --libs yars-radar) -o first_picture
#include <cstdio>
#include <yars/radar.hpp>

int failed(const yars::Error& error) {
  std::fprintf(stderr, "%s\n", error.message().c_str());
  return 1;
}

int main(int argc, char** argv) {
  const auto radar = yars::Radar::make({.preset = "standard"});
  if (!radar) return failed(radar.error());
  const auto terrain = yars::Terrain::open({.folder = argc > 1 ? argv[1] : ""});
  if (!terrain) return failed(terrain.error());

  yars::ScanRequest scan;
  scan.range_nm = 20.0;
  const auto sweeps = radar->scan(*terrain, scan);
  if (!sweeps) return failed(sweeps.error());
  std::printf("scan of %zu sweeps, hash %llu\n", sweeps->sweeps(), static_cast<unsigned long long>(sweeps->hash()));

  yars::PatchRequest map;
  map.window_nm = 1.3;
  const auto patch = radar->patch(*terrain, map);
  if (!patch) return failed(patch.error());
  std::printf("map of %d pixels, hash %llu\n", patch->size(), static_cast<unsigned long long>(patch->hash()));
}
