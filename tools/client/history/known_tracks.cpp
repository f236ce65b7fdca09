// SPDX-License-Identifier: Apache-2.0
#include "tools/client/history/known_tracks.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

namespace indurop::tools {
namespace {

bool is_among(std::span<const std::uint32_t> indices, std::uint32_t one) {
  return std::find(indices.begin(), indices.end(), one) != indices.end();
}

}  // namespace

std::int64_t track_period(const RunView& run, std::uint32_t module) {
  const bool known = module < run.module_count() && run.module(module).period_ns > 0;
  return known ? run.module(module).period_ns.load() : std::numeric_limits<std::int64_t>::max();
}

std::vector<std::size_t> known_tracks(const tape::Follower& follower, const RunView& run, std::uint32_t variable) {
  std::vector<std::size_t> tracks;
  if (variable >= follower.variables().size() || follower.variables()[variable].taped == 0) {
    return tracks;
  }
  std::optional<std::size_t> reader;
  for (std::size_t track = 0; track < follower.tracks(); ++track) {
    if (is_among(follower.items_of(track).written, variable)) {
      tracks.push_back(track);
    } else if (is_among(follower.items_of(track).only_read, variable) &&
               (!reader ||
                track_period(run, follower.module_of(track)) < track_period(run, follower.module_of(*reader)))) {
      reader = track;
    }
  }
  if (tracks.empty() && reader) {
    tracks.push_back(*reader);
  }
  return tracks;
}

}  // namespace indurop::tools
