// SPDX-License-Identifier: Apache-2.0
// What changed in blocks of memory since they were loaded, as bytes that another process puts back. The blocks of both
// were loaded from the same files and are laid out alike, so constants and what was set up need not be taken: they are
// what has not changed. Addresses that changed lead to one of the blocks, and are moved along with it. Not real-time
// safe.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace indurop::robot {

class KeptImage {
 public:
  // Blocks are added once, in the same order in each process, and stay where they are. A block whose contents change;
  // begin and size are multiples of 8.
  void add(void* begin, std::size_t bytes);
  // A block that does not change: only addresses lead to it.
  void add_constant(const void* begin, std::size_t bytes);
  // Called when all is loaded, and before anything changes. `mark`: differs if a type of the blocks has another layout.
  void begin(std::uint64_t mark);

  // Writes what has changed. Returns the number of bytes; 0: there is not enough room. A thread may change the blocks
  // meanwhile: then the bytes are of no use, but nothing else happens.
  [[nodiscard]] std::size_t save(std::span<std::byte> to) const noexcept;
  // Puts bytes of save() back. Returns false, and changes nothing, if they are of other blocks.
  [[nodiscard]] bool restore(std::span<const std::byte> bytes) noexcept;

 private:
  using Word = std::uint64_t;
  struct Block {
    const Word* begin = nullptr;
    std::size_t words = 0;
    std::size_t first = 0;  // index in `first_`; of a constant block: kConstant
  };
  // What precedes the words of a change in the bytes; zero words: the end.
  struct Run {
    std::uint32_t block = 0;
    std::uint32_t words = 0;
    std::uint64_t at = 0;
  };
  static constexpr std::size_t kConstant = SIZE_MAX;

  [[nodiscard]] bool fits(std::span<const Word> from) const noexcept;
  [[nodiscard]] Word moved(Word word, std::span<const Word> places) const noexcept;
  [[nodiscard]] std::size_t head() const noexcept { return 2 + blocks_.size(); }
  void reset() noexcept;

  std::uint64_t mark_ = 0;
  std::vector<Block> blocks_;
  std::vector<Word> first_;  // the contents after loading
};

}  // namespace indurop::robot
