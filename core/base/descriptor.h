// SPDX-License-Identifier: Apache-2.0
// An open file descriptor, closed at the end of its scope.

#pragma once

#include <unistd.h>

#include <utility>

namespace indurop::base {

class Descriptor {
 public:
  Descriptor() = default;
  // Takes ownership of `number`; negative: nothing is open.
  explicit Descriptor(int number) noexcept : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { (void)close(); }

  [[nodiscard]] int get() const noexcept { return number_; }
  [[nodiscard]] bool is_open() const noexcept { return number_ >= 0; }
  // Returns 0, or -1 with errno: some file systems report only here that a write has failed.
  int close() noexcept {
    const int number = std::exchange(number_, -1);
    return number >= 0 ? ::close(number) : 0;
  }

 private:
  int number_ = -1;
};

}  // namespace indurop::base
