#include "model/terrain/gdal/gdal_library.hpp"

#include <dlfcn.h>

#include <string>

namespace yars::model::terrain::gdal {

// NOLINTBEGIN(cppcoreguidelines-macro-usage,bugprone-macro-parentheses)
#define YARS_DEFINE(name) decltype(&::name) name = nullptr;
YARS_GDAL_FUNCTIONS(YARS_DEFINE)
YARS_PROJ_FUNCTIONS(YARS_DEFINE)
#undef YARS_DEFINE

namespace {

template <typename Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

// The reason why not both libraries are there; empty: they are. The libraries stay loaded until the program ends.
std::string load() {
  const auto reason = [] {
    const char* const text = dlerror();
    return std::string(text == nullptr ? "an unknown failure" : text);
  };
  void* const proj = dlopen(YARS_PROJ_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  if (proj == nullptr) return reason();
  void* const gdal = dlopen(YARS_GDAL_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  if (gdal == nullptr) return reason();
#define YARS_FIND_GDAL(name) \
  if (!find(gdal, #name, name)) return reason();
#define YARS_FIND_PROJ(name) \
  if (!find(proj, #name, name)) return reason();
  YARS_GDAL_FUNCTIONS(YARS_FIND_GDAL)
  YARS_PROJ_FUNCTIONS(YARS_FIND_PROJ)
#undef YARS_FIND_GDAL
#undef YARS_FIND_PROJ
  CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");  // GDAL writes no .aux.xml beside the user's files
  GDALAllRegister();
  return {};
}
// NOLINTEND(cppcoreguidelines-macro-usage,bugprone-macro-parentheses)

}  // namespace

error::Expected<void> load_gdal(const std::string& subject) {
  static const std::string why_not = load();
  if (why_not.empty()) return {};
  return error::fail(subject,
                     "the libraries GDAL and PROJ of this build (" YARS_GDAL_LIBRARY ", " YARS_PROJ_LIBRARY ")",
                     why_not, "install the packages " YARS_GDAL_PACKAGES);
}

}  // namespace yars::model::terrain::gdal
