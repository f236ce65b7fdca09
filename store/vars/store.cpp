// SPDX-License-Identifier: Apache-2.0

#include "store/vars/store.h"

#include <indurop/detail/variable_access.h>

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <deque>
#include <optional>
#include <thread>
#include <utility>

#include "core/rt/clock.h"
#include "store/vars/block.h"
#include "store/vars/node_lock.h"
#include "store/vars/previous_block.h"
#include "store/vars/scalar.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {

struct Store::Impl {
  Impl(ShmFile&& mapped, BlockIndex&& contents, Origin from) noexcept : file(std::move(mapped)), origin(from) {
    keep(std::make_unique<BlockIndex>(std::move(contents)));
    if (from != Origin::Attached) {
      growth = std::make_unique<Growth>(file, *indices.front());
    }
  }

  // Other threads may be using an older one: the first is kept, and some of the latest.
  void keep(std::unique_ptr<const BlockIndex> newest) {
    present.store(newest.get(), std::memory_order_release);
    indices.push_back(std::move(newest));
    if (constexpr std::size_t kKept = 9; indices.size() > kKept) {
      indices.erase(indices.begin() + 1);
    }
  }
  [[nodiscard]] const BlockIndex& index() const noexcept { return *present.load(std::memory_order_acquire); }
  [[nodiscard]] BlockHeader& header() const noexcept { return *header_of(file.data()); }
  [[nodiscard]] abi::RingHeader& ring(const DirectoryEntry& variable) const noexcept {
    return *reinterpret_cast<abi::RingHeader*>(file.data() + variable.offset);
  }
  // Returns false for a part outside the value, and for an entry that is not of this store.
  [[nodiscard]] bool contains(const DirectoryEntry& variable, std::uint64_t offset, std::uint64_t size) const noexcept {
    const std::uint64_t entry = abi::entry_size(variable.kind, variable.value_size);
    return offset + size <= variable.value_size && variable.offset % abi::kAlign == 0 &&
           variable.offset <= file.size() && entry <= file.size() - variable.offset;
  }

  ShmFile file;
  std::atomic<const BlockIndex*> present{nullptr};  // the newest one
  std::deque<std::unique_ptr<const BlockIndex>> indices;
  Origin origin;
  std::unique_ptr<Growth> growth;  // null: another process created the block
};

namespace {

constexpr std::int64_t kReadLimitNs = 50'000'000;
constexpr int kSwapTries = 100;  // one millisecond each
constexpr Error kMoved{Errc::TypeMismatch, 0, "the variable has another layout since"};

// Copies the bytes whose element in `only` is not 0; all of them if it is empty.
void copy_bytes(unsigned char* to, std::span<const std::uint8_t> from, std::span<const std::uint8_t> only) noexcept {
  if (only.empty()) {
    indurop::detail::copy_to_shared(to, from.data(), from.size());
  }
  for (std::size_t at = 0; at < only.size(); ++at) {
    if (only[at] != 0) {
      indurop::detail::copy_to_shared(to + at, &from[at], 1);
    }
  }
}

void fill_slot(unsigned char* slot, std::size_t size, std::span<const std::uint8_t> initial) noexcept {
  static constexpr std::array<unsigned char, 4096> kZero{};
  if (!initial.empty()) {  // else data() may be null, which memcpy must not get
    indurop::detail::copy_to_shared(slot, initial.data(), initial.size());
  }
  for (std::size_t at = initial.size(); at < size; at += kZero.size()) {
    indurop::detail::copy_to_shared(slot + at, kZero.data(), std::min(kZero.size(), size - at));
  }
}

}  // namespace

Result<Store> Store::create(const std::string& node, const schema::Schema& schema) {
  if (!valid_node_name(node)) {
    return Error{Errc::InvalidArgument, 0, "node name: 1 to 40 letters, digits, '_' or '-'"};
  }
  auto plan = plan_block(schema);
  if (!plan) {
    return plan.error();
  }
  auto previous = PreviousBlock::find(node);
  if (!previous) {
    return previous.error();
  }
  std::uint64_t generation = 1;
  if (previous->index) {
    BlockHeader& old = *header_of(previous->file->data());
    generation = old.generation.load(std::memory_order_acquire) + 1;
    if (previous->index->growths == 0 && old.layout_hash == plan->layout_hash &&
        locks_work(previous->file->data(), previous->index->directory)) {
      static_cast<void>(remove_unfinished(block_file(node)));
      previous->own_everything();
      release_all(old, previous->index->directory);
      sign_in(old, generation);
      old.state.store(BlockState::Ready, std::memory_order_release);
      return Store(std::make_unique<Impl>(std::move(*previous->file), std::move(*previous->index), Origin::Adopted));
    }
  }
  auto file = ShmFile::create(block_file(node), plan->total_size, kGrowthRoom);
  if (!file) {
    return file.error();
  }
  if (Status status = fill_block(file->data(), *plan, node); !status) {
    return status.error();
  }
  if (previous->index) {
    previous->retire();
    previous->carry_over(*plan, file->data());
  }
  BlockHeader& header = *header_of(file->data());
  sign_in(header, generation);
  header.state.store(BlockState::Ready, std::memory_order_relaxed);
  header.magic.store(kMagic, std::memory_order_release);
  if (Status status = file->publish(); !status) {
    return status.error();
  }
  BlockIndex index{std::move(plan->directory), std::move(plan->schema), {}, 0, plan->layout_hash};
  static_cast<void>(sort_by_name(index));
  return Store(std::make_unique<Impl>(std::move(file.value()), std::move(index),
                                      previous->index ? Origin::CarriedOver : Origin::Fresh));
}

Result<Store> Store::attach(const std::string& node, Mode mode) {
  if (!valid_node_name(node)) {
    return Error{Errc::InvalidArgument, 0, "node name: 1 to 40 letters, digits, '_' or '-'"};
  }
  for (int i = 0; i < kSwapTries; ++i) {
    auto file = ShmFile::open(block_file(node), mode);
    if (!file) {
      return file.error();
    }
    auto index = check_block({file->data(), file->size()});
    if (!index && index.error().code != Errc::Busy) {
      return index.error();
    }
    const auto& header = *header_of(file->data());
    if (index && header.state.load(std::memory_order_acquire) == BlockState::Ready) {
      return Store(std::make_unique<Impl>(std::move(file.value()), std::move(index.value()), Origin::Attached));
    }
    if (running_node(node) == 0) {
      break;  // no process would complete or replace it
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return Error{Errc::Busy, 0, "store is being replaced by a newer one"};
}

Store::Store(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&& other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}

Store::~Store() {
  if (impl_ == nullptr || impl_->origin == Origin::Attached) {
    return;
  }
  std::int32_t mine = ::getpid();  // a forked child's copy does not sign the parent off
  impl_->header().node_pid.compare_exchange_strong(mine, 0, std::memory_order_release);
}

Origin Store::origin() const noexcept {
  return impl_->origin;
}
const BlockHeader& Store::header() const noexcept {
  return impl_->header();
}
const schema::Schema& Store::schema() const noexcept {
  return impl_->index().schema;
}
bool Store::retired() const noexcept {
  return impl_->header().state.load(std::memory_order_acquire) == BlockState::Retired || lost();
}
bool Store::lost() const noexcept {
  return impl_->file.lost() || impl_->header().magic.load(std::memory_order_relaxed) != kMagic;
}
bool Store::grown() const noexcept {
  return impl_->header().growths.load(std::memory_order_acquire) != impl_->index().growths;
}
bool Store::moved(const DirectoryEntry& variable) const noexcept {
  std::atomic_thread_fence(std::memory_order_acquire);  // after all that was read
  const std::uint64_t growth =
      moved_of(impl_->file.data() + variable.offset, variable.kind).load(std::memory_order_acquire);
  if (growth == 0) [[likely]] {
    return false;
  }
  const BlockIndex& index = impl_->index();
  const DirectoryEntry* const now = growth <= index.growths ? index.find(variable.name_hash) : nullptr;
  return now == nullptr || now->offset != variable.offset;
}
std::uint64_t Store::layout_hash() const noexcept {
  return impl_->index().layout_hash;
}
ShmFile::Named Store::named() const noexcept {
  return impl_->file.named();
}

const DirectoryEntry* Store::find(std::uint64_t name_hash) const noexcept {
  return impl_->index().find(name_hash);
}

std::span<const DirectoryEntry> Store::directory() const noexcept {
  return impl_->index().directory;
}

void* Store::entry(std::uint64_t name_hash, std::uint64_t type_hash) const noexcept {
  const DirectoryEntry* found = find(name_hash);
  const bool fits = found != nullptr && (type_hash == 0 || found->type_hash == type_hash);
  return fits ? impl_->file.data() + found->offset : nullptr;
}

Status Store::read(const DirectoryEntry& variable, std::uint32_t offset, std::span<std::uint8_t> to) const noexcept {
  if (!impl_->contains(variable, offset, to.size())) {
    return Error{Errc::OutOfRange, 0, "part of a variable to read"};
  }
  const auto length = static_cast<std::uint32_t>(to.size());
  abi::RingHeader& ring = impl_->ring(variable);
  if (variable.kind == abi::Kind::Scalar) {
    read_scalar(impl_->file.data() + variable.offset, variable.value_size, offset, to);
  } else if (bool done = try_read(ring, variable.value_size, offset, to.data(), length); !done) {
    if (impl_->file.mode() == Mode::ReadWrite) {
      read_slow(ring, variable.value_size, to.data(), offset, length);
      done = true;
    }
    for (const std::int64_t limit = rt::now_ns() + kReadLimitNs; !done && rt::now_ns() < limit;) {
      ::sched_yield();
      done = try_read(ring, variable.value_size, offset, to.data(), length);
    }
    if (!done) {
      return Error{Errc::Timeout, 0, "read a variable that is written without a pause"};
    }
  }
  if (lost()) {
    return Error{Errc::Dead, 0, "the store was truncated by a process with write access"};
  }
  return moved(variable) ? Status(kMoved) : Status();
}

Status Store::write(const DirectoryEntry& variable, std::uint32_t offset, std::span<const std::uint8_t> from,
                    std::span<const std::uint8_t> only) noexcept {
  if (impl_->file.mode() == Mode::ReadOnly) {
    return Error{Errc::PermissionDenied, 0, "write through a read-only view"};
  }
  if (!impl_->contains(variable, offset, from.size())) {
    return Error{Errc::OutOfRange, 0, "part of a variable to write"};
  }
  if (variable.kind == abi::Kind::Scalar) {
    write_scalar(impl_->file.data() + variable.offset, variable.value_size, offset, from);
    return moved(variable) ? Status(kMoved) : Status();
  }
  abi::RingHeader& ring = impl_->ring(variable);
  auto* slot = static_cast<unsigned char*>(
      only.empty() ? begin_write(ring, offset, static_cast<std::uint32_t>(from.size())) : begin_edit(ring));
  if (slot == nullptr) {
    return Error{Errc::Busy, 0, "write lock of a variable"};
  }
  copy_bytes(slot + offset, from, only);
  commit(ring);
  return moved(variable) ? Status(kMoved) : Status();
}

Status Store::force(const DirectoryEntry& variable, std::uint32_t offset, std::span<const std::uint8_t> value,
                    rt::MonoTime until) noexcept {
  if (impl_->file.mode() == Mode::ReadOnly) {
    return Error{Errc::PermissionDenied, 0, "force through a read-only view"};
  }
  Force what{&variable, offset, static_cast<std::uint32_t>(value.size()), 0, until};
  if (!impl_->contains(variable, offset, value.size()) || value.size() > sizeof what.value) {
    return Error{Errc::OutOfRange, 0, "part of a variable to force"};
  }
  std::memcpy(&what.value, value.data(), value.size());
  const Status forced = vars::force(impl_->header(), what);
  if (forced && moved(variable)) {
    static_cast<void>(vars::release(impl_->header(), variable, offset));
    return kMoved;
  }
  return forced;
}

Status Store::prolong(const DirectoryEntry& variable, std::uint32_t offset, rt::MonoTime was,
                      rt::MonoTime until) noexcept {
  if (impl_->file.mode() == Mode::ReadOnly) {
    return Error{Errc::PermissionDenied, 0, "extend a force through a read-only view"};
  }
  return vars::prolong(impl_->header(), variable, offset, was, until);
}

Status Store::release(const DirectoryEntry& variable, std::uint32_t offset) noexcept {
  if (impl_->file.mode() == Mode::ReadOnly) {
    return Error{Errc::PermissionDenied, 0, "release through a read-only view"};
  }
  return vars::release(impl_->header(), variable, offset);
}

void Store::release_overdue() noexcept {
  if (impl_->file.mode() == Mode::ReadWrite) {
    vars::release_overdue(impl_->header(), impl_->index().directory);
  }
}

std::vector<Force> Store::forces() const {
  return forces_of(impl_->header(), impl_->index().directory);
}

void Store::release_locks_of_this_thread() noexcept {
  if (impl_->file.mode() == Mode::ReadOnly) {
    return;
  }
  const rt::ThreadId thread = rt::this_thread();
  for (const DirectoryEntry& variable : directory()) {
    if (variable.kind == abi::Kind::Ring) {
      release_if_mine(impl_->ring(variable), thread);
    }
  }
}

void Store::reset(bool keep_retained) noexcept {
  static constexpr std::array<std::uint8_t, sizeof(std::uint64_t)> kZero{};
  const BlockIndex& index = impl_->index();
  for (const DirectoryEntry& variable : index.directory) {
    if (impl_->file.mode() == Mode::ReadOnly || (keep_retained && (variable.flags & kRetain) != 0)) {
      continue;
    }
    const auto& initial = index.schema.variables[variable.schema_index].initial;
    if (variable.kind == abi::Kind::Scalar) {
      write_scalar(impl_->file.data() + variable.offset, variable.value_size, 0,
                   initial.empty() ? std::span(kZero).first(variable.value_size) : std::span(initial));
      continue;
    }
    abi::RingHeader& ring = impl_->ring(variable);
    if (auto* slot = static_cast<unsigned char*>(begin_write(ring, 0, variable.value_size)); slot != nullptr) {
      fill_slot(slot, variable.value_size, initial);
      commit(ring);
    }
  }
}

rt::MonoTime Store::now() const noexcept {
  return time_of(impl_->header());
}

std::atomic<std::int64_t>& Store::virtual_time() noexcept {
  return impl_->header().virtual_ns;
}

Status Store::reserve(std::span<const schema::Variable> variables) {
  return impl_->growth->reserve(impl_->index(), variables);
}
void* Store::place(std::uint64_t name_hash, std::uint64_t type_hash) const {
  void* const known = entry(name_hash, type_hash);
  return known != nullptr || impl_->growth == nullptr ? known : impl_->growth->place(name_hash, type_hash);
}
Growth& Store::growth() noexcept {
  return *impl_->growth;
}
Result<NextCatalog> Store::prepare(std::span<const schema::Variable> variables) {
  return impl_->growth->prepare(impl_->index(), variables);
}
void Store::follow(NextCatalog next) {
  impl_->keep(std::move(next.index));
}
void Store::announce(NextCatalog next) {
  for (const NextCatalog::Word& word : next.words) {
    word.to->store(word.value, std::memory_order_release);
  }
  follow(std::move(next));
}

void Store::beat(rt::MonoTime now) noexcept {
  impl_->header().heartbeat_ns.store(rt::to_ns(now), std::memory_order_relaxed);
}
void Store::prefault() const noexcept {
  impl_->file.prefault();
}

}  // namespace indurop::vars
