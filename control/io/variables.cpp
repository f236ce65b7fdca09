// SPDX-License-Identifier: Apache-2.0
#include "control/io/variables.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <cstring>

namespace indurop::io {
namespace {

abi::RingHeader* ring_of(const abi::Ref& row) noexcept {
  return static_cast<abi::RingHeader*>(__atomic_load_n(&row.entry, __ATOMIC_ACQUIRE));
}

template <class T>
std::uint64_t load_scalar(const void* entry) noexcept {
  std::uint64_t bits = 0;
  T value = __atomic_load_n(static_cast<const T*>(entry), __ATOMIC_ACQUIRE);
  std::memcpy(&bits, &value, sizeof value);
  return bits;
}

template <class T>
void store_scalar(void* entry, std::uint64_t bits) noexcept {
  T value{};
  std::memcpy(&value, &bits, sizeof value);
  detail::scalar_write(entry, value);
}

std::uint64_t load_scalar(const void* entry, std::uint32_t size) noexcept {
  switch (size) {
    case 1:
      return load_scalar<std::uint8_t>(entry);
    case 2:
      return load_scalar<std::uint16_t>(entry);
    case 4:
      return load_scalar<std::uint32_t>(entry);
    default:
      return load_scalar<std::uint64_t>(entry);
  }
}

void store_scalar(void* entry, std::uint32_t size, std::uint64_t bits) noexcept {
  switch (size) {
    case 1:
      store_scalar<std::uint8_t>(entry, bits);
      break;
    case 2:
      store_scalar<std::uint16_t>(entry, bits);
      break;
    case 4:
      store_scalar<std::uint32_t>(entry, bits);
      break;
    default:
      store_scalar<std::uint64_t>(entry, bits);
      break;
  }
}

// Like detail::ring_read, for a size that is known at run time only.
void load_ring(const abi::Ref& row, std::uint32_t offset, void* to, std::uint32_t size) noexcept {
  abi::RingHeader* ring = ring_of(row);
  if (!detail::try_copies(ring, abi::slot_stride(row.value_size), to, offset, size)) {
    indurop_read_slow(ring, to, offset, size);
  }
}

}  // namespace

Variables::Part Variables::part_of(const schema::Place& place) {
  const schema::Variable& variable = *place.variable;
  const std::uint64_t hash = variable.name_hash();
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [hash](const abi::Ref& row) { return row.name_hash == hash; });
  const auto row = static_cast<std::size_t>(found - rows_.begin());
  if (found == rows_.end()) {
    names_.push_back(variable.name);
    rows_.push_back({hash, variable.type_hash, nullptr, nullptr, static_cast<std::uint32_t>(variable.type.size()),
                     variable.kind, names_.back().c_str()});
    writes_of_row_.emplace_back();
  }
  return {row, place.offset, static_cast<std::uint32_t>(place.type.size())};
}

std::size_t Variables::add_read(const schema::Place& part) {
  reads_.push_back(part_of(part));
  return reads_.size() - 1;
}

std::size_t Variables::add_write(const schema::Place& part) {
  writes_.push_back({part_of(part), 0, false});
  writes_of_row_[writes_.back().part.row].push_back(writes_.size() - 1);
  return writes_.size() - 1;
}

std::size_t Variables::add_text(const schema::Place& part) {
  texts_.push_back(part_of(part));
  return texts_.size() - 1;
}

void Variables::read_text(std::size_t text, std::string& into) const {
  const Part& part = texts_[text];
  into.resize(part.size);
  load_ring(rows_[part.row], part.offset, into.data(), part.size);
  into.resize(std::min(into.find('\0'), into.size()));
}

bool Variables::write_text(std::size_t text, std::string_view value) {
  const Part& part = texts_[text];
  std::size_t size = std::min(value.find('\0'), value.size());
  const bool fits = size < part.size;
  for (size = std::min<std::size_t>(size, part.size - 1); size > 0 && !fits; --size) {
    if ((static_cast<unsigned char>(value[size]) & 0xC0U) != 0x80U) {
      break;  // the next character begins there
    }
  }
  std::string present;
  read_text(text, present);
  if (present == value.substr(0, size)) {
    return fits;
  }
  std::string bytes(value.substr(0, size));
  bytes.resize(part.size);
  abi::RingHeader* const ring = ring_of(rows_[part.row]);
  if (auto* const slot = static_cast<unsigned char*>(indurop_begin_edit(ring)); slot != nullptr) {
    detail::copy_to_shared(slot + part.offset, bytes.data(), part.size);
    indurop_commit_write(ring);
  }
  return fits;
}

void Variables::bind() {
  if (!bound_ && !rows_.empty()) {
    indurop_register_refs(rows_.data(), static_cast<std::uint32_t>(rows_.size()), abi::kVersion);
    bound_ = true;
  }
}

void Variables::unbind() {
  if (bound_) {
    indurop_unregister_refs(rows_.data());
    bound_ = false;
  }
}

std::uint64_t Variables::load(const Part& part) const noexcept {
  const abi::Ref& row = rows_[part.row];
  if (row.kind == abi::Kind::Scalar) {
    return load_scalar(__atomic_load_n(&row.entry, __ATOMIC_ACQUIRE), row.value_size);
  }
  std::uint64_t bits = 0;
  load_ring(row, part.offset, &bits, part.size);
  return bits;
}

std::uint64_t Variables::read(std::size_t part) const noexcept {
  return load(reads_[part]);
}

void Variables::set(std::size_t part, std::uint64_t bits) noexcept {
  writes_[part].bits = bits;
  writes_[part].is_set = true;
}

bool Variables::differs(const Write& write) const noexcept {
  return write.is_set && load(write.part) != write.bits;
}

void Variables::commit_row(const std::vector<std::size_t>& writes) noexcept {
  const bool same = std::none_of(writes.begin(), writes.end(), [this](std::size_t i) { return differs(writes_[i]); });
  if (same) {
    return;
  }
  const abi::Ref& row = rows_[writes_[writes.front()].part.row];
  if (row.kind == abi::Kind::Scalar) {
    store_scalar(__atomic_load_n(&row.entry, __ATOMIC_ACQUIRE), row.value_size, writes_[writes.front()].bits);
    return;
  }
  abi::RingHeader* ring = ring_of(row);
  auto* slot = static_cast<unsigned char*>(indurop_begin_edit(ring));
  if (slot == nullptr) {
    return;  // counted by the store as a lost write; the next run tries again
  }
  for (const std::size_t i : writes) {
    const Write& write = writes_[i];
    if (write.is_set) {
      detail::copy_to_shared(slot + write.part.offset, &write.bits, write.part.size);
    }
  }
  indurop_commit_write(ring);
}

void Variables::commit() noexcept {
  for (const std::vector<std::size_t>& writes : writes_of_row_) {
    if (!writes.empty()) {
      commit_row(writes);
    }
  }
}

}  // namespace indurop::io
