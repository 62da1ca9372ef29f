// Numbers on a fan: grows, never shrinks, does not keep what it held; each row of a strip on a cache line of its own.
#pragma once

#include <cstddef>

#include "lib/memory/line_vector.hpp"

namespace yars::model::hrm {

template <class Number>
class FanArray {
 public:
  void resize(std::size_t size) {
    if (size <= numbers_.size()) return;
    numbers_ = {};  // first, so that both are not there at once
    numbers_.resize(size);
  }
  Number* data() { return numbers_.data(); }
  const Number* data() const { return numbers_.data(); }
  std::size_t size() const { return numbers_.size(); }

 private:
  memory::LineVector<Number> numbers_;
};

}  // namespace yars::model::hrm
