// SPDX-License-Identifier: Apache-2.0
#include "store/tape/follower.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/rt/relaxed.h"
#include "store/tape/check.h"

namespace indurop::tape {
namespace {

using rt::kRelaxed;

EntryHead head_of(std::uint64_t word) noexcept {
  return std::bit_cast<EntryHead>(word);
}

}  // namespace

Result<Follower> Follower::open(const std::string& node, bool from_start) {
  auto file = vars::ShmFile::open(vars::tape_file(node), vars::Mode::ReadOnly);
  if (!file) {
    return file.error();
  }
  auto index = index_tape({file->data(), file->size()});
  if (!index) {
    return index.error();
  }
  Follower follower(std::move(file).value(), std::move(index).value());
  follower.find_tracks();
  for (Place& place : follower.places_) {
    const std::uint64_t head = place.shared->head.load(std::memory_order_acquire);
    place.at = from_start ? oldest(place, head) : head;
  }
  return follower;
}

const TapeHeader& Follower::header() const noexcept {
  return header_of(file_.data());
}

void Follower::find_tracks() {
  const auto* shared = reinterpret_cast<const TapeTrack*>(file_.data() + index_.tracks_offset);
  for (const TapeIndex::Track& track : index_.tracks) {
    Place place;
    place.shared = shared++;
    place.words = reinterpret_cast<const std::uint64_t*>(file_.data() + track.data_offset);
    place.mask = track.words - 1;
    place.module = track.module;
    places_.push_back(place);
  }
}

std::span<const std::uint8_t> Follower::first_value(std::uint32_t variable) const noexcept {
  const TapeVariable& known = index_.variables[variable];
  return {reinterpret_cast<const std::uint8_t*>(file_.data() + known.first_offset), known.size};
}

Follower::Items Follower::items_of(std::size_t track) const noexcept {
  const TapeIndex::Track& known = index_.tracks[track];
  const std::span<const std::uint32_t> all(known.items);
  return {all.first(known.only_read), all.subspan(known.only_read)};
}

// Position of the oldest run that is certainly still available.
std::uint64_t Follower::oldest(const Place& place, std::uint64_t head) noexcept {
  const std::uint64_t claimed = place.shared->claimed.load(kRelaxed);
  if (claimed <= place.mask + 1) {
    return 0;
  }
  // One part of the ring more, because the writer continues meanwhile.
  const std::uint64_t from = claimed - (place.mask + 1) + (place.mask + 1) / kMarks;
  std::uint64_t found = head;
  for (const auto& mark : place.shared->marks) {
    const std::uint64_t at = mark.load(kRelaxed);
    found = at >= from && at < found ? at : found;
  }
  return found;
}

bool Follower::copy(const Place& place, std::uint64_t from, std::uint64_t count, std::vector<std::uint64_t>& to) {
  for (std::uint64_t i = 0; i < count; ++i) {
    to.push_back(__atomic_load_n(place.words + ((from + i) & place.mask), __ATOMIC_RELAXED));
  }
  std::atomic_thread_fence(std::memory_order_acquire);
  return place.shared->claimed.load(kRelaxed) - from <= place.mask + 1;
}

// The words of a run do not move from now on.
void Follower::point_to(const std::vector<std::pair<EntryHead, std::size_t>>& found, Run& run) const {
  for (const auto& [entry, place] : found) {
    const auto* const at = reinterpret_cast<const std::uint8_t*>(run.words.data() + place);
    if (entry.kind == EntryKind::Answer) {
      run.answers.push_back({static_cast<std::int64_t>(run.words[place]), {at + sizeof(std::uint64_t), entry.which}});
    } else {
      run.values.push_back({entry.kind, entry.which, {at, index_.variables[entry.which].size}});
    }
  }
}

Follower::Reading Follower::read_run(const Place& place, std::uint64_t head, Run& run, std::uint64_t& length) const {
  run.words.clear();
  run.values.clear();
  run.clock.clear();
  run.answers.clear();
  run.module = place.module;
  std::vector<std::pair<EntryHead, std::size_t>> found;
  for (std::uint64_t at = place.at; at < head;) {
    const std::size_t begin = run.words.size();
    if (!copy(place, at, 1, run.words)) {
      return Reading::Overtaken;
    }
    const EntryHead entry = head_of(run.words[begin]);
    const bool is_run = entry.kind == EntryKind::Run;
    const bool is_value = !is_run && entry.kind != EntryKind::Clock && entry.kind != EntryKind::Answer;
    if (is_value && entry.which >= index_.variables.size()) {
      return Reading::Corrupt;
    }
    std::uint64_t words = 1;
    if (is_run) {
      words = kRunWords;
    } else if (is_value) {
      words = words_of(index_.variables[entry.which].size);
    } else if (entry.kind == EntryKind::Answer) {
      words = 1 + words_of(entry.which);
    }
    if (at + 1 + words > head || words > place.mask) {
      return Reading::Corrupt;
    }
    if (!copy(place, at + 1, words, run.words)) {
      return Reading::Overtaken;
    }
    at += 1 + words;
    if (is_run) {
      run.flags = entry.which;
      std::array<std::uint64_t, kRunWords> tail{};
      std::copy_n(run.words.begin() + static_cast<std::ptrdiff_t>(begin) + 1, kRunWords, tail.begin());
      run.tail = std::bit_cast<RunTail>(tail);
      length = at - place.at;
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

bool Follower::next(std::size_t track, Run& run) {
  Place& place = places_[track];
  for (;;) {
    const std::uint64_t head = place.shared->head.load(std::memory_order_acquire);
    if (place.at >= head) {
      return false;
    }
    std::uint64_t length = 0;
    if (read_run(place, head, run, length) != Reading::Whole) {
      const std::uint64_t again = oldest(place, head);
      place.at = again > place.at ? again : head;
      continue;
    }
    place.at += length;
    place.lost += place.any ? run.tail.number - place.next_number : 0;
    place.any = true;
    place.next_number = run.tail.number + 1;
    return true;
  }
}

}  // namespace indurop::tape
