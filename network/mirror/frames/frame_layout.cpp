// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/frame_layout.h"

#include <algorithm>
#include <map>
#include <utility>

namespace indurop::mirror {
namespace {

constexpr std::int64_t kConfirmationsPerMaxAge = 3;  // two may be lost

std::int64_t keepalive_of(const Parcel& parcel) noexcept {
  const std::int64_t wanted =
      parcel.maxage_ns > 0 ? std::min(kKeepAliveNs, parcel.maxage_ns / kConfirmationsPerMaxAge) : kKeepAliveNs;
  return std::max(wanted, parcel.every_ns);
}

Stream stream_of(const Parcel& parcel) noexcept {
  if (parcel.size > kPartBytes) {
    return Stream::Bulk;
  }
  return parcel.best_effort ? Stream::BestEffort : Stream::Prompt;
}

}  // namespace

std::vector<Part> pack(std::span<const Parcel> parcels) {
  using Class = std::pair<Stream, std::int64_t>;
  std::vector<Part> parts;
  std::map<Class, std::vector<std::size_t>> open;  // parts of each class that may still have room
  for (std::uint32_t i = 0; i < parcels.size(); ++i) {
    const Parcel& parcel = parcels[i];
    const Class kind{stream_of(parcel), parcel.every_ns};
    auto& candidates = open[kind];
    const auto fits = [&](std::size_t part) { return parts[part].size + parcel.size <= kPartBytes; };
    auto found = std::find_if(candidates.begin(), candidates.end(), fits);
    if (found == candidates.end()) {
      parts.push_back({kind.first, 0, kind.second, keepalive_of(parcel), {}});
      candidates.push_back(parts.size() - 1);
      found = candidates.end() - 1;
    }
    Part& part = parts[*found];
    part.content.push_back({i, part.size});
    part.size += parcel.size;
    part.keepalive_ns = std::min(part.keepalive_ns, keepalive_of(parcel));
  }
  return parts;
}

}  // namespace indurop::mirror
