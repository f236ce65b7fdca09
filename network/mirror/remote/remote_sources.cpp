// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/remote/remote_sources.h"

#include <algorithm>

#include "network/dds/entity.h"

namespace indurop::mirror {

void RemoteSources::take(dds::Handle directories) {
  dds::take_all<indurop_wire_Directory>(directories, [&](const auto& directory, const dds::SampleInfo& info) {
    if (info.valid) {
      take_one(directories, directory, info);
    }
    // No participant of this name is left; one that was killed is missed after the lease.
    if (!info.alive) {
      const std::string board = directory.board;
      std::erase_if(sources_, [&](const auto& entry) { return entry.second.board == board; });
      ++generation_;
    }
  });
}

void RemoteSources::take_one(dds::Handle directories, const indurop_wire_Directory& directory,
                             const dds::SampleInfo& info) {
  const auto participant = dds::participant_of(directories, info.publication);
  auto schema = schema::from_json(directory.schema);
  if (!participant || !schema) {
    return;
  }
  Source source{directory.board, directory.plant, std::move(schema).value(), {}, {}, directory.session};
  source.writable.insert(directory.writable._buffer, directory.writable._buffer + directory.writable._length);
  for (std::uint32_t i = 0; i < directory.mirrored._length; ++i) {
    source.mirrored.emplace(directory.mirrored._buffer[i].name, directory.mirrored._buffer[i].board);
  }
  boards_[source.board] = source.plant;
  for (std::uint32_t i = 0; i < directory.boards._length; ++i) {
    boards_[directory.boards._buffer[i]] = source.plant;
  }
  // An earlier run of the same board that ended without notice.
  std::erase_if(sources_, [&](const auto& entry) {
    return entry.first != *participant && entry.second.board == source.board && entry.second.plant == source.plant &&
           entry.second.session < source.session;
  });
  sources_[*participant] = std::move(source);
  ++generation_;
}

const RemoteSources::Source* RemoteSources::at(const dds::Guid& participant) const {
  const auto found = sources_.find(participant);
  return found == sources_.end() ? nullptr : &found->second;
}

const dds::Guid* RemoteSources::participant_of(const std::string& board) const {
  const auto found =
      std::find_if(sources_.begin(), sources_.end(), [&](const auto& entry) { return entry.second.board == board; });
  return found == sources_.end() ? nullptr : &found->first;
}

const RemoteSources::Source* RemoteSources::of(const std::string& board) const {
  const dds::Guid* const participant = participant_of(board);
  return participant == nullptr ? nullptr : at(*participant);
}

}  // namespace indurop::mirror
