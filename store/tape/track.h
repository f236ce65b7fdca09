// SPDX-License-Identifier: Apache-2.0
// The writing end of one track: called before and after each run of its module, by the thread that runs it.

#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "store/tape/layout.h"
#include "store/vars/store.h"

namespace indurop::tape {

// How a module's code uses a variable, an index into the store's directory.
struct VariableUse {
  std::uint32_t variable = 0;
  bool reads = false;
  bool writes = false;
};

class alignas(kLine) Track {
 public:
  // The writing thread's process. A separate process may die in the middle of a run while the node lives, which then
  // ends that run: so it publishes its progress.
  enum class Writer { Node, Process };

  // Continues after the present end of the track. `tape`: all its bytes, checked; borrowed, like the store. Not
  // real-time safe.
  Track(std::byte* tape, TapeTrack& shared, const vars::Store& store, Writer writer = Writer::Node);

  // The module restarts before its next run; call while it does not run, on any thread.
  void note_restart() noexcept { marks_.fetch_or(kRestarted, std::memory_order_acq_rel); }
  // The number of the version of its code (versions.h); likewise.
  void set_version(std::uint32_t number) noexcept { marks_.store(mark_of(number), std::memory_order_release); }
  // Continues after the present end of the track, to which another process may have written: the process that calls it
  // executes all runs from now on. `number`: of its version. `marks` of its first run: kRestarted, kExchanged or both,
  // if it begins with nothing that the process before it kept; 0. Real-time safe.
  void go_on(std::uint32_t number, std::uint32_t marks) noexcept;
  // The number of the version that the next note_exchange() is about. Any thread, while no exchange is watched for.
  void set_other_version(std::uint32_t number) noexcept { other_.store(mark_of(number), std::memory_order_release); }
  // The other version of the module's code runs from the run on that begins next, and this one becomes the other one.
  // On the thread that runs it.
  void note_exchange() noexcept;
  // Returns true if a value of this size leaves enough of the track to other ones. Any thread.
  [[nodiscard]] bool has_room_for(std::uint32_t bytes) const noexcept;
  // These variables are on the track, in addition, from the next note_exchange() or take_offered() on. One normal
  // thread, while no exchange is watched for. Not real-time safe.
  void offer(std::span<const VariableUse> uses, const vars::Store& store);
  // Takes them. On the thread that runs the module, or while it does not run. Real-time safe.
  void take_offered() noexcept;
  // Records the values at the start of a run. Returns true if that was much: it took longer than a clock reading.
  // Real-time safe: no lock, no allocation, no system call.
  bool begin() noexcept;
  // Records a clock reading of the run. Real-time safe.
  void clock(std::int64_t ns) noexcept;
  // Records the answer of a call or a channel. Real-time safe.
  void record_answer(std::int64_t code, std::span<const std::uint8_t> bytes) noexcept;
  // Records the values after the run; from then on readers see the run. Returns true if that was much, as above.
  // `number` and `order` of `times` are ignored. Real-time safe.
  bool end(const RunTail& times, std::uint32_t flags) noexcept;
  // Ends the open run of a writer that died in the middle of it as a run that ended by a fault; nothing if there was
  // none. Called by the process that continues the track, before anything else. Not real-time safe.
  void end_of_dead(RunTail times) noexcept;
  // Number of runs recorded so far. Any thread.
  [[nodiscard]] std::uint64_t runs() const noexcept { return shared_.runs.load(std::memory_order_acquire); }
  // Position of the next run.
  [[nodiscard]] const void* next() const noexcept { return words_ + (head_ & mask_); }
  // A run that only checks: nothing is written if nothing changed. Real-time safe.
  void record_others(const RunTail& times) noexcept;

 private:
  struct Item {
    const void* entry = nullptr;  // of the store
    std::uint64_t seen = 0;       // scalar: the value; else the version
    std::uint32_t size = 0;
    std::uint32_t variable = 0;
    bool scalar = false;
  };

  // All variables of the track, with those that are offered.
  struct Offer {
    std::vector<Item> items;
    std::vector<std::uint32_t> from;  // where each is now; kNowhere: it is new
    std::vector<std::uint64_t> copy;
    std::uint32_t reads_end = 0;
    std::uint32_t writes_begin = 0;
  };

  static Item item_of(const vars::Store& store, std::uint32_t variable);
  static constexpr std::uint32_t mark_of(std::uint32_t version) noexcept { return version << kVersionShift; }
  bool record_changed(Item& item, EntryKind kind, bool anyway) noexcept;
  void record_entry(Item& item, EntryKind kind) noexcept;
  void record_next_again() noexcept;
  void show_open() noexcept;
  void publish(const RunTail& times, std::uint32_t flags) noexcept;
  [[nodiscard]] bool much(std::size_t checks, std::uint64_t from) const noexcept;
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
  std::uint64_t answer_words_left_ = 0;
  std::uint16_t clock_left_ = 0;      // readings of this run that may still be recorded
  std::uint16_t answers_left_ = 0;    // answers of this run that may still be recorded
  std::atomic<std::uint32_t> marks_;  // of the next run: its version, and kRestarted or kExchanged
  TapeTrack& shared_;
  std::uint64_t* words_;
  std::uint64_t mask_;
  std::uint8_t part_shift_;  // a part of the ring has 1 << part_shift_ words
  bool shows_open_;
  bool all_ = true;    // nothing was recorded yet, or the record is not published
  bool open_ = false;  // a run has begun and not ended
  std::uint32_t reads_end_;
  std::uint32_t writes_begin_;
  std::uint32_t again_ = 0;
  std::vector<Item> items_;  // only read, both, only written

  std::vector<std::uint64_t> copy_;      // of one value
  std::atomic<std::uint32_t> other_{0};  // mark of the version that does not run
  std::atomic<Offer*> offered_{nullptr};
  std::unique_ptr<Offer> offer_;
};

}  // namespace indurop::tape
