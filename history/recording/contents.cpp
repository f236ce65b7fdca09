// SPDX-License-Identifier: Apache-2.0
#include "history/recording/contents.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "history/recording/crc32.h"
#include "history/recording/record_bytes.h"

namespace indurop::recording {
namespace {

using base::Problem;

constexpr std::uint64_t kFooterBytes = 20;
constexpr std::uint64_t kEndBytes = kRecordHead + kFooterBytes + kMagic.size();
constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t{1} << 20U;

bool is_magic(View bytes) {
  return std::equal(bytes.begin(), bytes.end(), kMagic.begin(), kMagic.end());
}

// Returns the position where the data begins.
Result<std::uint64_t, Problem> read_header(const InputFile& file, McapHeader& header) {
  auto begin = file.read(0, std::min(file.size(), kMagic.size() + kRecordHead));
  if (!begin) {
    return std::move(begin).error();
  }
  if (begin->size < kMagic.size() || !is_magic(begin->view().first(kMagic.size()))) {
    return file.problem(0, "this is not a recording: it does not begin like an MCAP file");
  }
  if (begin->size < kMagic.size() + kRecordHead) {
    return file.problem(file.size(), "the file ends within its header");
  }
  const RecordHead head = record_head(begin->view().subspan(kMagic.size()));
  const std::uint64_t end = kMagic.size() + kRecordHead + head.length;
  if (head.opcode != Opcode::Header || head.length > kMaxHeaderBytes) {
    return file.problem(kMagic.size(), "this is not a recording: it has no header");
  }
  auto content = file.read(kMagic.size() + kRecordHead, head.length);
  if (!content) {
    return std::move(content).error();
  }
  if (!read_record(content->view(), header)) {
    return file.problem(kMagic.size(), "a damaged header");
  }
  return end;
}

enum class Summary : std::uint8_t {
  Good,
  Absent,  // there is none, or one that does not name all
  Damaged,
};

// Reads the records of a summary; on any doubt it is not used.
class SummaryReader {
 public:
  // The file's data is between `begin` and `end`.
  SummaryReader(std::uint64_t begin, std::uint64_t end, Contents& to) : begin_(begin), end_(end), to_(to) {}

  Summary run(View records) {
    while (!records.empty()) {
      if (records.size() < kRecordHead) {
        return Summary::Damaged;
      }
      const RecordHead head = record_head(records);
      records = records.subspan(kRecordHead);
      if (head.length > records.size() || !take(head.opcode, records.first(head.length))) {
        return Summary::Damaged;
      }
      records = records.subspan(head.length);
    }
    if (chunks_overlap()) {
      return Summary::Damaged;
    }
    return names_all() ? Summary::Good : Summary::Absent;
  }

 private:
  // Otherwise a small file could have its chunks read without end.
  [[nodiscard]] bool chunks_overlap() {
    auto& all = to_.segments;
    std::sort(all.begin(), all.end(), [](const Segment& a, const Segment& b) { return a.offset < b.offset; });
    return std::adjacent_find(all.begin(), all.end(), [](const Segment& a, const Segment& b) {
             return b.offset - a.offset < a.length;
           }) != all.end();
  }
  // Messages outside of chunks are in no index.
  [[nodiscard]] bool names_all() const {
    if (!statistics_) {
      return !to_.segments.empty();
    }
    return statistics_->chunks == to_.segments.size() && (statistics_->chunks > 0 || statistics_->messages == 0) &&
           statistics_->attachments == to_.attachments.size() && statistics_->metadata == to_.metadata.size();
  }
  bool take(Opcode opcode, View content) {
    switch (opcode) {
      case Opcode::Schema: {
        McapSchema schema;
        return read_record(content, schema) && to_.add(std::move(schema));
      }
      case Opcode::Channel: {
        McapChannel channel;
        return read_record(content, channel) && to_.add(std::move(channel));
      }
      case Opcode::ChunkIndex: {
        McapChunkIndex index;
        const bool good = read_record(content, index) && lies_in_data(index.offset, index.length);
        Segment& chunk =
            to_.segments.emplace_back(Segment{index.offset, index.length, true, index.start_ns, index.end_ns, {}});
        std::transform(index.index_offsets.begin(), index.index_offsets.end(), std::back_inserter(chunk.channels),
                       [](const auto& entry) { return entry.first; });
        return good;
      }
      case Opcode::AttachmentIndex: {
        McapAttachmentIndex& index = to_.attachments.emplace_back();
        return read_record(content, index) && lies_in_data(index.offset, index.length);
      }
      case Opcode::MetadataIndex: {
        McapMetadataIndex& index = to_.metadata.emplace_back();
        return read_record(content, index) && lies_in_data(index.offset, index.length);
      }
      case Opcode::Statistics:
        return read_record(content, statistics_.emplace());
      default:
        return true;
    }
  }
  [[nodiscard]] bool lies_in_data(std::uint64_t offset, std::uint64_t length) const {
    return offset >= begin_ && offset <= end_ && length <= end_ - offset && length >= kRecordHead;
  }

  std::uint64_t begin_;
  std::uint64_t end_;
  Contents& to_;
  std::optional<McapStatistics> statistics_;
};

// If the summary is not good, `to` is only partly filled.
Summary read_summary(const InputFile& file, std::uint64_t begin, Contents& to) {
  if (file.size() < begin + kEndBytes) {
    return Summary::Damaged;
  }
  const std::uint64_t footer_at = file.size() - kEndBytes;
  const auto end = file.read(footer_at, kEndBytes);
  if (!end || !is_magic(end->view().last(kMagic.size()))) {
    return Summary::Damaged;
  }
  const RecordHead head = record_head(end->view());
  McapFooter footer;
  if (head.opcode != Opcode::Footer || head.length != kFooterBytes ||
      !read_record(end->view().subspan(kRecordHead, kFooterBytes), footer)) {
    return Summary::Damaged;
  }
  if (footer.summary_start == 0) {
    return Summary::Absent;
  }
  if (footer.summary_start < begin || footer.summary_start > footer_at) {
    return Summary::Damaged;
  }
  const auto summary = file.read(footer.summary_start, footer_at - footer.summary_start);
  if (!summary) {
    return Summary::Damaged;
  }
  const std::uint32_t crc =
      crc32(end->view().first(kRecordHead + kFooterBytes - sizeof footer.summary_crc), crc32(summary->view()));
  return footer.summary_crc != 0 && footer.summary_crc != crc
             ? Summary::Damaged
             : SummaryReader(begin, footer.summary_start, to).run(summary->view());
}

template <class Record>
bool add_to(std::map<std::uint16_t, Record>& map, Record record) {
  const std::uint16_t id = record.id;
  const auto [at, added] = map.try_emplace(id, record);
  return added || at->second == record;
}

}  // namespace

std::pair<std::int64_t, std::int64_t> Contents::span_ns() const {
  std::uint64_t begin = UINT64_MAX;
  std::uint64_t end = 0;
  for (const Segment& segment : segments) {
    begin = std::min(begin, segment.start_ns);
    end = std::max(end, segment.end_ns);
  }
  return {begin == UINT64_MAX ? 0 : static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end)};
}

bool Contents::add(McapSchema schema) {
  return schema.id == 0 || add_to(schemas, std::move(schema));  // the format specifies: ignore number 0
}

bool Contents::add(McapChannel channel) {
  return add_to(channels, std::move(channel));
}

Result<Contents, Problem> read_contents(const InputFile& file) {
  McapHeader header;
  const auto begin = read_header(file, header);
  if (!begin) {
    return begin.error();
  }
  Contents out;
  const Summary summary = read_summary(file, *begin, out);
  if (summary != Summary::Good) {
    out = {};
    walk(file, *begin, out);
    if (summary == Summary::Damaged && out.damages.empty()) {
      out.damages.push_back(file.problem(file.size(), "the summary before this is cut or damaged; all data is there"));
    }
  }
  out.has_summary = summary == Summary::Good;
  out.header = std::move(header);
  return out;
}

}  // namespace indurop::recording
