// SPDX-License-Identifier: Apache-2.0
// A DDS entity that is deleted with its holder, what a DDS return code means, and the loop that empties a reader.

#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace indurop::mirror {

class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) noexcept : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;
  ~Entity() { reset(); }

  void reset() noexcept {
    if (handle_ > 0) {
      (void)dds_delete(handle_);
    }
    handle_ = 0;
  }
  [[nodiscard]] dds_entity_t get() const noexcept { return handle_; }
  [[nodiscard]] bool ok() const noexcept { return handle_ > 0; }
  [[nodiscard]] std::string why() const { return dds_strretcode(-handle_); }

 private:
  dds_entity_t handle_ = 0;
};

// Takes all samples of a reader; `use` gets each with its information. Without valid data a sample holds its key only.
template <class Sample, class Use>
void take_all(dds_entity_t reader, Use use) {
  constexpr std::uint32_t kAtOnce = 32;
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  for (;;) {
    samples[0] = nullptr;  // lend us memory
    const int count = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count <= 0) {
      return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      use(*static_cast<const Sample*>(samples[i]), infos[i]);
    }
    (void)dds_return_loan(reader, samples.data(), count);
  }
}

}  // namespace indurop::mirror
