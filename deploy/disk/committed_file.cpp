// SPDX-License-Identifier: Apache-2.0
#include "deploy/disk/committed_file.h"

#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

using base::Json;
using base::Problem;

constexpr std::uint64_t kCommittedFormat = 2;
constexpr std::uint64_t kWithoutDigest = 1;

Json json_of(const Committed& committed, std::uint64_t format) {
  return {{"indurop_state", format},
          {"generation", committed.generation},
          {"plant", committed.plant},
          {"current", committed.current},
          {"current_size", committed.current_size},
          {"grant", committed.grant},
          {"previous", committed.previous},
          {"members", committed.members},
          {"comment", committed.comment},
          {"history", history_json(committed.history)}};
}

bool read_history(const Json& from, std::vector<HistoryEntry>& history) {
  bool good = from.is_array();
  for (const Json& each : from.values()) {
    HistoryEntry& entry = history.emplace_back();
    (void)read(each, "comment", entry.comment);
    good = good && read(each, "deployment", entry.deployment) && read(each, "plant", entry.plant) &&
           read(each, "generation", entry.generation) && read(each, "host", entry.host) &&
           read(each, "wall_ns", entry.wall_ns) && read(each, "outcome", entry.outcome);
  }
  return good;
}

}  // namespace

Json history_json(const std::vector<HistoryEntry>& history) {
  Json entries = Json::array();
  for (const HistoryEntry& entry : history) {
    entries.push_back({{"deployment", entry.deployment},
                       {"plant", entry.plant},
                       {"generation", entry.generation},
                       {"host", entry.host},
                       {"wall_ns", entry.wall_ns},
                       {"outcome", entry.outcome},
                       {"comment", entry.comment}});
  }
  return entries;
}

std::string committed_text(const Committed& committed) {
  Json whole = json_of(committed, kCommittedFormat);
  whole["sha256"] = keys::digest_of(whole.dump());
  return whole.dump(2) + "\n";
}

Result<Committed, Problem> read_committed(std::string_view text) {
  const Json whole = Json::parse(text).value_or(Json());
  Committed out;
  std::uint64_t format = 0;
  // Plants without keys have no grant, files of older releases no comment.
  (void)read(whole, "grant", out.grant);
  (void)read(whole, "comment", out.comment);
  if (!read(whole, "indurop_state", format) || !read(whole, "generation", out.generation) ||
      !read(whole, "plant", out.plant) || !read(whole, "current", out.current) ||
      !read(whole, "current_size", out.current_size) || !read(whole, "previous", out.previous) ||
      !read(whole, "members", out.members) || !read_history(whole["history"], out.history)) {
    return Problem{"it cannot be understood"};
  }
  if (format == kWithoutDigest) {
    return out;
  }
  std::string digest;
  if (format != kCommittedFormat || !read(whole, "sha256", digest)) {
    return Problem{"it is of another release, or was changed"};
  }
  const std::string found = keys::digest_of(json_of(out, format).dump());
  if (digest != found) {
    return Problem{"its content has the SHA-256 " + found + ", it was written with " + digest};
  }
  return out;
}

std::set<std::string> kept_deployments(const Committed& committed, std::size_t most) {
  std::set<std::string> ids{committed.current, committed.previous};
  for (auto entry = committed.history.rbegin(); entry != committed.history.rend() && ids.size() < most; ++entry) {
    if (entry->outcome == "committed") {
      ids.insert(entry->deployment);
    }
  }
  ids.erase("");
  return ids;
}

}  // namespace indurop::deploy
