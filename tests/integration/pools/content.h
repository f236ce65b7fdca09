// SPDX-License-Identifier: Apache-2.0
// What a chunk has to contain. subscriber.c and fastdds.cpp compute the same on their own.

#pragma once

#include <cstddef>
#include <cstdint>

namespace pool_content {

inline std::uint64_t next_word(std::uint64_t word) noexcept {
  return word * 6364136223846793005ULL + 1442695040888963407ULL;
}

template <class Chunk>
void fill(Chunk& chunk, std::uint64_t index) noexcept {
  chunk.index = index;
  std::uint64_t word = index;
  for (auto& one : chunk.words) {
    one = word = next_word(word);
  }
}

template <class Chunk>
bool is_whole(const Chunk& chunk) noexcept {
  std::uint64_t word = chunk.index;
  for (const auto& one : chunk.words) {
    word = next_word(word);
    if (one != word) {
      return false;
    }
  }
  return true;
}

}  // namespace pool_content
