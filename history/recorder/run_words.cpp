// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/run_words.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <optional>

namespace indurop::recorder {
namespace {

constexpr std::array<std::uint8_t, 4> kLittleEndian{0, 1, 0, 0};
constexpr std::size_t kTailBytes = sizeof(tape::RunTail);
constexpr std::size_t kOldBytes = kLittleEndian.size() + kTailBytes + sizeof(std::uint32_t) + 1;
constexpr std::size_t kMessageBytes = kOldBytes + 2;
constexpr std::uint32_t kKindBits = 3;

void begin(std::vector<std::uint8_t>& cdr) {
  cdr.assign(kLittleEndian.begin(), kLittleEndian.end());
}

template <class T>
void append(const T& value, std::vector<std::uint8_t>& cdr) {
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
  cdr.insert(cdr.end(), bytes.begin(), bytes.end());
}

// A sequence<octet>.
void append_bytes(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& cdr) {
  append(static_cast<std::uint32_t>(bytes.size()), cdr);
  cdr.insert(cdr.end(), bytes.begin(), bytes.end());
}

bool is_little_endian(std::span<const std::uint8_t> cdr) {
  return cdr.size() >= kLittleEndian.size() && std::equal(kLittleEndian.begin(), kLittleEndian.end(), cdr.begin());
}

// `cdr` reaches beyond the value.
template <class T>
T read_at(std::span<const std::uint8_t> cdr, std::size_t offset) {
  std::array<std::uint8_t, sizeof(T)> bytes{};
  std::copy_n(cdr.begin() + static_cast<std::ptrdiff_t>(offset), bytes.size(), bytes.begin());
  return std::bit_cast<T>(bytes);
}

// Returns the sequence<octet> that fills the rest of a message; nullopt: it does not.
std::optional<std::span<const std::uint8_t>> bytes_at(std::span<const std::uint8_t> cdr, std::size_t offset) {
  const std::size_t begin = offset + sizeof(std::uint32_t);
  if (cdr.size() < begin || cdr.size() - begin != read_at<std::uint32_t>(cdr, offset)) {
    return std::nullopt;
  }
  return cdr.subspan(begin);
}

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
    "    boolean exchanged;\n"
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
  begin(cdr);
  append(clock_ns, cdr);
}

Result<std::int64_t> clock_from_cdr(std::span<const std::uint8_t> cdr) {
  if (cdr.size() != kLittleEndian.size() + sizeof(std::int64_t) || !is_little_endian(cdr)) {
    return Error{Errc::Corrupt, 0, "a time of a recording"};
  }
  return read_at<std::int64_t>(cdr, kLittleEndian.size());
}

void to_cdr(const AnswerRecord& answer, std::vector<std::uint8_t>& cdr) {
  begin(cdr);
  append(answer.code, cdr);
  append_bytes(answer.bytes, cdr);
}

Result<AnswerRecord> answer_from_cdr(std::span<const std::uint8_t> cdr) {
  const auto bytes = bytes_at(cdr, kLittleEndian.size() + sizeof(std::int64_t));
  if (!bytes || !is_little_endian(cdr)) {
    return Error{Errc::Corrupt, 0, "an input record of a recording"};
  }
  return AnswerRecord{read_at<std::int64_t>(cdr, kLittleEndian.size()), *bytes};
}

void to_cdr(const KeyframeRecord& keyframe, std::vector<std::uint8_t>& cdr) {
  begin(cdr);
  append(keyframe.run, cdr);
  append(keyframe.tick, cdr);
  append_bytes(keyframe.bytes, cdr);
}

Result<KeyframeRecord> keyframe_from_cdr(std::span<const std::uint8_t> cdr) {
  constexpr std::size_t kTick = kLittleEndian.size() + sizeof(std::uint64_t);
  const auto bytes = bytes_at(cdr, kTick + sizeof(std::uint64_t));
  if (!bytes || !is_little_endian(cdr)) {
    return Error{Errc::Corrupt, 0, "a keyframe of a recording"};
  }
  return KeyframeRecord{read_at<std::uint64_t>(cdr, kLittleEndian.size()), read_at<std::uint64_t>(cdr, kTick), *bytes};
}

void to_cdr(const RunWords& run, std::vector<std::uint8_t>& cdr) {
  begin(cdr);
  append(run.tail, cdr);
  append(run.module, cdr);
  cdr.push_back(run.faulted ? 1 : 0);
  cdr.push_back(run.anew ? 1 : 0);
  cdr.push_back(run.exchanged ? 1 : 0);
}

Result<RunWords> run_from_cdr(std::span<const std::uint8_t> cdr) {
  if (cdr.size() < kOldBytes || cdr.size() > kMessageBytes || !is_little_endian(cdr)) {
    return Error{Errc::Corrupt, 0, "a run of a recording"};
  }
  return RunWords{read_at<tape::RunTail>(cdr, kLittleEndian.size()),
                  read_at<std::uint32_t>(cdr, kLittleEndian.size() + kTailBytes), cdr[kOldBytes - 1] != 0,
                  cdr.size() > kOldBytes && cdr[kOldBytes] != 0, cdr.size() == kMessageBytes && cdr.back() != 0};
}

std::uint32_t to_sequence(ValueWords words) noexcept {
  return (words.module << kKindBits) | static_cast<std::uint32_t>(words.kind);
}

ValueWords from_sequence(std::uint32_t sequence) noexcept {
  return {sequence >> kKindBits, static_cast<tape::EntryKind>(sequence & ((1U << kKindBits) - 1))};
}

}  // namespace indurop::recorder
