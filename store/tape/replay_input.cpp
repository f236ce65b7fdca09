// SPDX-License-Identifier: Apache-2.0
#include "store/tape/replay_input.h"

#include <algorithm>
#include <cstring>

#include "store/tape/layout.h"

namespace indurop::tape {
namespace {

constexpr std::uint64_t kMagic = 0x31444c4f54444e49ULL;  // "INDTOLD1"
constexpr std::size_t kWords = std::size_t{1} << 17U;    // a megabyte

struct Header {
  std::uint64_t magic = kMagic;
  std::uint32_t abi = kReplayInputAbi;
  std::int32_t node_pid = 0;
  std::uint64_t readings = 0;
  std::uint64_t answers = 0;
};
constexpr std::size_t kFirst = sizeof(Header) / sizeof(std::uint64_t);
constexpr std::size_t kAnswerHead = 2;  // code, bytes

std::string file_of(const std::string& node) {
  return vars::replay_input_file(node);
}

Header& header_of(const vars::ShmFile& file) noexcept {
  return *reinterpret_cast<Header*>(file.data());
}

}  // namespace

Result<ReplayInputWriter> ReplayInputWriter::create(const std::string& node, std::int32_t pid) {
  auto file = vars::ShmFile::create(file_of(node), kWords * sizeof(std::uint64_t));
  if (!file) {
    return file.error();
  }
  header_of(*file) = Header{.node_pid = pid};
  if (const Status published = file->publish(); !published) {
    return published.error();
  }
  return ReplayInputWriter(file_of(node), std::move(file).value());
}

ReplayInputWriter::~ReplayInputWriter() {
  if (!name_.empty()) {
    (void)vars::remove_shm_file(name_);
  }
}

void ReplayInputWriter::give(std::span<const std::int64_t> readings, std::span<const ReplayedAnswer> answers) noexcept {
  auto* const words = reinterpret_cast<std::uint64_t*>(file_.data());
  Header& header = header_of(file_);
  header.readings = std::min<std::size_t>(readings.size(), kMaxReadings);
  std::size_t at = kFirst;
  std::copy_n(readings.begin(), header.readings, words + at);
  at += header.readings;
  header.answers = 0;
  for (const ReplayedAnswer& answer : answers) {
    const std::size_t size = words_of(answer.bytes.size());
    if (at + kAnswerHead + size > kWords) {
      return;
    }
    words[at] = static_cast<std::uint64_t>(answer.code);
    words[at + 1] = answer.bytes.size();
    if (!answer.bytes.empty()) {
      std::memcpy(words + at + kAnswerHead, answer.bytes.data(), answer.bytes.size());
    }
    at += kAnswerHead + size;
    ++header.answers;
  }
}

Result<ReplayInputReader> ReplayInputReader::open(const std::string& node, std::int32_t pid) {
  auto file = vars::ShmFile::open(file_of(node), vars::Mode::ReadOnly);
  if (!file) {
    return file.error();
  }
  if (file->size() != kWords * sizeof(std::uint64_t) || header_of(*file).magic != kMagic) {
    return Error{Errc::Corrupt, 0, "the input of the replay is damaged"};
  }
  if (header_of(*file).abi != kReplayInputAbi) {
    return Error{Errc::VersionMismatch, 0, "the replay is of another release"};
  }
  if (header_of(*file).node_pid != pid) {
    return Error{Errc::NotFound, 0, "the replay is of another node"};
  }
  return ReplayInputReader(std::move(file).value());
}

ReplayInputReader::ReplayInputReader(vars::ShmFile file) : file_(std::move(file)), answers_(kMaxAnswers) {}

std::span<const std::int64_t> ReplayInputReader::readings() const noexcept {
  const std::uint64_t count = std::min<std::uint64_t>(header_of(file_).readings, kMaxReadings);
  return {reinterpret_cast<const std::int64_t*>(file_.data()) + kFirst, count};
}

std::span<const ReplayedAnswer> ReplayInputReader::answers() noexcept {
  const auto* const words = reinterpret_cast<const std::uint64_t*>(file_.data());
  const std::uint64_t count = std::min<std::uint64_t>(header_of(file_).answers, answers_.size());
  std::size_t at = kFirst + readings().size();
  std::size_t got = 0;
  for (; got < count && at + kAnswerHead <= kWords; ++got) {
    const std::uint64_t bytes = words[at + 1];
    at += kAnswerHead;
    if (bytes > (kWords - at) * sizeof(std::uint64_t)) {
      break;
    }
    answers_[got] = {static_cast<std::int64_t>(words[at - kAnswerHead]),
                     {reinterpret_cast<const std::uint8_t*>(words + at), bytes}};
    at += words_of(bytes);
  }
  return {answers_.data(), got};
}

}  // namespace indurop::tape
