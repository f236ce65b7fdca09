// SPDX-License-Identifier: Apache-2.0
// Reads first all versions, then makes all copies, then reads all versions again: if none has changed, the values
// existed together in between. For values from a mirror the update word of their board is checked as well, because one
// update changes many versions.

#include "store/vars/together.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/rt/relax.h"
#include "core/rt/relaxed.h"
#include "store/vars/scalar.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {
namespace {

using rt::kRelaxed;
constexpr int kTries = 64;      // attempts to copy everything
constexpr int kPauses = 2'000;  // while an update is being applied: some 50 us

abi::RingHeader& ring_of(const abi::Piece& piece) noexcept {
  return *static_cast<abi::RingHeader*>(piece.entry);
}

const std::atomic<std::uint64_t>& word_of(const abi::Piece& piece) noexcept {
  return *reinterpret_cast<const std::atomic<std::uint64_t>*>(static_cast<std::byte*>(piece.entry) +
                                                              piece.update_offset);
}

bool is_sent_with_others(const abi::Piece& piece) noexcept {
  return piece.update_offset != 0 && piece.update_offset != abi::kAlone;
}

// The memory that update words may be in.
struct Bounds {
  std::uintptr_t begin = 0;
  std::uintptr_t end = UINTPTR_MAX;

  [[nodiscard]] bool contain_word_of(const abi::Piece& piece) const noexcept {
    const std::uintptr_t at =
        reinterpret_cast<std::uintptr_t>(piece.entry) + static_cast<std::uintptr_t>(piece.update_offset);
    return at % alignof(std::atomic<std::uint64_t>) == 0 && at >= begin && at < end &&
           end - at >= sizeof(std::atomic<std::uint64_t>);
  }
};

// Returns false if an update is just being applied.
bool note_versions(std::span<abi::Piece> pieces, const Bounds& bounds) noexcept {
  for (abi::Piece& piece : pieces) {
    piece.update_offset = abi::update_offset_of(piece.entry, piece.kind).load(std::memory_order_acquire);
    if (is_sent_with_others(piece) && !bounds.contain_word_of(piece)) {
      piece.update_offset = abi::kAlone;
    }
    piece.update = is_sent_with_others(piece) ? word_of(piece).load(std::memory_order_acquire) : 0;
    if ((piece.update & abi::kUpdating) != 0) {
      return false;
    }
    piece.version = piece.kind == abi::Kind::Ring ? ring_of(piece).seq.load(std::memory_order_acquire) : 0;
  }
  return true;
}

// Returns false if writers overtook the copy.
bool copy(abi::Piece& piece) noexcept {
  if (piece.kind == abi::Kind::Scalar) {
    read_scalar(static_cast<const std::byte*>(piece.entry), piece.size, 0,
                {static_cast<std::uint8_t*>(piece.to), piece.size});
    return true;
  }
  abi::RingHeader& ring = ring_of(piece);
  indurop::detail::copy_from_shared(piece.to, indurop::detail::slot(&ring, piece.version, abi::slot_stride(piece.size)),
                                    piece.size);
  std::atomic_thread_fence(std::memory_order_acquire);
  return ring.seq.load(kRelaxed) == piece.version;
}

bool still_there(const abi::Piece& piece) noexcept {
  if (abi::update_offset_of(piece.entry, piece.kind).load(kRelaxed) != piece.update_offset ||
      (is_sent_with_others(piece) && word_of(piece).load(kRelaxed) != piece.update)) {
    return false;
  }
  if (piece.kind == abi::Kind::Ring) {
    return ring_of(piece).seq.load(kRelaxed) == piece.version;
  }
  std::array<std::uint8_t, sizeof(std::uint64_t)> now{};
  read_scalar(static_cast<const std::byte*>(piece.entry), piece.size, 0, {now.data(), piece.size});
  return std::memcmp(now.data(), piece.to, piece.size) == 0;
}

bool copy_all(std::span<abi::Piece> pieces) noexcept {
  if (!std::all_of(pieces.begin(), pieces.end(), copy)) {
    return false;
  }
  std::atomic_thread_fence(std::memory_order_acquire);
  return std::all_of(pieces.begin(), pieces.end(), still_there);
}

// Values that existed together belong together unless their board reports, or cannot report, otherwise.
bool belong_together(std::span<const abi::Piece> pieces) noexcept {
  return pieces.size() < 2 || std::none_of(pieces.begin(), pieces.end(), [](const abi::Piece& piece) {
           return piece.update_offset == abi::kAlone || (piece.update & abi::kPartial) != 0;
         });
}

void copy_each(std::span<abi::Piece> pieces) noexcept {
  for (abi::Piece& piece : pieces) {
    if (piece.kind == abi::Kind::Scalar) {
      (void)copy(piece);
    } else {
      read_slow(ring_of(piece), piece.to, 0, piece.size);
    }
  }
}

Together try_together(std::span<abi::Piece> pieces, const Bounds& bounds) noexcept {
  int pauses = 0;
  for (int i = 0; i < kTries; ++i) {
    while (!note_versions(pieces, bounds)) {
      if (++pauses > kPauses) {
        return Together::Overtaken;
      }
      rt::relax();
    }
    if (copy_all(pieces)) {
      return belong_together(pieces) ? Together::Yes : Together::No;
    }
  }
  return Together::Overtaken;
}

}  // namespace

bool read_together(std::span<abi::Piece> pieces) noexcept {
  const Together together = try_together(pieces, {});
  if (together == Together::Overtaken) {
    copy_each(pieces);
  }
  return together == Together::Yes;
}

Together read_together_in(std::span<const std::byte> block, std::span<abi::Piece> pieces) noexcept {
  const auto begin = reinterpret_cast<std::uintptr_t>(block.data());
  return try_together(pieces, {begin, begin + block.size()});
}

}  // namespace indurop::vars
