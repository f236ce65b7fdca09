// SPDX-License-Identifier: Apache-2.0
#include "store/vars/snapshot.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "store/vars/together.h"

namespace indurop::vars {
namespace {

// The block up to the end of its last entry. The directory was checked when the store was attached.
std::span<const std::byte> block_of(const Store& store) {
  std::uint64_t end = 0;
  for (const DirectoryEntry& entry : store.directory()) {
    end = std::max(end, entry.offset + abi::entry_size(entry.kind, entry.value_size));
  }
  return {reinterpret_cast<const std::byte*>(&store.header()), end};
}

}  // namespace

Status read_snapshot(const Store& store, std::span<const PartToRead> parts) {
  std::vector<std::unique_ptr<std::uint64_t[]>> values;  // whole values, aligned for scalars
  std::vector<abi::Piece> pieces;
  for (const PartToRead& part : parts) {
    const std::uint32_t size = part.variable->value_size;
    if (part.offset > size || part.to.size() > size - part.offset) {
      return Error{Errc::OutOfRange, 0, "part of a variable to read"};
    }
    values.push_back(std::make_unique<std::uint64_t[]>(size / sizeof(std::uint64_t) + 1));
    abi::Piece piece{};
    piece.entry = store.entry(part.variable->name_hash, 0);
    piece.to = values.back().get();
    piece.kind = part.variable->kind;
    piece.size = size;
    pieces.push_back(piece);
  }
  const Together together = read_together_in(block_of(store), pieces);
  if (store.lost()) {
    return Error{Errc::Dead, 0, "the store was truncated by a process with write access"};
  }
  const bool moved =
      std::any_of(parts.begin(), parts.end(), [&store](const PartToRead& part) { return store.moved(*part.variable); });
  if (moved) {
    return Error{Errc::TypeMismatch, 0, "a variable has another layout since"};
  }
  if (together != Together::Yes) {
    return Error{Errc::Busy, 0, "read values as they were at one moment"};
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto* value = reinterpret_cast<const std::uint8_t*>(values[i].get());
    std::memcpy(parts[i].to.data(), value + parts[i].offset, parts[i].to.size());
  }
  return {};
}

}  // namespace indurop::vars
