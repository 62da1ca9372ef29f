// Numbers on a fan: grows, never shrinks, does not keep what it held; each row of a strip on a cache line of its own.
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>

namespace yars::model::hrm {

class FanArray {
 public:
  void resize(std::size_t size) {
    if (size <= size_) return;
    numbers_ = hwy::AllocateAligned<float>(size);
    size_ = size;
  }
  float* data() { return numbers_.get(); }
  const float* data() const { return numbers_.get(); }
  std::size_t bytes() const { return size_ * sizeof(float); }

 private:
  hwy::AlignedFreeUniquePtr<float[]> numbers_;
  std::size_t size_ = 0;
};

}  // namespace yars::model::hrm
