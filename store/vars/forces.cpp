// SPDX-License-Identifier: Apache-2.0
// Writers of a ring check the table under the ring's lock. Writers of a scalar have no lock: they check before and
// after they write. A force is announced first, then all processors pass a barrier, then the value is written: a writer
// that did not see the announcement has written before the barrier, and is overwritten; all others see it.

#include "store/vars/forces.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "core/rt/barrier.h"
#include "core/rt/clock.h"
#include "core/rt/relaxed.h"
#include "core/rt/shared_mutex.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {
namespace {

using rt::kRelaxed;

std::byte* entry_of(const BlockHeader& header, const DirectoryEntry& variable) noexcept {
  return reinterpret_cast<std::byte*>(const_cast<BlockHeader*>(&header)) + variable.offset;  // NOLINT: one mapping
}

std::int64_t distance(const void* from, const void* to) noexcept {
  return static_cast<const std::byte*>(to) - static_cast<const std::byte*>(from);
}

struct Held {
  std::int64_t entry;
  std::uint32_t offset;
  std::uint32_t size;
  std::uint64_t value;
  rt::MonoTime until;
};

// Returns nothing if the slot is free or just being filled.
std::optional<Held> part_in(const ForceSlot& slot) noexcept {
  const std::uint64_t version = slot.version.load(std::memory_order_acquire);
  const std::uint64_t where = slot.where.load(kRelaxed);
  const Held part{slot.entry.load(kRelaxed), static_cast<std::uint32_t>(where >> 32U),
                  static_cast<std::uint32_t>(where), slot.value.load(kRelaxed),
                  rt::mono_time(slot.until_ns.load(kRelaxed))};
  std::atomic_thread_fence(std::memory_order_acquire);
  const bool whole = version % 2 == 0 && slot.version.load(kRelaxed) == version;
  return whole && part.entry != 0 ? std::optional(part) : std::nullopt;
}

// Every table is part of a block's header.
rt::MonoTime time_of(const ForceTable& table) noexcept {
  return vars::time_of(*reinterpret_cast<const BlockHeader*>(reinterpret_cast<const std::byte*>(&table) -
                                                             offsetof(BlockHeader, forces)));
}

bool over(const Held& part, const ForceTable& table) noexcept {
  return part.until != kForever && part.until <= time_of(table);
}

// Calls `use` for every part of the entry that is forced now.
template <class Use>
void for_each_of(const ForceTable& table, const void* entry, Use use) noexcept {
  for (const ForceSlot& slot : table.slots) {
    if (slot.entry.load(kRelaxed) != distance(&slot, entry)) {
      continue;
    }
    const auto part = part_in(slot);
    if (part && part->entry == distance(&slot, entry) && !over(*part, table)) {
      use(*part);
    }
  }
}

const ForceTable& table_of(const void* entry, std::int64_t offset) noexcept {
  return *reinterpret_cast<const ForceTable*>(static_cast<const std::byte*>(entry) + offset);
}

// The forced part of a scalar.
std::optional<Held> scalar_part(void* entry) noexcept {
  std::optional<Held> found;
  const std::int64_t offset = abi::forces_offset_of(entry, abi::Kind::Scalar).load(kRelaxed);
  if (offset != 0) {
    for_each_of(table_of(entry, offset), entry, [&](const Held& part) { found = part; });
  }
  return found;
}

void write_word(void* entry, std::uint32_t size, std::uint64_t value) noexcept {
  const auto put = [&](auto zero) {
    std::memcpy(&zero, &value, sizeof zero);
    __atomic_store_n(static_cast<decltype(zero)*>(entry), zero, __ATOMIC_RELEASE);
  };
  switch (size) {
    case 1:
      return put(std::uint8_t{});
    case 2:
      return put(std::uint16_t{});
    case 4:
      return put(std::uint32_t{});
    default:
      return put(std::uint64_t{});
  }
}

// A process that changes the table. A holder that was killed leaves at most one half-filled slot.
class Changing {
 public:
  explicit Changing(ForceTable& table) noexcept : table_(table), result_(rt::lock_within(table.lock)) {
    if (result_ == rt::LockResult::OwnerDied) {
      for (ForceSlot& slot : table.slots) {
        if (const std::uint64_t version = slot.version.load(kRelaxed); version % 2 != 0) {
          slot.entry.store(0, kRelaxed);
          slot.version.store(version + 1, std::memory_order_release);
        }
      }
    }
  }
  Changing(const Changing&) = delete;
  Changing& operator=(const Changing&) = delete;
  ~Changing() {
    if (locked()) {
      rt::unlock(table_.lock);
    }
  }
  [[nodiscard]] bool locked() const noexcept { return rt::is_locked(result_); }

 private:
  ForceTable& table_;
  rt::LockResult result_;
};

ForceSlot* find(ForceTable& table, const void* entry, std::uint32_t offset) noexcept {
  for (ForceSlot& slot : table.slots) {
    if (slot.entry.load(kRelaxed) == distance(&slot, entry) && slot.where.load(kRelaxed) >> 32U == offset) {
      return &slot;
    }
  }
  return nullptr;
}

ForceSlot* find_free(ForceTable& table) noexcept {
  for (ForceSlot& slot : table.slots) {
    const auto part = part_in(slot);
    if (!part || over(*part, table)) {
      return &slot;
    }
  }
  return nullptr;
}

void fill(ForceSlot& slot, const void* entry, const Force& what) noexcept {
  const std::uint64_t version = slot.version.load(kRelaxed);
  slot.version.store(version + 1, kRelaxed);
  std::atomic_thread_fence(std::memory_order_release);
  slot.where.store(std::uint64_t{what.offset} << 32U | what.size, kRelaxed);
  slot.value.store(what.value, kRelaxed);
  slot.until_ns.store(rt::to_ns(what.until), kRelaxed);
  slot.entry.store(distance(&slot, entry), kRelaxed);
  slot.version.store(version + 2, std::memory_order_release);
}

// Writers need no check any more once no slot refers to the variable.
void unmark_unforced(BlockHeader& header, const DirectoryEntry& variable) noexcept {
  void* const entry = entry_of(header, variable);
  std::atomic<std::int64_t>& mark = abi::forces_offset_of(entry, variable.kind);
  const auto is_of_it = [entry](const ForceSlot& slot) { return slot.entry.load(kRelaxed) == distance(&slot, entry); };
  if (mark.load(kRelaxed) != 0 &&
      std::none_of(std::begin(header.forces.slots), std::end(header.forces.slots), is_of_it)) {
    mark.store(0, kRelaxed);
  }
}

const Error kBusy{Errc::Busy, 0, "table of forces"};

}  // namespace

bool init_forces(ForceTable& table) noexcept {
  return rt::init_shared_mutex(table.lock);
}

Status force(BlockHeader& header, const Force& what) noexcept {
  if (what.size != 1 && what.size != 2 && what.size != 4 && what.size != 8) {
    return Error{Errc::InvalidArgument, 0, "size of a forced part"};
  }
  const Changing changing(header.forces);
  if (!changing.locked()) {
    return kBusy;
  }
  void* const entry = entry_of(header, *what.variable);
  ForceSlot* const known = find(header.forces, entry, what.offset);
  if (known != nullptr && static_cast<std::uint32_t>(known->where.load(kRelaxed)) == what.size) {
    known->value.store(what.value, kRelaxed);  // one word each: no moment without a force
    known->until_ns.store(rt::to_ns(what.until), std::memory_order_release);
  } else if (ForceSlot* const slot = known != nullptr ? known : find_free(header.forces); slot != nullptr) {
    fill(*slot, entry, what);
  } else {
    return Error{Errc::NoSpace, 0, "table of forces"};
  }
  abi::forces_offset_of(entry, what.variable->kind).store(distance(entry, &header.forces), std::memory_order_release);
  if (what.variable->kind == abi::Kind::Scalar) {
    rt::barrier_on_all_processors();
    hold_scalar(entry);
    return {};
  }
  auto& ring = *static_cast<abi::RingHeader*>(entry);
  if (begin_write(ring, what.offset, what.size) == nullptr) {
    return Error{Errc::Busy, 0, "write lock of a variable"};
  }
  commit(ring);
  return {};
}

Status prolong(BlockHeader& header, const DirectoryEntry& variable, std::uint32_t offset, rt::MonoTime was,
               rt::MonoTime until) noexcept {
  const Changing changing(header.forces);
  if (!changing.locked()) {
    return kBusy;
  }
  ForceSlot* slot = find(header.forces, entry_of(header, variable), offset);
  if (slot == nullptr || was <= time_of(header) || slot->until_ns.load(kRelaxed) != rt::to_ns(was)) {
    return Error{Errc::NotFound, 0, "forced part"};
  }
  slot->until_ns.store(rt::to_ns(until), std::memory_order_release);
  return {};
}

Status release(BlockHeader& header, const DirectoryEntry& variable, std::uint32_t offset) noexcept {
  const Changing changing(header.forces);
  if (!changing.locked()) {
    return kBusy;
  }
  void* const entry = entry_of(header, variable);
  ForceSlot* slot = find(header.forces, entry, offset);
  if (slot == nullptr) {
    return Error{Errc::NotFound, 0, "forced part"};
  }
  slot->entry.store(0, std::memory_order_release);
  unmark_unforced(header, variable);
  return {};
}

void release_overdue(BlockHeader& header, std::span<const DirectoryEntry> directory) noexcept {
  const Changing changing(header.forces);
  if (!changing.locked()) {
    return;
  }
  for (ForceSlot& slot : header.forces.slots) {
    if (const auto part = part_in(slot); part && over(*part, header.forces)) {
      slot.entry.store(0, std::memory_order_release);
    }
  }
  for (const DirectoryEntry& variable : directory) {
    unmark_unforced(header, variable);
  }
}

void release_all(BlockHeader& header, std::span<const DirectoryEntry> directory) noexcept {
  for (ForceSlot& slot : header.forces.slots) {
    slot.entry.store(0, std::memory_order_release);
  }
  for (const DirectoryEntry& variable : directory) {
    abi::forces_offset_of(entry_of(header, variable), variable.kind).store(0, kRelaxed);
  }
}

std::vector<Force> forces_of(const BlockHeader& header, std::span<const DirectoryEntry> directory) {
  const rt::MonoTime now = vars::time_of(header);
  std::vector<Force> found;
  for (const ForceSlot& slot : header.forces.slots) {
    const auto part = part_in(slot);
    if (!part || part->until <= now) {
      continue;
    }
    const auto offset = static_cast<std::uint64_t>(distance(&header, &slot) + part->entry);
    const auto variable = std::find_if(directory.begin(), directory.end(),
                                       [offset](const DirectoryEntry& entry) { return entry.offset == offset; });
    if (variable != directory.end() && std::uint64_t{part->offset} + part->size <= variable->value_size) {
      found.push_back({&*variable, part->offset, part->size, part->value, part->until});
    }
  }
  return found;
}

bool hold_scalar(void* entry) noexcept {
  constexpr int kTries = 4;  // a force takes a barrier on all processors, so two during one write are rare
  std::optional<Held> held = scalar_part(entry);
  for (int i = 0; held && i < kTries; ++i) {
    write_word(entry, held->size, held->value);
    // Another value that was forced in between is in the table before the barrier of force(): it is seen here, or
    // force() writes it after this one.
    std::atomic_signal_fence(std::memory_order_seq_cst);
    const auto now = scalar_part(entry);
    if (!now || now->value == held->value) {
      return true;
    }
    held = now;
  }
  return held.has_value();
}

void hold_parts(abi::RingHeader& ring, unsigned char* version) noexcept {
  const std::int64_t offset = ring.forces_offset.load(kRelaxed);
  if (offset == 0) {
    return;
  }
  for_each_of(table_of(&ring, offset), &ring, [&](const Held& part) {
    if (std::uint64_t{part.offset} + part.size <= ring.value_size) {
      indurop::detail::copy_to_shared(version + part.offset, &part.value, part.size);
    }
  });
}

}  // namespace indurop::vars
