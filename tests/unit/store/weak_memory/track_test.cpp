// SPDX-License-Identifier: Apache-2.0
// A track of the tape in every execution that C++ allows: its writer goes on, and what a reader gets is a whole run,
// later than the one before, or none.
#include <gmock/gmock.h>

#include "tests/support/weak_memory/substitute.h"

// NOLINTBEGIN(bugprone-suspicious-include): compiled here with the atomics of the model
#include "store/tape/track.cpp"
#include "store/tape/track_reader.cpp"
// NOLINTEND(bugprone-suspicious-include)

namespace indurop::vars {

// The track has no variables: nothing asks the store.
void* Store::entry(std::uint64_t /*name_hash*/, std::uint64_t /*type_hash*/) const noexcept {
  return nullptr;
}
std::span<const DirectoryEntry> Store::directory() const noexcept {
  return {};
}

}  // namespace indurop::vars

namespace indurop::tape {
namespace {

using test::weak::explore;
using test::weak::Outcome;
using test::weak::Program;
using test::weak::Weakening;

constexpr std::uint64_t kWords = 128;
constexpr std::int64_t kRunsBefore = 20;  // they fill the ring; the next run has to claim words

struct Memory {
  TapeHeader header;
  TapeTrack track;
  std::array<std::uint64_t, kWords> words;
};
alignas(Memory) std::array<std::byte, sizeof(Memory)> memory{};
alignas(vars::Store) std::array<std::byte, sizeof(vars::Store)> no_store{};

void record(Track& track, std::int64_t number) {
  track.begin();
  RunTail times;
  times.tick = static_cast<std::uint64_t>(number);
  times.release_ns = times.start_ns = times.end_ns = number;
  track.end(times, 0);
}

bool is_whole(const RunTail& tail) {
  const auto number = static_cast<std::int64_t>(tail.number);
  return tail.order == tail.number && tail.tick == tail.number && tail.release_ns == number &&
         tail.start_ns == number && tail.end_ns == number;
}

// One thread records `runs` more runs, another one reads `reads` from the oldest on.
Outcome read_while_recording(int runs, int reads, const Weakening& without = {}) {
  static std::optional<Track> track;
  static std::optional<TrackReader> reader;
  static std::string wrong;
  return explore(
      [=] {
        memory.fill(std::byte{0});
        wrong.clear();
        auto& tape = *reinterpret_cast<Memory*>(memory.data());
        tape.track.words = kWords;
        tape.track.data_offset = offsetof(Memory, words);
        track.emplace(memory.data(), tape.track, *reinterpret_cast<const vars::Store*>(no_store.data()));
        for (std::int64_t n = 0; n < kRunsBefore; ++n) {
          record(*track, n);
        }
        reader.emplace(TrackReader::Source{&tape.track, tape.words.data(), kWords, 0}, std::span<const TapeVariable>{},
                       true);
        return Program{{[=] {
                          for (std::int64_t n = kRunsBefore; n < kRunsBefore + runs; ++n) {
                            record(*track, n);
                          }
                        },
                        [=] {
                          Run run;
                          std::uint64_t next = 0;
                          for (int i = 0; i < reads && reader->next(run); ++i) {
                            wrong += is_whole(run.tail) ? "" : "torn ";
                            wrong += run.tail.number >= next ? "" : "back ";
                            next = run.tail.number + 1;
                          }
                        }},
                       [] { return wrong; }};
      },
      without);
}

TEST(WeakTrack, A_reader_gets_whole_runs_in_order) {
  const Outcome outcome = read_while_recording(2, 2);
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
  RecordProperty("states", std::to_string(outcome.states));
}

TEST(WeakTrack, Each_barrier_is_needed) {
  EXPECT_NE(read_while_recording(2, 1, {.no_acquire_fences = true}).wrong, "") << "in copy()";
  EXPECT_NE(read_while_recording(2, 1, {.no_release_fences = true}).wrong, "") << "in claim()";
}

}  // namespace
}  // namespace indurop::tape
