// SPDX-License-Identifier: Apache-2.0
// The writing end of one track: called before and after each run of its module, by the thread that runs it.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tape/layout.h"
#include "vars/store.h"

namespace indurop::tape {

class alignas(kLine) Track {
 public:
  // Whose thread writes it. A process of its own may die in the middle of a run while the node lives, which ends that
  // run for it: it shows how far it is.
  enum class Writer { Node, Process };

  // Goes on behind what is on the track. `tape`: all its bytes, checked; borrowed, as the store. Not real-time safe.
  Track(std::byte* tape, TapeTrack& shared, const vars::Store& store, Writer writer = Writer::Node);

  // The module is started anew before its next run; while it does not run, on any thread.
  void started_anew() noexcept { anew_.store(kAnew, std::memory_order_release); }
  // What the run begins with. True: that was much, it took longer than a look at the clock. Real-time safe: no lock, no
  // allocation, no system call.
  bool begin() noexcept;
  // The run was told this time. Real-time safe.
  void clock(std::int64_t ns) noexcept;
  // A call or a channel gave it this. Real-time safe.
  void told(std::int64_t code, std::span<const std::uint8_t> bytes) noexcept;
  // What it left; from then on readers see the run. True: that was much, as above. `number` and `order` of `times` are
  // not looked at. Real-time safe.
  bool end(const RunTail& times, std::uint32_t flags) noexcept;
  // Whoever wrote this track died in the middle of a run: what it told of it is a run that ended by a fault. Nothing if
  // it was in none. By one who goes on behind it, before anything else. Not real-time safe.
  void end_of_dead(RunTail times) noexcept;
  // Where the next run is written.
  [[nodiscard]] const void* next() const noexcept { return words_ + (head_ & mask_); }
  // A run that is only a look: nothing is written if nothing changed. Real-time safe.
  void look(const RunTail& times) noexcept;

 private:
  struct Item {
    const void* entry = nullptr;  // of the store
    std::uint64_t seen = 0;       // scalar: the value; else the version
    std::uint32_t size = 0;
    std::uint32_t variable = 0;
    bool scalar = false;
  };

  bool tell_changed(Item& item, EntryKind kind, bool anyway) noexcept;
  void tell(Item& item, EntryKind kind) noexcept;
  void tell_next_again() noexcept;
  void show_open() noexcept;
  void publish(const RunTail& times, std::uint32_t flags) noexcept;
  [[nodiscard]] bool much(std::size_t looked_at, std::uint64_t from) const noexcept;
  void claim(std::uint64_t words) noexcept;
  void put(std::uint64_t word) noexcept;
  void put_head(EntryKind kind, std::uint32_t which) noexcept;

  // Two cache lines for what each run needs: with hundreds of modules in a tick they come from far away.
  std::atomic<std::uint64_t>& orders_;
  std::uint64_t head_ = 0;
  std::uint64_t at_ = 0;
  std::uint64_t claimed_ = 0;
  std::uint64_t order_ = 0;
  std::uint64_t number_ = 0;
  std::uint64_t told_words_left_ = 0;
  std::uint16_t clock_left_ = 0;     // readings of this run that may still be told
  std::uint16_t told_left_ = 0;      // likewise
  std::atomic<std::uint32_t> anew_;  // kAnew or 0
  TapeTrack& shared_;
  std::uint64_t* words_;
  std::uint64_t mask_;
  std::uint8_t part_shift_;  // a part of the ring has 1 << part_shift_ words
  bool shows_open_;
  bool all_ = true;    // nothing was told yet, or what was told is not published
  bool open_ = false;  // a run has begun and not ended
  std::uint32_t reads_end_;
  std::uint32_t writes_begin_;
  std::uint32_t again_ = 0;
  std::vector<Item> items_;  // only read, both, only written

  std::vector<std::uint64_t> copy_;  // of one value
};

}  // namespace indurop::tape
