// SPDX-License-Identifier: Apache-2.0
// The records of runs in a recording: one message of the channel indurop/runs at the end of each run. The values of a
// run are the messages with its module's number since the module's previous run. Times in messages are the node's; log
// times are CLOCK_REALTIME.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "store/tape/follower.h"

namespace indurop::recorder {

// The format version; increased when replays need something that older recordings lack. A recording without a version
// has version 1. Version 2 adds the results of snapshot(), valid(), age(), channels and the request to stop.
inline constexpr std::int64_t kRecordingFormat = 2;

inline constexpr std::string_view kRunsTopic = "indurop/runs";
inline constexpr std::string_view kRunSchema = "indurop::Run";
extern const std::string_view kRunIdl;

struct RunWords {
  tape::RunTail tail;
  std::uint32_t module = 0;
  bool faulted = false;
  bool anew = false;       // its module was started again since its previous run; always false in older recordings
  bool exchanged = false;  // another version of its code runs since its previous run; likewise
};
// The results of irp::now_ns() in runs: messages of the channel indurop/clock, in the order of a run's calls.
inline constexpr std::string_view kClockTopic = "indurop/clock";
inline constexpr std::string_view kClockSchema = "indurop::Clock";
extern const std::string_view kClockIdl;
void to_cdr(std::int64_t clock_ns, std::vector<std::uint8_t>& cdr);
// Errors: Corrupt.
Result<std::int64_t> clock_from_cdr(std::span<const std::uint8_t> cdr);

// The results of shared functions and channels in runs: messages of the channel indurop/told, in the order of the
// calls.
inline constexpr std::string_view kAnswerTopic = "indurop/told";
inline constexpr std::string_view kAnswerSchema = "indurop::Told";
extern const std::string_view kAnswerIdl;
struct AnswerRecord {
  std::int64_t code = 0;  // see tape::Answer
  std::span<const std::uint8_t> bytes;
};
void to_cdr(const AnswerRecord& answer, std::vector<std::uint8_t>& cdr);
// The result points into `cdr`. Errors: Corrupt.
Result<AnswerRecord> answer_from_cdr(std::span<const std::uint8_t> cdr);

// What modules keep between runs: messages of the channels indurop/keyframes/<module>, each before the run that begins
// with this state. The channel's metadata says what the bytes are: a line for each item of name, type and size.
inline constexpr std::string_view kKeyframeTopic = "indurop/keyframes/";
inline constexpr std::string_view kKeyframeSchema = "indurop::Keyframe";
inline constexpr const char* kKeyframeForm = "form";  // key in the channel's metadata
extern const std::string_view kKeyframeIdl;
struct KeyframeRecord {
  std::uint64_t run = 0;  // number of the run that begins with it
  std::uint64_t tick = 0;
  std::span<const std::uint8_t> bytes;
};
void to_cdr(const KeyframeRecord& keyframe, std::vector<std::uint8_t>& cdr);
// The result points into `cdr`. Errors: Corrupt.
Result<KeyframeRecord> keyframe_from_cdr(std::span<const std::uint8_t> cdr);

void to_cdr(const RunWords& run, std::vector<std::uint8_t>& cdr);
// Errors: Corrupt.
Result<RunWords> run_from_cdr(std::span<const std::uint8_t> cdr);

// The sequence number of a value's message: the module whose run it belongs to, and its kind.
struct ValueWords {
  std::uint32_t module = 0;  // tape::kOthers is mapped to kOthers
  tape::EntryKind kind{};    // Run: a first value, from before any module was started
};
inline constexpr std::uint32_t kOthers = 0x1fffffff;
std::uint32_t to_sequence(ValueWords words) noexcept;
ValueWords from_sequence(std::uint32_t sequence) noexcept;

}  // namespace indurop::recorder
