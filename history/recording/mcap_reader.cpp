// SPDX-License-Identifier: Apache-2.0
#include "history/recording/mcap_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "history/recording/crc32.h"
#include "history/recording/record_bytes.h"

namespace indurop::recording {
namespace {

using base::Problem;

// Chunks with overlapping times must be in memory together.
constexpr std::uint64_t kMaxOpenBytes = 4 * kMaxChunkBytes;
constexpr std::uint64_t kMaxMetadataBytes = kMaxMessageBytes;

}  // namespace

McapReader::McapReader(InputFile file, Contents contents)
    : file_(std::move(file)), contents_(std::move(contents)), by_time_(contents_.segments) {
  std::stable_sort(by_time_.begin(), by_time_.end(),
                   [](const Segment& a, const Segment& b) { return a.start_ns < b.start_ns; });
}

Result<McapReader, Problem> McapReader::open(const std::filesystem::path& path) {
  auto file = InputFile::open(path);
  if (!file) {
    return std::move(file).error();
  }
  auto contents = read_contents(*file);
  if (!contents) {
    return std::move(contents).error();
  }
  return McapReader(std::move(*file), std::move(*contents));
}

void McapReader::seek(std::uint64_t log_time_ns) {
  from_ns_ = log_time_ns;
  next_segment_ = 0;
  open_.clear();
  open_bytes_ = 0;
  last_.reset();
}

Result<LoadedSegment, Problem> McapReader::load(const Segment& segment) const {
  auto loaded = recording::load(file_, segment);
  if (loaded && !loaded->messages.empty() && loaded->messages.front().log_time_ns < segment.start_ns) {
    return file_.problem(segment.offset, "a chunk with older messages than the summary says");
  }
  return loaded;
}

Result<void, Problem> McapReader::open_segment(const Segment& segment) {
  auto loaded = load(segment);
  if (!loaded) {
    return std::move(loaded).error();
  }
  auto& messages = loaded->messages;
  if (loaded->records.size > kMaxOpenBytes - open_bytes_) {
    return file_.problem(segment.offset, fmt::format("a chunk is skipped: those of its time together have more than "
                                                     "the {} bytes that are read at once",
                                                     kMaxOpenBytes));
  }
  const auto first = std::partition_point(messages.begin(), messages.end(),
                                          [this](const auto& each) { return each.log_time_ns < from_ns_; });
  if (first != messages.end()) {
    open_bytes_ += loaded->records.size;
    const auto next = static_cast<std::size_t>(first - messages.begin());
    open_.push_back({std::move(*loaded), next, segment.offset});
    std::push_heap(open_.begin(), open_.end());
  }
  return {};
}

Result<std::optional<McapMessage>, Problem> McapReader::next() {
  last_.reset();
  while (next_segment_ < by_time_.size() &&
         (open_.empty() || by_time_[next_segment_].start_ns <= open_.front().entry().log_time_ns)) {
    const Segment& segment = by_time_[next_segment_++];
    if (segment.end_ns < from_ns_) {
      continue;
    }
    if (auto opened = open_segment(segment); !opened) {
      return std::move(opened).error();
    }
  }
  if (open_.empty()) {
    return std::optional<McapMessage>();
  }
  std::pop_heap(open_.begin(), open_.end());
  Open& open = open_.back();
  const McapMessage message = open.loaded.message(open.entry());
  const std::uint64_t place = open.offset;
  ++open.next;
  if (open.next < open.loaded.messages.size()) {
    std::push_heap(open_.begin(), open_.end());
  } else {
    open_bytes_ -= open.loaded.records.size;
    last_ = std::move(open);
    open_.pop_back();
  }
  if (!contents_.channels.contains(message.channel)) {
    return file_.problem(place,
                         fmt::format("a chunk with a message of channel {}, which is not declared", message.channel));
  }
  return std::optional(message);
}

std::vector<std::string> McapReader::each(const std::function<void(const McapMessage&)>& use, std::uint64_t until_ns) {
  constexpr std::size_t kMaxDamages = 100;
  std::vector<std::string> damages;
  for (const Problem& damage : contents_.damages) {
    damages.push_back(damage.text);
  }
  while (damages.size() < kMaxDamages) {
    const auto message = next();
    if (!message) {
      damages.push_back(message.error().text);
    } else if (*message && (*message)->log_time_ns <= until_ns) {
      use(**message);
    } else {
      break;
    }
  }
  return damages;
}

Result<Bytes, Problem> McapReader::attachment(const McapAttachmentIndex& index) const {
  const auto content =
      file_.read_content(Opcode::Attachment, index.offset, index.length, kMaxAttachmentBytes + kMaxMetadataBytes);
  if (!content) {
    return content.error();
  }
  McapAttachment about;
  FieldReader reader(content->view());
  LongBytes data;
  std::uint32_t crc = 0;
  bool good = false;
  McapAttachment::fields(about, [&](auto&... field) { good = (reader.get(field) && ...); });
  if (!good || !reader.get(data) || !reader.get(crc)) {
    return file_.problem(index.offset, "a damaged attachment");
  }
  const auto counted = static_cast<std::size_t>(data.view.data() + data.view.size() - content->bytes.get());
  if (crc != 0 && crc != crc32(content->view().first(counted))) {
    return file_.problem(index.offset, fmt::format("a damaged attachment '{}': its CRC is wrong", about.name));
  }
  return Bytes(data.view.begin(), data.view.end());
}

Result<McapMetadata, Problem> McapReader::metadata(const McapMetadataIndex& index) const {
  const auto content = file_.read_content(Opcode::Metadata, index.offset, index.length, kMaxMetadataBytes);
  if (!content) {
    return content.error();
  }
  McapMetadata out;
  if (!read_record(content->view(), out)) {
    return file_.problem(index.offset, "damaged metadata");
  }
  return out;
}

}  // namespace indurop::recording
