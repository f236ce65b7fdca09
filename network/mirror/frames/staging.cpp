// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/staging.h"

#include <algorithm>

namespace indurop::mirror {

void Staging::reset(std::span<const std::uint32_t> sizes) {
  parts_.clear();
  waiting_.clear();
  resize(sizes);
  sum_ = newest_ = newest_sum_ = 0;
  since_ns_ = 0;
}

void Staging::resize(std::span<const std::uint32_t> sizes) {
  parts_.resize(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    parts_[i].data.resize(sizes[i]);
  }
  waiting_.reserve(sizes.size());
}

Staging::Verdict Staging::arrived(std::uint32_t number, std::uint64_t update, std::uint64_t sum,
                                  std::span<const std::uint8_t> data, std::int64_t now_ns) {
  Part& part = parts_[number];
  if (update < part.update) {
    return Verdict::Old;
  }
  sum_ += update - part.update;
  part.update = update;
  if (update >= newest_) {
    newest_ = update;
    newest_sum_ = sum;
  }
  if (!part.data.empty()) {
    std::copy_n(data.begin(), part.data.size(), part.data.begin());
    if (!part.waits) {
      part.waits = true;
      waiting_.push_back(number);
    }
  }
  if (sum_ == newest_sum_) {
    since_ns_ = 0;
    return Verdict::Whole;
  }
  since_ns_ = since_ns_ == 0 ? now_ns : since_ns_;
  return now_ns - since_ns_ < kPatienceNs ? Verdict::Wait : Verdict::Overdue;
}

}  // namespace indurop::mirror
