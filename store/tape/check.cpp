// SPDX-License-Identifier: Apache-2.0
#include "store/tape/check.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace indurop::tape {
namespace {

bool fits(std::uint64_t offset, std::uint64_t bytes, std::uint64_t total) noexcept {
  return offset % sizeof(std::uint64_t) == 0 && offset <= total && bytes <= total - offset;
}

template <class T>
bool copy_table(std::span<const std::byte> memory, std::uint64_t offset, std::uint64_t count, std::vector<T>& to) {
  if (!fits(offset, count * sizeof(T), memory.size())) {
    return false;
  }
  to.resize(count);
  if (count != 0) {
    std::memcpy(to.data(), memory.data() + offset, count * sizeof(T));
  }
  return true;
}

// Returns false if it is inconsistent.
bool copy_track(const TapeTrack& from, std::span<const std::byte> memory, std::size_t variables,
                TapeIndex::Track& track) {
  track = {from.data_offset, from.words, from.module, from.only_read, {}};
  const std::uint64_t items = std::uint64_t{track.only_read} + from.both + from.only_written;
  return std::has_single_bit(track.words) && track.words <= memory.size() && track.words >= kMarks &&
         fits(track.data_offset, track.words * sizeof(std::uint64_t), memory.size()) &&
         copy_table(memory, from.items_offset, items, track.items) && track.only_read <= track.items.size() &&
         std::all_of(track.items.begin(), track.items.end(), [&](std::uint32_t i) { return i < variables; });
}

}  // namespace

Result<TapeIndex> index_tape(std::span<const std::byte> memory) {
  if (memory.size() < sizeof(TapeHeader) ||
      header_of(memory.data()).magic.load(std::memory_order_acquire) != kTapeMagic) {
    return Error{Errc::Corrupt, 0, "not a tape"};
  }
  const TapeHeader& head = header_of(memory.data());
  if (head.abi != kTapeAbi) {
    return Error{Errc::VersionMismatch, 0, "the tape of another release"};
  }
  const Error wrong{Errc::Corrupt, 0, "the tape is inconsistent"};
  TapeIndex index;
  const std::uint64_t tracks = index.tracks_offset = head.tracks_offset;
  const std::uint64_t count = head.track_count;
  index.variables_offset = head.variables_offset;
  const std::uint64_t entries = std::uint64_t{head.variable_count} + kLaterVariables;
  const std::uint64_t versions = index.versions_offset = head.versions_offset;
  index.start_versions = head.start_versions;
  const std::uint64_t places = std::uint64_t{index.start_versions} + kLaterVersions;
  const auto leads_inside = [&](const TapeVariable& v) { return fits(v.first_offset, v.size, memory.size()); };
  if (!fits(index.variables_offset, entries * sizeof(TapeVariable), memory.size()) ||
      !copy_table(memory, index.variables_offset, head.variable_count, index.variables) ||
      !std::all_of(index.variables.begin(), index.variables.end(), leads_inside) ||
      !fits(tracks, count * sizeof(TapeTrack), memory.size()) || tracks % alignof(TapeTrack) != 0 ||
      !fits(versions, places * sizeof(TapeVersion), memory.size())) {
    return wrong;
  }
  for (const TapeTrack& one : std::span(reinterpret_cast<const TapeTrack*>(memory.data() + tracks), count)) {
    if (!copy_track(one, memory, index.variables.size(), index.tracks.emplace_back())) {
      return wrong;
    }
  }
  return index;
}

}  // namespace indurop::tape
