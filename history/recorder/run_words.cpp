// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/run_words.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace indurop::recorder {
namespace {

constexpr std::array<std::uint8_t, 4> kLittleEndian{0, 1, 0, 0};
constexpr std::size_t kTailBytes = sizeof(tape::RunTail);
constexpr std::size_t kOldBytes = kLittleEndian.size() + kTailBytes + sizeof(std::uint32_t) + 1;
constexpr std::size_t kMessageBytes = kOldBytes + 1;
constexpr std::uint32_t kKindBits = 3;

}  // namespace

static_assert(std::endian::native == std::endian::little, "messages are copied as they lie in memory");

// The members are in the order of RunTail, so that a message is its bytes. IDL keywords ("module") cannot be names in
// it.
const std::string_view kRunIdl =
    "module indurop {\n"
    "  struct Run {\n"
    "    unsigned long long number;\n"
    "    unsigned long long order;\n"
    "    unsigned long long tick;\n"
    "    long long release_ns;\n"
    "    long long start_ns;\n"
    "    long long end_ns;\n"
    "    unsigned long module_index;\n"
    "    boolean faulted;\n"
    "    boolean anew;\n"
    "  };\n"
    "};\n";

const std::string_view kClockIdl =
    "module indurop {\n"
    "  struct Clock {\n"
    "    long long now_ns;\n"
    "  };\n"
    "};\n";

const std::string_view kAnswerIdl =
    "module indurop {\n"
    "  struct Told {\n"
    "    long long code;\n"
    "    sequence<octet> bytes;\n"
    "  };\n"
    "};\n";

const std::string_view kKeyframeIdl =
    "module indurop {\n"
    "  struct Keyframe {\n"
    "    unsigned long long run;\n"
    "    unsigned long long tick;\n"
    "    sequence<octet> bytes;\n"
    "  };\n"
    "};\n";

void to_cdr(std::int64_t clock_ns, std::vector<std::uint8_t>& cdr) {
  cdr.assign(kLittleEndian.begin(), kLittleEndian.end());
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof clock_ns>>(clock_ns);
  cdr.insert(cdr.end(), bytes.begin(), bytes.end());
}

Result<std::int64_t> clock_from_cdr(std::span<const std::uint8_t> cdr) {
  std::array<std::uint8_t, sizeof(std::int64_t)> bytes{};
  if (cdr.size() != kLittleEndian.size() + bytes.size() ||
      !std::equal(kLittleEndian.begin(), kLittleEndian.end(), cdr.begin())) {
    return Error{Errc::Corrupt, 0, "a time of a recording"};
  }
  std::copy_n(cdr.begin() + kLittleEndian.size(), bytes.size(), bytes.begin());
  return std::bit_cast<std::int64_t>(bytes);
}

void to_cdr(const AnswerRecord& answer, std::vector<std::uint8_t>& cdr) {
  to_cdr(answer.code, cdr);
  const auto length =
      std::bit_cast<std::array<std::uint8_t, sizeof(std::uint32_t)>>(static_cast<std::uint32_t>(answer.bytes.size()));
  cdr.insert(cdr.end(), length.begin(), length.end());
  cdr.insert(cdr.end(), answer.bytes.begin(), answer.bytes.end());
}

Result<AnswerRecord> answer_from_cdr(std::span<const std::uint8_t> cdr) {
  constexpr std::size_t kCodeEnd = kLittleEndian.size() + sizeof(std::int64_t);
  std::array<std::uint8_t, sizeof(std::uint32_t)> length{};
  const Error damaged{Errc::Corrupt, 0, "an input record of a recording"};
  if (cdr.size() < kCodeEnd + length.size()) {
    return damaged;
  }
  const auto code = clock_from_cdr(cdr.first(kCodeEnd));
  std::copy_n(cdr.begin() + kCodeEnd, length.size(), length.begin());
  const auto bytes = cdr.subspan(kCodeEnd + length.size());
  if (!code || bytes.size() != std::bit_cast<std::uint32_t>(length)) {
    return damaged;
  }
  return AnswerRecord{*code, bytes};
}

void to_cdr(const KeyframeRecord& keyframe, std::vector<std::uint8_t>& cdr) {
  cdr.assign(kLittleEndian.begin(), kLittleEndian.end());
  const auto append = [&cdr](const auto& value) {
    const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof value>>(value);
    cdr.insert(cdr.end(), bytes.begin(), bytes.end());
  };
  append(keyframe.run);
  append(keyframe.tick);
  append(static_cast<std::uint32_t>(keyframe.bytes.size()));
  cdr.insert(cdr.end(), keyframe.bytes.begin(), keyframe.bytes.end());
}

Result<KeyframeRecord> keyframe_from_cdr(std::span<const std::uint8_t> cdr) {
  std::array<std::uint64_t, 2> numbers{};
  std::uint32_t length = 0;
  constexpr std::size_t kHead = kLittleEndian.size() + sizeof numbers + sizeof length;
  if (cdr.size() < kHead || !std::equal(kLittleEndian.begin(), kLittleEndian.end(), cdr.begin())) {
    return Error{Errc::Corrupt, 0, "a keyframe of a recording"};
  }
  std::memcpy(numbers.data(), cdr.data() + kLittleEndian.size(), sizeof numbers);
  std::memcpy(&length, cdr.data() + kHead - sizeof length, sizeof length);
  if (cdr.size() - kHead != length) {
    return Error{Errc::Corrupt, 0, "a keyframe of a recording"};
  }
  return KeyframeRecord{numbers[0], numbers[1], cdr.subspan(kHead)};
}

void to_cdr(const RunWords& run, std::vector<std::uint8_t>& cdr) {
  cdr.assign(kLittleEndian.begin(), kLittleEndian.end());
  const auto tail = std::bit_cast<std::array<std::uint8_t, kTailBytes>>(run.tail);
  cdr.insert(cdr.end(), tail.begin(), tail.end());
  const auto module = std::bit_cast<std::array<std::uint8_t, sizeof run.module>>(run.module);
  cdr.insert(cdr.end(), module.begin(), module.end());
  cdr.push_back(run.faulted ? 1 : 0);
  cdr.push_back(run.anew ? 1 : 0);
}

Result<RunWords> run_from_cdr(std::span<const std::uint8_t> cdr) {
  if ((cdr.size() != kMessageBytes && cdr.size() != kOldBytes) ||
      !std::equal(kLittleEndian.begin(), kLittleEndian.end(), cdr.begin())) {
    return Error{Errc::Corrupt, 0, "a run of a recording"};
  }
  std::array<std::uint8_t, kTailBytes> tail{};
  std::copy_n(cdr.begin() + kLittleEndian.size(), kTailBytes, tail.begin());
  std::array<std::uint8_t, sizeof(std::uint32_t)> module{};
  std::copy_n(cdr.begin() + kLittleEndian.size() + kTailBytes, module.size(), module.begin());
  return RunWords{std::bit_cast<tape::RunTail>(tail), std::bit_cast<std::uint32_t>(module), cdr[kOldBytes - 1] != 0,
                  cdr.size() == kMessageBytes && cdr.back() != 0};
}

std::uint32_t to_sequence(ValueWords words) noexcept {
  return (words.module << kKindBits) | static_cast<std::uint32_t>(words.kind);
}

ValueWords from_sequence(std::uint32_t sequence) noexcept {
  return {sequence >> kKindBits, static_cast<tape::EntryKind>(sequence & ((1U << kKindBits) - 1))};
}

}  // namespace indurop::recorder
