// SPDX-License-Identifier: Apache-2.0
#include "tests/support/weak_memory/memory.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace indurop::test::weak {
namespace {

// Steps that read and write no place, in the history of a thread.
enum Mark : std::uint64_t { kFence = 1, kLock, kUnlock, kFenceAll };

std::uint64_t mixed(std::uint64_t hash, std::uint64_t with) {
  hash ^= with + 0x9E3779B97F4A7C15ULL + (hash << 6U) + (hash >> 2U);
  hash *= 0xFF51AFD7ED558CCDULL;
  return hash ^ (hash >> 33U);
}

std::uint64_t bits_at(const void* place, std::size_t size) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, place, size);
  return bits;
}

bool acquires(int order) {
  return order == __ATOMIC_ACQUIRE || order == __ATOMIC_CONSUME || order == __ATOMIC_ACQ_REL ||
         order == __ATOMIC_SEQ_CST;
}
bool releases(int order) {
  return order == __ATOMIC_RELEASE || order == __ATOMIC_ACQ_REL || order == __ATOMIC_SEQ_CST;
}

}  // namespace

void Memory::Thread::note(std::uint64_t what) {
  history = mixed(history, what);
}

void Memory::reset(std::size_t threads) {
  threads_.assign(threads, {});
  places_.clear();
  mutexes_.clear();
  sequential_.clear();
  sequential_writes_.clear();
  knew_all_ = true;
}

void Memory::note_write(const void* place) {
  knew_all_ = !written_.insert(place).second && knew_all_;
}

bool Memory::is_free(const void* mutex) const {
  const auto found = mutexes_.find(mutex);
  return found == mutexes_.end() || !found->second.locked;
}

Memory::MessageId Memory::next_id(std::size_t thread) {
  constexpr unsigned kStepBits = 20;
  return static_cast<MessageId>(thread + 1) << kStepBits | ++threads_[thread].steps;
}

std::uint64_t Memory::state() const {
  std::uint64_t hash = 0;
  for (const Thread& thread : threads_) {
    hash = mixed(hash, thread.history);
  }
  for (const auto& [where, place] : places_) {
    hash = mixed(hash, reinterpret_cast<std::uintptr_t>(where));
    for (const Message& message : place) {
      hash = mixed(hash, message.id);
    }
  }
  for (const View* const view : {&sequential_, &sequential_writes_}) {
    for (const auto& [where, id] : *view) {
      hash = mixed(mixed(hash, reinterpret_cast<std::uintptr_t>(where)), id);
    }
    hash = mixed(hash, view->size());
  }
  return hash;
}

Memory::Place& Memory::at(const void* place, std::size_t size) {
  Place& found = places_[place];
  if (found.empty()) {
    found.push_back({kInitial, bits_at(place, size), {}, false});
  }
  return found;
}

std::size_t Memory::position(const Place& place, MessageId id) {
  const auto found =
      std::find_if(place.begin(), place.end(), [id](const Message& message) { return message.id == id; });
  return static_cast<std::size_t>(found - place.begin());
}

std::size_t Memory::seen_at(const View& view, const void* where, const Place& place) {
  const auto found = view.find(where);
  return found == view.end() ? 0 : position(place, found->second);
}

// A sequentially consistent access takes nothing that is older than the last such write, or than what was written
// before the last such fence.
std::size_t Memory::first_readable(const Thread& thread, const void* where, const Place& place, int order) const {
  const std::size_t seen = seen_at(thread.seen, where, place);
  return order != __ATOMIC_SEQ_CST || without_.no_sequential_accesses
             ? seen
             : std::max({seen, seen_at(sequential_writes_, where, place), seen_at(sequential_, where, place)});
}

void Memory::note_sequential(const void* where, const Place& place, MessageId id, int order) {
  if (order == __ATOMIC_SEQ_CST && position(place, id) >= seen_at(sequential_writes_, where, place)) {
    sequential_writes_[where] = id;
  }
}

void Memory::join(View& into, const View& from) const {
  for (const auto& [where, id] : from) {
    MessageId& known = into[where];
    const Place& place = places_.at(where);
    if (position(place, id) > position(place, known)) {
      known = id;
    }
  }
}

void Memory::take(Thread& thread, const void* where, const Message& message, int order) {
  thread.seen[where] = message.id;
  thread.note(message.id);
  join(acquires(order) && !without_.no_acquire_loads ? thread.seen : thread.acquirable, message.view);
}

// What a write of the thread passes on.
Memory::View Memory::given(const Thread& thread, int order, const void* where, MessageId id) const {
  View view = releases(order) && !without_.no_release_stores ? thread.seen : thread.released;
  view[where] = id;
  return view;
}

std::uint64_t Memory::load(std::size_t thread, const void* place, std::size_t size, int order) {
  Thread& me = threads_[thread];
  const Place& from = at(place, size);
  const std::size_t first = first_readable(me, place, from, order);
  // The latest one first: the execution that a test would meet.
  const std::size_t chosen = from.size() - 1 - choose_(from.size() - first);
  const Message message = from[chosen];
  ++me.steps;
  take(me, place, message, order);
  return message.value;
}

void Memory::store(std::size_t thread, void* place, std::uint64_t value, std::size_t size, int order) {
  Thread& me = threads_[thread];
  Place& to = at(place, size);
  std::vector<std::size_t> gaps;  // where it can stand in the order of writes, the last one first
  for (std::size_t i = to.size(); i > seen_at(me.seen, place, to); --i) {
    if (i == to.size() || !to[i].tied) {
      gaps.push_back(i);
    }
  }
  const std::size_t gap = gaps[choose_(gaps.size())];
  const MessageId id = next_id(thread);
  to.insert(to.begin() + static_cast<std::ptrdiff_t>(gap), {id, value, {}, false});
  me.seen[place] = id;
  to[gap].view = given(me, order, place, id);
  note_sequential(place, to, id, order);
  me.note(id);
}

std::uint64_t Memory::modify(std::size_t thread, void* place, std::size_t size, int order, int failed,
                             const Change& change) {
  Thread& me = threads_[thread];
  Place& of = at(place, size);
  const std::size_t first = first_readable(me, place, of, order);
  std::vector<std::size_t> readable;
  for (std::size_t i = of.size(); i > first; --i) {
    std::uint64_t value = of[i - 1].value;
    // What is modified already is not modified again, but a comparison can fail with it.
    if (i == of.size() || !of[i].tied || !change(value)) {
      readable.push_back(i - 1);
    }
  }
  const std::size_t chosen = readable[choose_(readable.size())];
  const Message before = of[chosen];
  std::uint64_t value = before.value;
  if (!change(value)) {
    ++me.steps;
    take(me, place, before, failed);
    return before.value;
  }
  take(me, place, before, order);
  const MessageId id = next_id(thread);
  of.insert(of.begin() + static_cast<std::ptrdiff_t>(chosen) + 1, {id, value, {}, true});
  me.seen[place] = id;
  View view = given(me, order, place, id);
  join(view, before.view);  // a release sequence goes on
  of[chosen + 1].view = std::move(view);
  note_sequential(place, of, id, order);
  me.note(id);
  return before.value;
}

void Memory::fence(std::size_t thread, int order) {
  Thread& me = threads_[thread];
  const bool is_sequential = order == __ATOMIC_SEQ_CST;
  if (is_sequential) {
    ++me.steps;
    me.note(kFence);
  }
  if (acquires(order) && !without_.no_acquire_fences) {
    join(me.seen, me.acquirable);
  }
  if (is_sequential) {
    join(me.seen, sequential_writes_);
    join(me.seen, sequential_);
    join(sequential_, me.seen);
  }
  if (releases(order) && !without_.no_release_fences) {
    me.released = me.seen;
  }
}

void Memory::fence_all(std::size_t thread) {
  Thread& me = threads_[thread];
  ++me.steps;
  me.note(kFenceAll);
  for (Thread& other : threads_) {
    join(sequential_, other.seen);
    join(sequential_, other.acquirable);
  }
  for (Thread& other : threads_) {
    join(other.seen, sequential_);
    other.released = other.seen;
  }
}

void Memory::lock(std::size_t thread, const void* place) {
  Thread& me = threads_[thread];
  Mutex& mutex = mutexes_[place];
  mutex.locked = true;
  join(me.seen, mutex.view);
  ++me.steps;
  me.note(kLock);
  // Who had it before is a part of the state.
  for (const auto& [where, id] : mutex.view) {
    me.note(id);
  }
}

void Memory::unlock(std::size_t thread, const void* place) {
  Thread& me = threads_[thread];
  Mutex& mutex = mutexes_[place];
  mutex.locked = false;
  mutex.view = me.seen;
  ++me.steps;
  me.note(kUnlock);
}

std::uint64_t Memory::final_value(const void* place, std::size_t size) const {
  const auto found = places_.find(place);
  return found == places_.end() ? bits_at(place, size) : found->second.back().value;
}

}  // namespace indurop::test::weak
