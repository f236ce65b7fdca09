// SPDX-License-Identifier: Apache-2.0
#include "store/vars/batch.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <thread>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/shared_mutex.h"
#include "store/vars/scalar.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {
namespace {

constexpr std::uint64_t kBatchMagic = 0x31484354'41425249ULL;
constexpr std::uint32_t kMaxTries = 200;

bool is_sound(const BatchEntry& entry, std::span<const DirectoryEntry> directory) noexcept {
  return entry.variable < directory.size() && entry.size > 0 &&
         std::uint64_t{entry.offset} + entry.size <= directory[entry.variable].value_size &&
         std::uint64_t{entry.data} + entry.size <= kMaxBatchBytes;
}

// One request to the tick thread. Everything is prepared before the first change becomes visible.
class Order {
 public:
  Order(const Store& store, const BatchBlock& block) noexcept
      : memory_(reinterpret_cast<std::byte*>(const_cast<BlockHeader*>(&store.header()))),  // NOLINT: mapped writable
        directory_(store.directory()),
        block_(block) {}
  Order(const Order&) = delete;
  Order& operator=(const Order&) = delete;
  ~Order() {
    for (std::size_t i = 0; i < held_; ++i) {
      discard(*rings_[i]);
    }
  }

  // Returns Done, Busy, or Wrong.
  BatchState carry_out() noexcept {
    const std::size_t count = std::min<std::size_t>(block_.count, kMaxBatchValues);
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_sound(block_.entries[i], directory_)) {
        return BatchState::Wrong;
      }
      if (variable(i).kind == abi::Kind::Ring && !prepare(i)) {
        return BatchState::Busy;
      }
    }
    for (std::size_t i = std::exchange(held_, 0); i > 0; --i) {
      commit(*rings_[i - 1]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (variable(i).kind == abi::Kind::Scalar) {
        const BatchEntry& entry = block_.entries[i];
        write_scalar(static_cast<std::byte*>(place(i)), variable(i).value_size, entry.offset,
                     {block_.data + entry.data, entry.size});
      }
    }
    return BatchState::Done;
  }

 private:
  [[nodiscard]] const DirectoryEntry& variable(std::size_t i) const noexcept {
    return directory_[block_.entries[i].variable];
  }
  [[nodiscard]] void* place(std::size_t i) const noexcept { return memory_ + variable(i).offset; }

  // Parts of one variable are adjacent.
  bool prepare(std::size_t i) noexcept {
    const BatchEntry& entry = block_.entries[i];
    const bool same = i > 0 && block_.entries[i - 1].variable == entry.variable;
    if (!same) {
      auto* const ring = static_cast<abi::RingHeader*>(place(i));
      slot_ = static_cast<unsigned char*>(try_begin_edit(*ring));
      if (slot_ == nullptr) {
        return false;
      }
      rings_[held_++] = ring;
    }
    indurop::detail::copy_to_shared(slot_ + entry.offset, block_.data + entry.data, entry.size);
    return true;
  }

  std::byte* memory_;
  std::span<const DirectoryEntry> directory_;
  const BatchBlock& block_;
  std::array<abi::RingHeader*, kMaxBatchValues> rings_{};  // held_ of them
  std::size_t held_ = 0;
  unsigned char* slot_ = nullptr;
};

// The process that makes a request, exclusively.
class Asking {
 public:
  explicit Asking(BatchBlock& block) noexcept : block_(block), locked_(rt::is_locked(rt::lock_within(block.lock))) {}
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;
  ~Asking() {
    if (locked_) {
      rt::unlock(block_.lock);
    }
  }
  [[nodiscard]] bool locked() const noexcept { return locked_; }

 private:
  BatchBlock& block_;
  bool locked_;
};

bool is_open(BatchState state) noexcept {
  return state == BatchState::Staged || state == BatchState::Working;
}

// Returns false if it is not done by `end`.
bool wait_until_done(const BatchBlock& block, rt::MonoTime end) {
  constexpr std::chrono::microseconds kPause{200};
  while (is_open(block.state.load(std::memory_order_acquire))) {
    if (rt::MonoClock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

bool put(BatchBlock& block, const Store& store, std::span<const Change> changes) {
  std::vector<Change> sorted(changes.begin(), changes.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Change& a, const Change& b) { return a.variable < b.variable; });
  std::size_t used = 0;
  block.count = 0;
  for (const Change& one : sorted) {
    if (block.count == kMaxBatchValues || used + one.bytes.size() > kMaxBatchBytes) {
      return false;
    }
    block.entries[block.count++] = {static_cast<std::uint32_t>(one.variable - store.directory().data()), one.offset,
                                    static_cast<std::uint32_t>(one.bytes.size()), static_cast<std::uint32_t>(used)};
    std::memcpy(block.data + used, one.bytes.data(), one.bytes.size());
    used += one.bytes.size();
  }
  return true;
}

}  // namespace

std::string batch_file(const std::string& node) {
  return block_file(node) + ".batch";
}

Result<Batch> Batch::create(const std::string& node, const Store& store) {
  auto file = ShmFile::create(batch_file(node), sizeof(BatchBlock));
  if (!file) {
    return file.error();
  }
  auto& block = *reinterpret_cast<BatchBlock*>(file->data());
  block.layout_hash = store.header().layout_hash;
  if (!rt::init_shared_mutex(block.lock)) {
    return Error{Errc::System, 0, "lock of the batch"};
  }
  block.magic.store(kBatchMagic, std::memory_order_release);
  if (const Status status = file->publish(); !status) {
    return status.error();
  }
  file->prefault();
  return Batch(std::move(file).value());
}

void Batch::carry_out_staged(const Store& store, std::uint64_t tick) noexcept {
  BatchBlock& to_do = block();
  auto state = BatchState::Staged;
  if (!to_do.state.compare_exchange_strong(state, BatchState::Working, std::memory_order_acquire)) {
    return;
  }
  const BatchState result = Order(store, to_do).carry_out();
  const bool again = result == BatchState::Busy && ++tries_ < kMaxTries;
  tries_ = again ? tries_ : 0;
  to_do.tick.store(tick, std::memory_order_relaxed);
  to_do.state.store(again ? BatchState::Staged : result, std::memory_order_release);
}

Result<std::uint64_t> change_in_one_tick(const std::string& node, const Store& store, std::span<const Change> changes,
                                         std::chrono::nanoseconds patience) {
  auto file = ShmFile::open(batch_file(node), Mode::ReadWrite);
  if (!file) {
    return file.error();
  }
  auto* const block = reinterpret_cast<BatchBlock*>(file->data());
  if (file->size() != sizeof(BatchBlock) || block->magic.load(std::memory_order_acquire) != kBatchMagic) {
    return Error{Errc::NotFound, 0, "batch of a node of another version"};
  }
  if (block->layout_hash != store.header().layout_hash) {
    return Error{Errc::TypeMismatch, 0, "variables of the node"};
  }
  const rt::MonoTime end = rt::MonoClock::now() + patience;
  const Asking asking(*block);
  if (!asking.locked() || !wait_until_done(*block, end)) {
    return Error{Errc::Busy, 0, "the changes of another process are not done yet"};
  }
  if (!put(*block, store, changes)) {
    return Error{Errc::InvalidArgument, 0, "more than one tick may change"};
  }
  block->state.store(BatchState::Staged, std::memory_order_release);
  constexpr std::chrono::milliseconds kCopy{100};  // for a tick that has begun to apply it
  auto expected = BatchState::Staged;
  if (!wait_until_done(*block, end) &&
      (block->state.compare_exchange_strong(expected, BatchState::Free) || !wait_until_done(*block, end + kCopy))) {
    return Error{Errc::Timeout, 0, "no tick came"};
  }
  switch (block->state.load(std::memory_order_acquire)) {
    case BatchState::Done:
      if (std::any_of(changes.begin(), changes.end(),
                      [&store](const Change& one) { return store.moved(*one.variable); })) {
        break;
      }
      return block->tick.load(std::memory_order_relaxed);
    case BatchState::Busy:
      return Error{Errc::Busy, 0, "write lock of a variable"};
    case BatchState::Free:
    case BatchState::Staged:
    case BatchState::Working:
    case BatchState::Wrong:
      break;
  }
  return Error{Errc::OutOfRange, 0, "part of a variable to write"};
}

}  // namespace indurop::vars
