// SPDX-License-Identifier: Apache-2.0

#include "store/vars/scalar.h"

#include <cstring>

#include "store/vars/forces.h"

namespace indurop::vars {

namespace {

template <class Word>
void read_as(const std::byte* entry, std::uint32_t offset, std::span<std::uint8_t> to) noexcept {
  const Word word = __atomic_load_n(reinterpret_cast<const Word*>(entry), __ATOMIC_ACQUIRE);
  std::memcpy(to.data(), reinterpret_cast<const std::uint8_t*>(&word) + offset, to.size());
}

template <class Word>
void write_as(std::byte* entry, std::uint32_t offset, std::span<const std::uint8_t> from) noexcept {
  if (hold_scalar(entry)) {
    return;
  }
  auto* target = reinterpret_cast<Word*>(entry);
  Word old = __atomic_load_n(target, __ATOMIC_RELAXED);
  Word wanted = old;
  do {
    wanted = old;
    std::memcpy(reinterpret_cast<std::uint8_t*>(&wanted) + offset, from.data(), from.size());
  } while (!__atomic_compare_exchange_n(target, &old, wanted, true, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED));
  hold_scalar(entry);  // forced in between
}

}  // namespace

void read_scalar(const std::byte* entry, std::uint32_t size, std::uint32_t offset,
                 std::span<std::uint8_t> to) noexcept {
  switch (size) {
    case 1:
      return read_as<std::uint8_t>(entry, offset, to);
    case 2:
      return read_as<std::uint16_t>(entry, offset, to);
    case 4:
      return read_as<std::uint32_t>(entry, offset, to);
    default:
      return read_as<std::uint64_t>(entry, offset, to);
  }
}

void write_scalar(std::byte* entry, std::uint32_t size, std::uint32_t offset,
                  std::span<const std::uint8_t> from) noexcept {
  switch (size) {
    case 1:
      return write_as<std::uint8_t>(entry, offset, from);
    case 2:
      return write_as<std::uint16_t>(entry, offset, from);
    case 4:
      return write_as<std::uint32_t>(entry, offset, from);
    default:
      return write_as<std::uint64_t>(entry, offset, from);
  }
}

}  // namespace indurop::vars
