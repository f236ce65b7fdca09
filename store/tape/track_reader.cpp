// SPDX-License-Identifier: Apache-2.0
#include "store/tape/track_reader.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/rt/relaxed.h"

namespace indurop::tape {
namespace {

using rt::kRelaxed;

EntryHead head_of(std::uint64_t word) noexcept {
  return std::bit_cast<EntryHead>(word);
}

}  // namespace

TrackReader::TrackReader(const Source& source, std::span<const TapeVariable> variables, bool from_start)
    : shared_(source.shared),
      words_(source.words),
      mask_(source.size - 1),
      module_(source.module),
      variables_(variables),
      shown_(variables.size()) {
  const std::uint64_t head = shared_->head.load(std::memory_order_acquire);
  at_ = from_start ? oldest(head) : head;
}

// Position of the oldest run that is certainly still available.
std::uint64_t TrackReader::oldest(std::uint64_t head) const noexcept {
  const std::uint64_t claimed = shared_->claimed.load(kRelaxed);
  if (claimed <= mask_ + 1) {
    return 0;
  }
  // One part of the ring more, because the writer continues meanwhile.
  const std::uint64_t from = claimed - (mask_ + 1) + (mask_ + 1) / kMarks;
  std::uint64_t found = head;
  for (const auto& mark : shared_->marks) {
    const std::uint64_t at = mark.load(kRelaxed);
    found = at >= from && at < found ? at : found;
  }
  return found;
}

bool TrackReader::copy(std::uint64_t from, std::uint64_t count, std::vector<std::uint64_t>& to) const {
  for (std::uint64_t i = 0; i < count; ++i) {
    to.push_back(__atomic_load_n(words_ + ((from + i) & mask_), __ATOMIC_RELAXED));
  }
  std::atomic_thread_fence(std::memory_order_acquire);
  return shared_->claimed.load(kRelaxed) - from <= mask_ + 1;
}

// The words of a run do not move from now on.
void TrackReader::point_to(const std::vector<std::pair<EntryHead, std::size_t>>& found, Run& run) const {
  for (const auto& [entry, place] : found) {
    const auto* const at = reinterpret_cast<const std::uint8_t*>(run.words.data() + place);
    if (entry.kind == EntryKind::Answer) {
      run.answers.push_back({static_cast<std::int64_t>(run.words[place]), {at + sizeof(std::uint64_t), entry.which}});
    } else if (entry.which < shown_) {
      run.values.push_back({entry.kind, entry.which, {at, variables_[entry.which].size}});
    }
  }
}

TrackReader::Reading TrackReader::read_run(std::uint64_t head, Run& run, std::uint64_t& length) const {
  run.words.clear();
  run.values.clear();
  run.clock.clear();
  run.answers.clear();
  run.module = module_;
  std::vector<std::pair<EntryHead, std::size_t>> found;
  for (std::uint64_t at = at_; at < head;) {
    const std::size_t begin = run.words.size();
    if (!copy(at, 1, run.words)) {
      return Reading::Overtaken;
    }
    const EntryHead entry = head_of(run.words[begin]);
    const bool is_run = entry.kind == EntryKind::Run;
    const bool is_value = !is_run && entry.kind != EntryKind::Clock && entry.kind != EntryKind::Answer;
    if (is_value && entry.which >= variables_.size()) {
      return Reading::Corrupt;
    }
    std::uint64_t words = 1;
    if (is_run) {
      words = kRunWords;
    } else if (is_value) {
      words = words_of(variables_[entry.which].size);
    } else if (entry.kind == EntryKind::Answer) {
      words = 1 + words_of(entry.which);
    }
    if (at + 1 + words > head || words > mask_) {
      return Reading::Corrupt;
    }
    if (!copy(at + 1, words, run.words)) {
      return Reading::Overtaken;
    }
    at += 1 + words;
    if (is_run) {
      run.flags = entry.which;
      std::array<std::uint64_t, kRunWords> tail{};
      std::copy_n(run.words.begin() + static_cast<std::ptrdiff_t>(begin) + 1, kRunWords, tail.begin());
      run.tail = std::bit_cast<RunTail>(tail);
      length = at - at_;
      point_to(found, run);
      return Reading::Whole;
    }
    if (entry.kind == EntryKind::Clock) {
      run.clock.push_back(static_cast<std::int64_t>(run.words[begin + 1]));
    } else {
      found.emplace_back(entry, begin + 1);
    }
  }
  return Reading::Corrupt;
}

bool TrackReader::next(Run& run, std::uint64_t end) {
  while (at_ < end) {
    std::uint64_t length = 0;
    if (read_run(end, run, length) != Reading::Whole) {
      const std::uint64_t again = oldest(end);
      at_ = again > at_ ? again : end;
      continue;
    }
    at_ += length;
    lost_ += any_ ? run.tail.number - next_number_ : 0;
    any_ = true;
    next_number_ = run.tail.number + 1;
    return true;
  }
  return false;
}

}  // namespace indurop::tape
