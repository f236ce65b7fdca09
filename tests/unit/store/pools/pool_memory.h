// SPDX-License-Identifier: Apache-2.0
// The chunks of a pool in memory that forked children share, filled so that a chunk that is not whole is noticed.

#pragma once

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdint>
#include <new>

#include "store/pools/chunks.h"

namespace indurop::pools::test {

inline constexpr std::size_t kWords = 16;  // of a chunk

// All words of a chunk that was filled are equal. The accesses are atomic for the thread sanitizer only.
struct Content {
  std::uint64_t words[kWords];
  void fill(std::uint64_t value) noexcept {
    for (std::uint64_t& word : words) {
      __atomic_store_n(&word, value, __ATOMIC_RELAXED);
    }
  }
  // Returns the value; 0 if the content is of two of them.
  [[nodiscard]] std::uint64_t value() const noexcept {
    const std::uint64_t first = __atomic_load_n(&words[0], __ATOMIC_RELAXED);
    for (const std::uint64_t& word : words) {
      if (__atomic_load_n(&word, __ATOMIC_RELAXED) != first) {
        return 0;
      }
    }
    return first;
  }
};

struct Memory {
  PoolHeader header{};
  Content content[kMaxChunks]{};
};

class SharedPool {
 public:
  explicit SharedPool(std::uint32_t chunks)
      : memory_(static_cast<Memory*>(
            ::mmap(nullptr, sizeof(Memory), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))),
        chunks_(memory_->header, chunks) {}
  SharedPool(const SharedPool&) = delete;
  SharedPool& operator=(const SharedPool&) = delete;
  ~SharedPool() { ::munmap(memory_, sizeof(Memory)); }

  Chunks& operator*() noexcept { return chunks_; }
  Chunks* operator->() noexcept { return &chunks_; }
  [[nodiscard]] Memory& memory() const noexcept { return *memory_; }
  [[nodiscard]] PoolHeader& header() const noexcept { return memory_->header; }
  [[nodiscard]] Content& content(std::uint32_t chunk) const noexcept { return memory_->content[chunk]; }

 private:
  Memory* memory_;
  Chunks chunks_;
};

// What holds as long as no process has a chunk in its hand: all are free or published and whole, and all but the newest
// can be taken.
inline void expect_at_rest(Memory& memory, std::uint32_t count) {
  Chunks chunks(memory.header, count);
  std::uint32_t published = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t state = memory.header.states[i].load();
    ASSERT_NE(phase_of(state), Phase::Filling) << "chunk " << i;
    ASSERT_FALSE(chunks.is_held(i)) << "chunk " << i;
    if (phase_of(state) == Phase::Published) {
      ++published;
      ASSERT_NE(memory.content[i].value(), 0U) << "chunk " << i << " is published and not whole";
    }
  }
  ASSERT_EQ(chunks.free(), published == 0 ? count : count - 1);
}

}  // namespace indurop::pools::test
