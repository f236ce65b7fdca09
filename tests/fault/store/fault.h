// SPDX-License-Identifier: Apache-2.0
// What the fault tests share: memory all their processes see, how long to go on, and a random moment to strike.

#pragma once

#include <sys/mman.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <random>
#include <thread>

#include "tests/support/forked.h"
#include "tests/unit/store/vars/test_schema.h"

namespace indurop::vars::test {

// Made before forking; zero-initialised T.
template <class T>
class Shared {
 public:
  Shared() : value_(new (::mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) T{}) {}
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() { ::munmap(value_, sizeof(T)); }
  T* operator->() const { return value_; }
  T& operator*() const { return *value_; }

 private:
  T* value_;
};

class Duration {
 public:
  Duration() {
    const char* const wanted = std::getenv("INDUROP_FAULT_SECONDS");
    const double seconds = wanted == nullptr ? 1.0 : std::atof(wanted);
    end_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
  }
  [[nodiscard]] bool over() const { return std::chrono::steady_clock::now() > end_; }

 private:
  std::chrono::steady_clock::time_point end_;
};

inline void wait_a_random_moment(std::mt19937& random, int longest_us) {
  std::this_thread::sleep_for(std::chrono::microseconds(random() % static_cast<unsigned>(longest_us)));
}

}  // namespace indurop::vars::test
