// SPDX-License-Identifier: Apache-2.0
#include "store/tape/follower.h"

#include <algorithm>
#include <utility>

#include "store/tape/check.h"

namespace indurop::tape {

Result<Follower> Follower::open(const std::string& node, bool from_start) {
  auto file = vars::ShmFile::open(vars::tape_file(node), vars::Mode::ReadOnly);
  if (!file) {
    return file.error();
  }
  auto index = index_tape({file->data(), file->size()});
  if (!index) {
    return index.error();
  }
  Follower follower(std::move(file).value(), std::move(index).value());
  follower.find_tracks(from_start);
  follower.take_later_variables();
  return follower;
}

const TapeHeader& Follower::header() const noexcept {
  return header_of(file_.data());
}

void Follower::find_tracks(bool from_start) {
  const auto* shared = reinterpret_cast<const TapeTrack*>(file_.data() + index_.tracks_offset);
  for (const TapeIndex::Track& track : index_.tracks) {
    const auto* const words = reinterpret_cast<const std::uint64_t*>(file_.data() + track.data_offset);
    tracks_.emplace_back(TrackReader::Source{shared++, words, track.words, track.module}, index_.variables, from_start);
  }
}

// The entries were written before the number was; the memory is checked as in index_tape().
void Follower::take_later_variables() {
  const std::uint32_t later = std::min(header().later_variables.load(std::memory_order_acquire), kLaterVariables);
  const std::size_t known = index_.variables.size();
  if (known == header_variables_ + later && shown_later_ == shows_later_) {
    return;
  }
  const auto* const all = reinterpret_cast<const TapeVariable*>(file_.data() + index_.variables_offset);
  if (known < header_variables_ + later) {
    index_.variables.insert(index_.variables.end(), all + known, all + header_variables_ + later);
  }
  shown_later_ = shows_later_;
  for (TrackReader& track : tracks_) {
    track.set_variables(index_.variables, shows_later_ ? index_.variables.size() : header_variables_);
  }
}

// The header of a store that was truncated is no longer valid; its tape may still be intact.
bool Follower::is_of(const vars::Store& store) const noexcept {
  const auto directory = store.directory();
  return (store.lost() || header().layout_hash == store.header().layout_hash) &&
         index_.variables.size() <= directory.size() &&
         std::equal(index_.variables.begin(), index_.variables.end(), directory.begin(),
                    [](const TapeVariable& taped, const vars::DirectoryEntry& entry) {
                      return taped.size == entry.value_size;
                    });
}

std::span<const std::uint8_t> Follower::first_value(std::uint32_t variable) const noexcept {
  if (variable >= header_variables_) {
    return {};
  }
  const TapeVariable& known = index_.variables[variable];
  return {reinterpret_cast<const std::uint8_t*>(file_.data() + known.first_offset), known.size};
}

std::optional<Version> Follower::version(std::uint32_t number) const {
  const auto* const places = reinterpret_cast<const TapeVersion*>(file_.data() + index_.versions_offset);
  return find_version({places, std::size_t{index_.start_versions} + kLaterVersions}, index_.start_versions, number);
}

Follower::Items Follower::items_of(std::size_t track) const noexcept {
  const TapeIndex::Track& known = index_.tracks[track];
  const std::span<const std::uint32_t> all(known.items);
  return {all.first(known.only_read), all.subspan(known.only_read)};
}

}  // namespace indurop::tape
