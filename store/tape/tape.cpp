// SPDX-License-Identifier: Apache-2.0
#include "store/tape/tape.h"

#include <unistd.h>

#include <algorithm>
#include <span>
#include <utility>

#include "store/tape/check.h"
#include "store/tape/layout.h"
#include "store/vars/process.h"

namespace indurop::tape {
namespace {

constexpr std::uint64_t up(std::uint64_t bytes) noexcept {
  return (bytes + kLine - 1) / kLine * kLine;
}

// Offsets of all parts.
struct Layout {
  std::uint64_t variables = up(sizeof(TapeHeader));
  std::uint64_t tracks = 0;
  std::uint64_t versions = 0;
  std::vector<std::uint64_t> first;  // of each variable
  std::vector<std::uint64_t> items;  // of each track
  std::vector<std::uint64_t> words;
  std::uint64_t total = 0;
};

std::vector<std::uint32_t> items_of(const TrackPlan& track) {
  std::vector<std::uint32_t> items = track.only_read;
  items.insert(items.end(), track.both.begin(), track.both.end());
  items.insert(items.end(), track.only_written.begin(), track.only_written.end());
  return items;
}

Layout lay_out(std::span<const vars::DirectoryEntry> directory, const TapePlan& plan, std::size_t modules) {
  Layout layout;
  layout.tracks = up(layout.variables + (directory.size() + kLaterVariables) * sizeof(TapeVariable));
  layout.versions = up(layout.tracks + plan.tracks.size() * sizeof(TapeTrack));
  layout.total = up(layout.versions + (modules + kLaterVersions) * sizeof(TapeVersion));
  for (const vars::DirectoryEntry& entry : directory) {
    layout.first.push_back(layout.total);
    layout.total += words_of(entry.value_size) * sizeof(std::uint64_t);
  }
  for (const TrackPlan& track : plan.tracks) {
    layout.items.push_back(layout.total = up(layout.total));
    layout.total += items_of(track).size() * sizeof(std::uint32_t);
    layout.words.push_back(layout.total = up(layout.total));
    layout.total += track.words * sizeof(std::uint64_t);
  }
  return layout;
}

void keep_first_values(std::byte* memory, const vars::Store& store, const Layout& layout, const TapePlan& plan) {
  auto* const variables = reinterpret_cast<TapeVariable*>(memory + layout.variables);
  for (std::size_t i = 0; i < store.directory().size(); ++i) {
    const vars::DirectoryEntry& entry = store.directory()[i];
    variables[i] = {entry.name_hash, layout.first[i], entry.value_size, plan.taped[i] ? 1U : 0U};
    (void)store.read(entry, 0, {reinterpret_cast<std::uint8_t*>(memory + layout.first[i]), entry.value_size});
  }
}

}  // namespace

Result<std::unique_ptr<Tape>> Tape::create(const std::string& node, const vars::Store& store, const TapePlan& plan,
                                           std::size_t modules) {
  const Layout layout = lay_out(store.directory(), plan, modules);
  auto file = vars::ShmFile::create(vars::tape_file(node), layout.total);
  if (!file) {
    return file.error();
  }
  std::unique_ptr<Tape> tape(new Tape(std::move(file).value(), store));
  std::byte* const memory = tape->file_.data();
  auto& header = *reinterpret_cast<TapeHeader*>(memory);
  header.abi = kTapeAbi;
  header.track_count = static_cast<std::uint32_t>(plan.tracks.size());
  header.total_size = layout.total;
  header.layout_hash = store.header().layout_hash;
  header.node_pid = ::getpid();
  header.variable_count = static_cast<std::uint32_t>(store.directory().size());
  header.node_start_time = vars::process_start_time(::getpid());
  header.variables_offset = layout.variables;
  header.tracks_offset = layout.tracks;
  header.versions_offset = layout.versions;
  header.start_versions = static_cast<std::uint32_t>(modules);
  tape->versions_ = VersionTable({reinterpret_cast<TapeVersion*>(memory + layout.versions), modules + kLaterVersions});
  keep_first_values(memory, store, layout, plan);
  tape->by_module_.resize(modules);
  for (std::size_t i = 0; i < plan.tracks.size(); ++i) {
    const TrackPlan& track = plan.tracks[i];
    auto& shared = reinterpret_cast<TapeTrack*>(memory + layout.tracks)[i];
    shared.data_offset = layout.words[i];
    shared.words = track.words;
    shared.module = track.module;
    shared.only_read = static_cast<std::uint32_t>(track.only_read.size());
    shared.both = static_cast<std::uint32_t>(track.both.size());
    shared.only_written = static_cast<std::uint32_t>(track.only_written.size());
    shared.items_offset = layout.items[i];
    std::ranges::copy(items_of(track), reinterpret_cast<std::uint32_t*>(memory + layout.items[i]));
    tape->tracks_.push_back(std::make_unique<Track>(memory, shared, store));
    Track* const made = tape->tracks_.back().get();
    if (track.module == kOthers) {
      tape->others_ = made;
    } else {
      tape->by_module_[track.module] = {made, &shared.head, made->next()};
    }
  }
  header.magic.store(kTapeMagic, std::memory_order_release);
  if (Status published = tape->file_.publish(); !published) {
    return published.error();
  }
  return tape;
}

std::vector<std::uint32_t> Tape::offer(std::uint32_t module, std::span<const VariableUse> uses) {
  Track* const track = of(module);
  auto& header = *reinterpret_cast<TapeHeader*>(file_.data());
  auto* const variables = reinterpret_cast<TapeVariable*>(file_.data() + header.variables_offset);
  const auto directory = store_.directory();
  const std::size_t known = std::min<std::size_t>(directory.size(), header.variable_count + kLaterVariables);
  for (std::size_t i = header.variable_count + header.later_variables.load(); i < known; ++i) {
    variables[i] = {directory[i].name_hash, 0, directory[i].value_size, 1};
  }
  header.later_variables.store(static_cast<std::uint32_t>(known) - header.variable_count, std::memory_order_release);
  std::vector<VariableUse> later(uses.begin(), uses.end());
  std::erase_if(later, [&](const VariableUse& use) { return use.variable < header.variable_count; });
  std::vector<std::uint32_t> left_out;
  std::erase_if(later, [&](const VariableUse& use) {
    const bool fits = use.variable < known && track->has_room_for(directory[use.variable].value_size);
    if (!fits) {
      left_out.push_back(use.variable);
    }
    return !fits;
  });
  track->offer(later, store_);
  return left_out;
}

void Tape::soon(std::uint32_t module) const noexcept {
  const Place& place = by_module_[module];
  const auto* const track = reinterpret_cast<const std::byte*>(place.track);
  const auto* const next = static_cast<const std::byte*>(place.next);
  __builtin_prefetch(track, 1);
  __builtin_prefetch(track + kLine, 1);
  __builtin_prefetch(place.shared, 1);
  __builtin_prefetch(next, 1);
  __builtin_prefetch(next + kLine, 1);  // a run is about as long as a line
}

bool Tape::end(std::uint32_t module, const RunTail& times, std::uint32_t flags) noexcept {
  Place& place = by_module_[module];
  const bool much = place.track->end(times, flags);
  place.next = place.track->next();
  return much;
}

void Tape::end_of_dead(std::uint32_t module, const RunTail& times) {
  const auto& header = header_of(file_.data());
  auto* const tracks = reinterpret_cast<TapeTrack*>(file_.data() + header.tracks_offset);
  for (std::uint32_t i = 0; i < header.track_count; ++i) {
    if (tracks[i].module == module) {
      Track(file_.data(), tracks[i], store_).end_of_dead(times);
    }
  }
}

}  // namespace indurop::tape
