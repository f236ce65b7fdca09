// SPDX-License-Identifier: Apache-2.0
// A reader and a writer may want the same chunk. The reader first says that it holds it and then checks that the chunk
// is still the one it found; the writer first claims the chunk and then checks that no seat holds it. Both steps are
// sequentially consistent, so that at least one of the two sees the other and lets the chunk go. These four accesses
// are the only ones that need more than release and acquire.

#include "store/pools/chunks.h"

#include <algorithm>

#include "core/rt/relaxed.h"

namespace indurop::pools {
namespace {

using rt::kRelaxed;

// A reader tries again when writers have used the chunk again that it was about to hold: all others have been
// published in between.
constexpr int kTries = 8;

void raise_to(Atomic<std::uint64_t>& highest, std::uint64_t number) noexcept {
  std::uint64_t known = highest.load(kRelaxed);
  while (known < number && !highest.compare_exchange_weak(known, number, kRelaxed)) {
  }
}

}  // namespace

std::optional<Chunks::Found> Chunks::newest() const noexcept {
  Found found;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const std::uint64_t state = header_->states[i].load(std::memory_order_acquire);
    if (phase_of(state) == Phase::Published && state > found.state) {
      found = {i, state};
    }
  }
  return found.state == kFree ? std::nullopt : std::optional(found);
}

std::optional<Chunks::Found> Chunks::first_after(std::uint64_t number) const noexcept {
  std::optional<Found> found;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const std::uint64_t state = header_->states[i].load(std::memory_order_acquire);
    if (phase_of(state) == Phase::Published && number_of(state) > number && (!found || state < found->state)) {
      found = {i, state};
    }
  }
  return found;
}

bool Chunks::is_held(std::uint32_t chunk) const noexcept {
  return std::ranges::any_of(header_->holds[chunk], [](const auto& holds) { return holds.load() != 0; });
}

// `tried`: a bit for each chunk that is out of question.
std::optional<Chunks::Found> Chunks::to_fill(std::uint64_t tried) const noexcept {
  std::optional<Found> found;
  std::uint64_t newest = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const std::uint64_t state = header_->states[i].load(std::memory_order_acquire);
    if (phase_of(state) == Phase::Filling) {
      continue;
    }
    newest = std::max(newest, state);
    if ((tried >> i & 1U) == 0 && (!found || state < found->state) && !is_held(i)) {
      found = {i, state};
    }
  }
  const bool is_newest = found && found->state != kFree && found->state == newest;
  return is_newest ? std::nullopt : found;
}

std::optional<std::uint32_t> Chunks::take(std::uint32_t seat) noexcept {
  std::uint64_t tried = 0;
  while (const auto found = to_fill(tried)) {  // ends: each chunk is tried once
    tried |= std::uint64_t{1} << found->chunk;
    Atomic<std::uint64_t>& state = header_->states[found->chunk];
    std::uint64_t known = found->state;
    if (!state.compare_exchange_strong(known, filled_by(seat))) {
      continue;
    }
    if (!is_held(found->chunk)) {
      return found->chunk;
    }
    known = filled_by(seat);
    state.compare_exchange_strong(known, found->state, std::memory_order_release, kRelaxed);
  }
  header_->without_a_chunk.fetch_add(1, kRelaxed);
  header_->seats[seat].without_a_chunk.fetch_add(1, kRelaxed);
  return std::nullopt;
}

std::uint64_t Chunks::publish(std::uint32_t seat, std::uint32_t chunk, rt::MonoTime now) noexcept {
  Atomic<std::uint64_t>& state = header_->states[chunk];
  std::uint64_t known = filled_by(seat);
  if (state.load(kRelaxed) != known) {
    return 0;
  }
  header_->published_ns[chunk].store(rt::to_ns(now), kRelaxed);
  const std::uint64_t number = header_->numbers.fetch_add(1, kRelaxed) + 1;
  if (!state.compare_exchange_strong(known, published_as(number), std::memory_order_release, kRelaxed)) {
    return 0;
  }
  header_->seats[seat].published.fetch_add(1, kRelaxed);
  return number;
}

void Chunks::discard(std::uint32_t seat, std::uint32_t chunk) noexcept {
  std::uint64_t known = filled_by(seat);
  header_->states[chunk].compare_exchange_strong(known, kFree, std::memory_order_release, kRelaxed);
}

// Holds what `search` finds, if it finds the same again when that is held: then nothing was published or used again in
// between that the search would have preferred. The last try is content with a chunk that is whole.
template <class Search>
std::optional<Chunks::Found> Chunks::hold(std::uint32_t seat, Search search) noexcept {
  for (int tries = 1; tries <= kTries; ++tries) {
    const std::optional<Found> found = search();
    if (!found) {
      return std::nullopt;
    }
    header_->holds[found->chunk][seat].fetch_add(1);
    if (header_->states[found->chunk].load() == found->state) {
      const std::optional<Found> again = tries < kTries ? search() : found;
      if (again && again->state == found->state) {
        return found;
      }
    }
    release(seat, found->chunk);
  }
  return std::nullopt;
}

std::optional<Held> Chunks::latest(std::uint32_t seat) noexcept {
  const auto found = hold(seat, [this] { return newest(); });
  if (!found) {
    return std::nullopt;
  }
  raise_to(header_->seats[seat].seen, number_of(found->state));
  return Held{found->chunk, number_of(found->state)};
}

std::optional<Held> Chunks::next(std::uint32_t seat) noexcept {
  Seat& reader = header_->seats[seat];
  for (int tries = 0; tries < kTries; ++tries) {  // more than one if several threads of the seat call it
    std::uint64_t seen = reader.seen.load(kRelaxed);
    const auto found = hold(seat, [this, seen] { return seen == 0 ? newest() : first_after(seen); });
    if (!found) {
      return std::nullopt;
    }
    const std::uint64_t number = number_of(found->state);
    const std::uint64_t missed = seen == 0 ? 0 : number - seen - 1;
    if (reader.seen.compare_exchange_strong(seen, number, kRelaxed)) {
      reader.missed.fetch_add(missed, kRelaxed);
      header_->missed.fetch_add(missed, kRelaxed);
      return Held{found->chunk, number};
    }
    release(seat, found->chunk);
  }
  return std::nullopt;
}

void Chunks::release(std::uint32_t seat, std::uint32_t chunk) noexcept {
  header_->holds[chunk][seat].fetch_sub(1, std::memory_order_release);
}

rt::MonoTime Chunks::time_of(std::uint32_t chunk) const noexcept {
  return rt::mono_time(header_->published_ns[chunk].load(kRelaxed));
}

std::uint32_t Chunks::release_all(std::uint32_t seat) noexcept {
  std::uint32_t released = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const bool held = header_->holds[i][seat].exchange(0, std::memory_order_acq_rel) != 0;
    std::uint64_t known = filled_by(seat);
    const bool filled = header_->states[i].compare_exchange_strong(known, kFree, std::memory_order_acq_rel, kRelaxed);
    released += held || filled ? 1U : 0U;
  }
  return released;
}

bool Chunks::has_any(std::uint32_t seat) const noexcept {
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (header_->holds[i][seat].load(kRelaxed) != 0 || header_->states[i].load(kRelaxed) == filled_by(seat)) {
      return true;
    }
  }
  return false;
}

std::uint32_t Chunks::free() const noexcept {
  const auto latest = newest();
  std::uint32_t free = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const bool filling = phase_of(header_->states[i].load(kRelaxed)) == Phase::Filling;
    free += !filling && !(latest && latest->chunk == i) && !is_held(i) ? 1U : 0U;
  }
  return free;
}

}  // namespace indurop::pools
