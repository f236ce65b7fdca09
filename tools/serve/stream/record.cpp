// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/record.h"

#include <algorithm>
#include <cstring>

namespace indurop::serve {
namespace {

constexpr std::uint8_t kVersion = 1;
constexpr std::uint8_t kValues = 1;
constexpr std::uint16_t kAlive = 1;
constexpr std::uint16_t kAnyForced = 2;

template <class T>
void put(std::vector<std::uint8_t>& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

Record::Record(const std::vector<tools::Item>& items) {
  constexpr std::size_t kMostAlign = 8;
  std::size_t end = kHeadSize;
  for (const tools::Item& item : items) {
    const std::size_t align = std::clamp<std::size_t>(item.place.type.align, 1, kMostAlign);
    const std::size_t begin = (end + align - 1) / align * align;
    offsets_.push_back(begin);
    end = begin + item.place.type.size();
  }
  quality_ = end;
  bytes_.resize(end + items.size());
}

void Record::set_head(const RecordHead& head) {
  const auto flags = static_cast<std::uint16_t>((head.alive ? kAlive : 0U) | (head.forced ? kAnyForced : 0U));
  constexpr std::size_t kFlagsAt = 2;
  constexpr std::size_t kStreamAt = 4;
  constexpr std::size_t kSeqAt = 8;
  constexpr std::size_t kTimeAt = 16;
  constexpr std::size_t kWallAt = 24;
  put(bytes_, 0, kVersion);
  put(bytes_, 1, kValues);
  put(bytes_, kFlagsAt, flags);
  put(bytes_, kStreamAt, head.stream);
  put(bytes_, kSeqAt, head.seq);
  put(bytes_, kTimeAt, head.time_ns);
  put(bytes_, kWallAt, head.wall_ns);
}

bool Record::set_value(std::size_t i, std::span<const std::uint8_t> value) {
  std::uint8_t* const to = bytes_.data() + offsets_[i];
  if (std::memcmp(to, value.data(), value.size()) == 0) {
    return false;
  }
  std::memcpy(to, value.data(), value.size());
  return true;
}

void Record::set_quality(std::size_t i, Quality quality, bool forced) {
  bytes_[quality_ + i] = static_cast<std::uint8_t>(static_cast<unsigned>(quality) | (forced ? kForced : 0U));
}

}  // namespace indurop::serve
