// Row of the ledger of outside numbers, docs/truth.md: a number that is not ours next to the number of YARS.
// A test calls expect_row() once for each row. Where the environment variable YARS_LEDGER names a file, the row is also
// appended to it, as a line of fields separated by tabs; ledger.py makes docs/truth.md of these lines.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace yars::truth {

struct Row {
  std::string topic;       // heading of the rows on one subject
  std::string term;        // what is compared, with its inputs; no two rows have the same
  double outside = 0.0;    // value of the source
  double tolerance = 0.0;  // greatest difference, in the same unit
  std::string unit;        // "" for a ratio
  std::string source;      // document with its table, equation or page; or a file of the shared data
  std::string why;         // why the tolerance is not smaller
};

// The file of YARS_LEDGER, emptied by the first row of a run; null without the variable.
inline std::FILE* ledger_file() {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  static const std::unique_ptr<std::FILE, Close> file([] {
    const char* const path = std::getenv("YARS_LEDGER");
    return path == nullptr ? nullptr : std::fopen(path, "w");
  }());
  return file.get();
}

inline void expect_row(const Row& row, double ours) {
  EXPECT_LE(std::abs(ours - row.outside), row.tolerance)
      << row.topic << ", " << row.term << ": outside " << row.outside << ", YARS " << ours << " " << row.unit << " ("
      << row.source << ")";
  std::FILE* const file = ledger_file();
  if (file == nullptr) return;
  std::fprintf(file, "%s\t%s\t%.15g\t%.15g\t%.9g\t%s\t%s\t%s\n", row.topic.c_str(), row.term.c_str(), row.outside, ours,
               row.tolerance, row.unit.c_str(), row.source.c_str(), row.why.c_str());
  std::fflush(file);
}

}  // namespace yars::truth
