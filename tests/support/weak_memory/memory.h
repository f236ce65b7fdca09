// SPDX-License-Identifier: Apache-2.0
// Memory as the model of model.h has it: all writes of a place in their order, and what each thread knows of them.
// Where several things may happen, a chooser decides. One step at a time.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "tests/support/weak_memory/model.h"

namespace indurop::test::weak {

class Memory {
 public:
  // Returns a number below its argument, which is not 0.
  using Choose = std::function<std::size_t(std::size_t count)>;
  using Change = std::function<bool(std::uint64_t& value)>;

  Memory(const Weakening& without, Choose choose) : without_(without), choose_(std::move(choose)) {}

  // Back to what is in memory itself, with this number of threads; which places are written stays known.
  void reset(std::size_t threads);
  // False: a place was written of which this was not known, so reading it was no step before.
  [[nodiscard]] bool knew_all() const noexcept { return knew_all_; }
  // What is never written has one value only: reading it is no step.
  [[nodiscard]] bool is_written(const void* place) const { return written_.contains(place); }
  void note_write(const void* place);

  // Steps of a thread.
  std::uint64_t load(std::size_t thread, const void* place, std::size_t size, int order);
  void store(std::size_t thread, void* place, std::uint64_t value, std::size_t size, int order);
  std::uint64_t modify(std::size_t thread, void* place, std::size_t size, int order, int failed, const Change& change);
  void fence(std::size_t thread, int order);
  void fence_all(std::size_t thread);
  void lock(std::size_t thread, const void* place);
  void unlock(std::size_t thread, const void* place);
  [[nodiscard]] bool is_free(const void* mutex) const;

  // The last write in the order of the place.
  [[nodiscard]] std::uint64_t final_value(const void* place, std::size_t size) const;
  // Equal for executions that can go on in the same ways.
  [[nodiscard]] std::uint64_t state() const;

 private:
  // A write, by the thread that made it and the number of its steps then: the same in all executions that lead to it.
  using MessageId = std::uint32_t;
  // Of each place the latest write that is known.
  using View = std::map<const void*, MessageId>;
  static constexpr MessageId kInitial = 0;

  struct Message {
    MessageId id = kInitial;
    std::uint64_t value = 0;
    View view;          // what a thread that acquires it learns
    bool tied = false;  // a read-modify-write took the one before: nothing comes between them
  };
  using Place = std::vector<Message>;  // in modification order
  struct Thread {
    View seen;
    View acquirable;  // learned at the next acquire fence
    View released;    // at the last release fence
    std::uint64_t history = 0;
    std::uint32_t steps = 0;

    void note(std::uint64_t what);
  };
  struct Mutex {
    bool locked = false;
    View view;
  };

  Place& at(const void* place, std::size_t size);
  static std::size_t position(const Place& place, MessageId id);
  [[nodiscard]] static std::size_t seen_at(const View& view, const void* where, const Place& place);
  [[nodiscard]] std::size_t first_readable(const Thread& thread, const void* where, const Place& place,
                                           int order) const;
  void note_sequential(const void* where, const Place& place, MessageId id, int order);
  void join(View& into, const View& from) const;
  void take(Thread& thread, const void* where, const Message& message, int order);
  [[nodiscard]] View given(const Thread& thread, int order, const void* where, MessageId id) const;
  MessageId next_id(std::size_t thread);

  Weakening without_;
  Choose choose_;
  std::vector<Thread> threads_;
  std::map<const void*, Place> places_;
  std::map<const void*, Mutex> mutexes_;
  View sequential_;         // what the last sequentially consistent fence knew
  View sequential_writes_;  // of each place the latest write that was a sequentially consistent one
  std::set<const void*> written_;
  bool knew_all_ = true;
};

}  // namespace indurop::test::weak
