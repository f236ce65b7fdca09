// SPDX-License-Identifier: Apache-2.0
// Finds everything in a file without a summary. Every chunk is read once, so that its channels are known and it is
// certain to be intact.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "history/recording/contents.h"
#include "history/recording/crc32.h"
#include "history/recording/record_bytes.h"

namespace indurop::recording {
namespace {

using base::Problem;

// The size of one read, and the maximum size up to which messages outside of chunks are combined.
constexpr std::uint64_t kPortion = std::uint64_t{1} << 20U;

// A piece of the file, so that small records are not read one by one.
class Window {
 public:
  explicit Window(const InputFile& file) : file_(file) {}

  // The file must have these bytes.
  Result<View, Problem> at(std::uint64_t offset, std::uint64_t length) {
    if (offset < begin_ || offset - begin_ > block_.size || length > block_.size - (offset - begin_)) {
      auto read = file_.read(offset, std::min(std::max(length, kPortion), file_.size() - offset));
      if (!read) {
        return std::move(read).error();
      }
      block_ = std::move(*read);
      begin_ = offset;
    }
    return block_.view().subspan(offset - begin_, length);
  }

 private:
  const InputFile& file_;
  Block block_;
  std::uint64_t begin_ = 0;
};

class Walk {
 public:
  Walk(const InputFile& file, std::uint64_t begin, Contents& to) : file_(file), at_(begin), to_(to), window_(file) {}

  void run() {
    while (step()) {
    }
  }

 private:
  // Reads one record; returns false at the end.
  bool step() {
    if (at_ == file_.size()) {
      return stop("the file was not closed; it ends here, after a whole record");
    }
    const bool has_head = file_.has(at_, kRecordHead);
    const auto bytes = window_.at(at_, has_head ? kRecordHead : file_.size() - at_);
    if (!bytes) {
      return stop(bytes.error().text);
    }
    const RecordHead head = has_head ? record_head(*bytes) : RecordHead{};
    if (has_head && head.opcode == Opcode{}) {
      return stop(fmt::format("no record begins here; what follows, up to byte {}, is not read", file_.size()));
    }
    if (!has_head || !file_.has(at_ + kRecordHead, head.length)) {
      return stop(fmt::format("the record that begins here is cut: the file ends at byte {}", file_.size()));
    }
    if (head.opcode == Opcode::DataEnd) {
      finish(head);
      return false;
    }
    if (head.opcode == Opcode::Footer) {
      return false;
    }
    take(head);
    at_ += kRecordHead + head.length;
    return true;
  }

  bool stop(std::string_view why) {
    damage(why);
    return false;
  }
  void damage(std::string_view why) { to_.damages.push_back(file_.problem(at_, why)); }

  void take(const RecordHead& head) {
    const std::uint64_t length = kRecordHead + head.length;
    switch (head.opcode) {
      case Opcode::Schema:
        return define<McapSchema>(head);
      case Opcode::Channel:
        return define<McapChannel>(head);
      case Opcode::Message:
        return take_message(head);
      case Opcode::Chunk:
        return take_chunk(length);
      case Opcode::Attachment: {
        // Its bytes are not needed, only the fields before them.
        McapAttachment about;
        const View begin = content(head, kPortion);
        const auto size = [&] {
          FieldReader reader(begin);
          std::uint64_t bytes = 0;
          McapAttachment::fields(about, [&](auto&... field) { (void)(reader.get(field) && ...); });
          return reader.get(bytes) ? bytes : head.length;
        }();
        if (size >= head.length) {
          return damage("a damaged attachment");
        }
        to_.attachments.push_back(
            {at_, length, about.log_time_ns, about.create_time_ns, size, about.name, about.media_type});
        return;
      }
      case Opcode::Metadata: {
        McapMetadata metadata;
        if (!read_record(content(head, kMaxMessageBytes), metadata)) {
          return damage("damaged metadata");
        }
        to_.metadata.push_back({at_, length, metadata.name});
        return;
      }
      default:
        return;
    }
  }

  // Returns the beginning of the record's content, at most `most` bytes of it; empty if it cannot be read.
  View content(const RecordHead& head, std::uint64_t most) {
    const auto bytes = window_.at(at_ + kRecordHead, std::min(head.length, most));
    return bytes ? *bytes : View{};
  }

  template <class Record>
  void define(const RecordHead& head) {
    Record record;
    if (!read_record(content(head, kMaxMessageBytes), record)) {
      return damage("a damaged schema or channel");
    }
    add(std::move(record));
  }
  template <class Record>
  void add(Record record) {
    const std::uint16_t id = record.id;
    if (!to_.add(std::move(record))) {
      damage(fmt::format("schema or channel {} is here again, but it is another one; the first one counts", id));
    }
  }

  void take_message(const RecordHead& head) {
    McapMessage message;
    if (head.length > kMaxMessageBytes || !read_record(content(head, kPortion), message)) {
      return damage("a damaged message");
    }
    const std::uint64_t length = kRecordHead + head.length;
    const std::uint64_t time = message.log_time_ns;
    if (!to_.segments.empty()) {
      Segment& last = to_.segments.back();
      if (!last.is_chunk && last.offset + last.length == at_ && last.length < kPortion) {
        last.length += length;
        last.start_ns = std::min(last.start_ns, time);
        last.end_ns = std::max(last.end_ns, time);
        return;
      }
    }
    to_.segments.push_back({at_, length, false, time, time, {}});
  }

  void take_chunk(std::uint64_t length) {
    Segment segment{at_, length, true, 0, 0, {}};
    auto loaded = load(file_, segment);
    if (!loaded) {
      to_.damages.push_back(std::move(loaded).error());
      return;
    }
    for (McapSchema& schema : loaded->schemas) {
      add(std::move(schema));
    }
    for (McapChannel& channel : loaded->channels) {
      add(std::move(channel));
    }
    if (!loaded->messages.empty()) {
      segment.start_ns = loaded->messages.front().log_time_ns;
      segment.end_ns = loaded->messages.back().log_time_ns;
      to_.segments.push_back(segment);
    }
  }

  // All data was found; checks it against the recorded CRC.
  void finish(const RecordHead& head) {
    McapDataEnd end;
    if (!read_record(content(head, kPortion), end)) {
      return damage("a damaged end of the data");
    }
    std::uint32_t crc = 0;
    for (std::uint64_t at = 0; end.crc != 0 && at < at_;) {
      const auto bytes = window_.at(at, std::min(kPortion, at_ - at));
      if (!bytes) {
        return damage(bytes.error().text);
      }
      crc = crc32(*bytes, crc);
      at += bytes->size();
    }
    if (crc != end.crc) {
      return damage(fmt::format("the CRC of all before this is {:08x}, it should be {:08x}", crc, end.crc));
    }
  }

  const InputFile& file_;
  std::uint64_t at_;
  Contents& to_;
  Window window_;
};

}  // namespace

void walk(const InputFile& file, std::uint64_t begin, Contents& contents) {
  Walk(file, begin, contents).run();
}

}  // namespace indurop::recording
