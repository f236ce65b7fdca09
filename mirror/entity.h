// SPDX-License-Identifier: Apache-2.0
// A DDS entity that is deleted with its holder, and what a DDS return code means.

#pragma once

#include <dds/dds.h>

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

}  // namespace indurop::mirror
