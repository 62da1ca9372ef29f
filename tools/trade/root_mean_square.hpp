// Mean square of what is added, as its root; NaN of nothing.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace yars::tools::trade {

class RootMeanSquare {
 public:
  void add(double value) {
    sum_ += value * value;
    ++count_;
  }
  double value() const {
    return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace yars::tools::trade
