// SPDX-License-Identifier: Apache-2.0
#include "mirror/packing.h"

#include <algorithm>
#include <map>
#include <tuple>

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
  using Class = std::tuple<Stream, std::int64_t, std::int64_t>;
  std::vector<Part> parts;
  std::map<Class, std::vector<std::size_t>> open;  // parts of each class that may still have room
  for (std::uint32_t i = 0; i < parcels.size(); ++i) {
    const Parcel& parcel = parcels[i];
    const Class kind{stream_of(parcel), parcel.every_ns, keepalive_of(parcel)};
    auto& candidates = open[kind];
    const auto fits = [&](std::size_t part) { return parts[part].size + parcel.size <= kPartBytes; };
    auto found = std::find_if(candidates.begin(), candidates.end(), fits);
    if (found == candidates.end()) {
      parts.push_back({std::get<0>(kind), 0, std::get<1>(kind), std::get<2>(kind), {}});
      candidates.push_back(parts.size() - 1);
      found = candidates.end() - 1;
    }
    Part& part = parts[*found];
    part.content.push_back({i, part.size});
    part.size += parcel.size;
  }
  return parts;
}

}  // namespace indurop::mirror
