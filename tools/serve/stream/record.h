// SPDX-License-Identifier: Apache-2.0
// A binary frame: the bytes of all values of a stream at offsets that are sent once (docs/serve.md). Little endian, as
// are the machines that InduRoP runs on.

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/serve/boards/variable.h"

namespace indurop::serve {

static_assert(std::endian::native == std::endian::little);

struct RecordHead {
  bool alive = false;
  bool forced = false;
  std::uint32_t stream = 0;
  std::uint64_t seq = 0;
  std::int64_t time_ns = 0;
  std::int64_t wall_ns = 0;
};

class Record {
 public:
  static constexpr std::size_t kHeadSize = 40;
  static constexpr std::uint8_t kForced = 4;  // in a quality byte

  // Reserves space for values of these types, in their order.
  explicit Record(const std::vector<tools::Item>& items);

  [[nodiscard]] std::size_t offset(std::size_t i) const { return offsets_[i]; }
  [[nodiscard]] std::size_t quality_offset() const noexcept { return quality_; }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::span<const std::uint8_t> value(std::size_t i, std::size_t size) const {
    return std::span(bytes_).subspan(offsets_[i], size);
  }

  void set_head(const RecordHead& head);
  // Returns true if the value has changed.
  bool set_value(std::size_t i, std::span<const std::uint8_t> value);
  void set_quality(std::size_t i, Quality quality, bool forced);

 private:
  std::vector<std::size_t> offsets_;
  std::size_t quality_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace indurop::serve
