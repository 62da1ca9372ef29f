#include "lib/failure/require.hpp"

#include <cstdio>
#include <cstdlib>

namespace yars::failure {

void requirement_broken(std::string_view expression, std::string_view values, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: requirement broken: %.*s (values: %.*s)\n", file, line,
               static_cast<int>(expression.size()), expression.data(), static_cast<int>(values.size()), values.data());
  std::abort();
}

}  // namespace yars::failure
