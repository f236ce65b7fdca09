// SPDX-License-Identifier: Apache-2.0
#include "store/tape/member.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "store/tape/check.h"

namespace indurop::tape {

Result<Member> Member::open(const std::string& node, std::uint32_t module, const vars::Store& store) {
  auto file = vars::ShmFile::open(vars::tape_file(node), vars::Mode::ReadWrite);
  if (!file) {
    return file.error();
  }
  std::byte* const memory = file->data();
  if (const auto good = index_tape({memory, file->size()}); !good) {
    return good.error();
  }
  if (header_of(memory).layout_hash != store.header().layout_hash) {
    return Error{Errc::NotFound, 0, "the tape belongs to another run"};
  }
  auto* const tracks = reinterpret_cast<TapeTrack*>(memory + header_of(memory).tracks_offset);
  auto* const end = tracks + header_of(memory).track_count;
  auto* const own = std::find_if(tracks, end, [&](const TapeTrack& track) { return track.module == module; });
  if (own == end) {
    return Error{Errc::NotFound, 0, "the tape has no track of this module"};
  }
  auto track = std::make_unique<Track>(memory, *own, store, Track::Writer::Process);
  return Member(std::move(file).value(), std::move(track));
}

bool Member::has_later_variables() const noexcept {
  return header_of(file_.data()).later_variables.load(std::memory_order_acquire) > 0;
}

void Member::add_later(std::span<const VariableUse> uses, const vars::Store& store) {
  const TapeHeader& header = header_of(file_.data());
  const std::uint32_t known = header.variable_count + header.later_variables.load(std::memory_order_acquire);
  std::vector<VariableUse> later;
  for (const VariableUse& use : uses) {
    const bool is_later = use.variable >= header.variable_count && use.variable < known;
    if (is_later && track_->has_room_for(store.directory()[use.variable].value_size)) {
      later.push_back(use);
    }
  }
  track_->offer(later, store);
  track_->take_offered();
}

}  // namespace indurop::tape
