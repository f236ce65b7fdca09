// SPDX-License-Identifier: Apache-2.0
#include "tape/check.h"

#include <algorithm>
#include <bit>

namespace indurop::tape {
namespace {

bool fits(std::uint64_t offset, std::uint64_t bytes, std::uint64_t total) noexcept {
  return offset % sizeof(std::uint64_t) == 0 && offset <= total && bytes <= total - offset;
}

bool good(const TapeTrack& track, std::span<const std::byte> memory) noexcept {
  const std::uint64_t items = std::uint64_t{track.only_read} + track.both + track.only_written;
  if (!std::has_single_bit(track.words) || track.words > memory.size() || track.words < kMarks ||
      !fits(track.data_offset, track.words * sizeof(std::uint64_t), memory.size()) ||
      !fits(track.items_offset, items * sizeof(std::uint32_t), memory.size())) {
    return false;
  }
  const auto* const indices = reinterpret_cast<const std::uint32_t*>(memory.data() + track.items_offset);
  return std::all_of(indices, indices + items,
                     [&](std::uint32_t i) { return i < header_of(memory.data()).variable_count; });
}

}  // namespace

std::span<const TapeVariable> variables_of(const std::byte* memory) noexcept {
  return {reinterpret_cast<const TapeVariable*>(memory + header_of(memory).variables_offset),
          header_of(memory).variable_count};
}

std::span<const TapeTrack> tracks_of(const std::byte* memory) noexcept {
  return {reinterpret_cast<const TapeTrack*>(memory + header_of(memory).tracks_offset), header_of(memory).track_count};
}

Status check_tape(std::span<const std::byte> memory) {
  if (memory.size() < sizeof(TapeHeader) ||
      header_of(memory.data()).magic.load(std::memory_order_acquire) != kTapeMagic) {
    return Error{Errc::Corrupt, 0, "not a tape"};
  }
  const TapeHeader& head = header_of(memory.data());
  if (head.abi != kTapeAbi) {
    return Error{Errc::VersionMismatch, 0, "the tape of another release"};
  }
  const Error wrong{Errc::Corrupt, 0, "the tape does not add up"};
  if (!fits(head.variables_offset, head.variable_count * sizeof(TapeVariable), memory.size()) ||
      !fits(head.tracks_offset, head.track_count * sizeof(TapeTrack), memory.size())) {
    return wrong;
  }
  const auto variables = variables_of(memory.data());
  const auto tracks = tracks_of(memory.data());
  const bool ok = std::all_of(variables.begin(), variables.end(),
                              [&](const TapeVariable& v) { return fits(v.first_offset, v.size, memory.size()); }) &&
                  std::all_of(tracks.begin(), tracks.end(), [&](const TapeTrack& t) { return good(t, memory); });
  return ok ? Status() : wrong;
}

}  // namespace indurop::tape
