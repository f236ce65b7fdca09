// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/kept_image.h"

#include <cstring>

namespace indurop::robot {
namespace {

constexpr std::size_t kWordBytes = sizeof(std::uint64_t);

// Another thread may write meanwhile.
__attribute__((no_sanitize("thread"))) std::uint64_t read_racing(const std::uint64_t* word) noexcept {
  return *static_cast<const volatile std::uint64_t*>(word);
}
__attribute__((no_sanitize("thread"))) void write_racing(const std::uint64_t* word, std::uint64_t value) noexcept {
  auto* const to =
      const_cast<std::uint64_t*>(word);  // NOLINT(cppcoreguidelines-pro-type-const-cast): of a block that changes
  *static_cast<volatile std::uint64_t*>(to) = value;
}

}  // namespace

void KeptImage::add(void* begin, std::size_t bytes) {
  blocks_.push_back({static_cast<const Word*>(begin), bytes / kWordBytes, 0});
}

void KeptImage::add_constant(const void* begin, std::size_t bytes) {
  blocks_.push_back({static_cast<const Word*>(begin), bytes / kWordBytes, kConstant});
}

void KeptImage::begin(std::uint64_t mark) {
  mark_ = mark;
  for (Block& block : blocks_) {
    mark_ = mark_ * 31 + block.words;
    if (block.first != kConstant) {
      block.first = first_.size();
      for (std::size_t i = 0; i < block.words; ++i) {
        first_.push_back(read_racing(block.begin + i));
      }
    }
  }
}

// The mark and the number of blocks, the place of each block, then the changes.
std::size_t KeptImage::save(std::span<std::byte> to) const noexcept {
  std::size_t at = 0;
  const auto put = [&](const auto& value) noexcept {
    const bool room = sizeof value <= to.size() - at;
    if (room) {
      std::memcpy(to.data() + at, &value, sizeof value);
    }
    at += room ? sizeof value : 0;
    return room;
  };
  bool room = put(mark_) && put(static_cast<Word>(blocks_.size()));
  for (const Block& block : blocks_) {
    room = room && put(static_cast<Word>(reinterpret_cast<std::uintptr_t>(block.begin)));
  }
  for (std::uint32_t b = 0; room && b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    for (std::size_t i = 0; room && block.first != kConstant && i < block.words;) {
      if (read_racing(block.begin + i) == first_[block.first + i]) {
        ++i;
        continue;
      }
      Run run{b, 0, i};
      const std::size_t place = at;
      room = put(run);
      for (Word word = 0; room && i < block.words && (word = read_racing(block.begin + i)) != first_[block.first + i];
           ++i, ++run.words) {
        room = put(word);
      }
      std::memcpy(to.data() + place, &run, room ? sizeof run : 0);
    }
  }
  return room && put(Run{}) ? at : 0;
}

// Returns whether the changes are of these blocks.
bool KeptImage::fits(std::span<const Word> from) const noexcept {
  if (from.size() < head() || from[0] != mark_ || from[1] != blocks_.size()) {
    return false;
  }
  for (from = from.subspan(head()); from.size() >= 2;) {
    Run run;
    std::memcpy(static_cast<void*>(&run), from.data(), sizeof run);
    from = from.subspan(2);
    if (run.words == 0) {
      return true;
    }
    if (run.block >= blocks_.size() || blocks_[run.block].first == kConstant || run.words > from.size() ||
        run.at > blocks_[run.block].words || run.words > blocks_[run.block].words - run.at) {
      return false;
    }
    from = from.subspan(run.words);
  }
  return false;
}

// An address in a block, or at its end as that of a vector, leads there in this process; everything else is no address:
// a number of these bits would be smaller than 1e-309, or a pair of whole numbers of which one is an exact part of an
// address.
KeptImage::Word KeptImage::moved(Word word, std::span<const Word> places) const noexcept {
  const auto leads = [&](std::size_t b, std::size_t end) {
    return word >= places[b] && word - places[b] < blocks_[b].words * kWordBytes + end;
  };
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (leads(b, end)) {
        return word - places[b] + reinterpret_cast<std::uintptr_t>(blocks_[b].begin);
      }
    }
  }
  return word;
}

void KeptImage::reset() noexcept {
  for (const Block& block : blocks_) {
    for (std::size_t i = 0; block.first != kConstant && i < block.words; ++i) {
      write_racing(block.begin + i, first_[block.first + i]);
    }
  }
}

bool KeptImage::restore(std::span<const std::byte> bytes) noexcept {
  const std::vector<Word> copy = [&] {
    std::vector<Word> words(bytes.size() / kWordBytes);
    std::memcpy(words.data(), bytes.data(), words.size() * kWordBytes);
    return words;
  }();
  std::span<const Word> from(copy);
  if (!fits(from)) {
    return false;
  }
  reset();
  const auto places = from.subspan(2, blocks_.size());
  for (from = from.subspan(head());;) {
    Run run;
    std::memcpy(static_cast<void*>(&run), from.data(), sizeof run);
    if (run.words == 0) {
      return true;
    }
    for (std::size_t i = 0; i < run.words; ++i) {
      write_racing(blocks_[run.block].begin + run.at + i, moved(from[2 + i], places));
    }
    from = from.subspan(2 + run.words);
  }
}

}  // namespace indurop::robot
