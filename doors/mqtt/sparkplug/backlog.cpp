// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/sparkplug/backlog.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <indurop/detail/abi.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::mqtt {
namespace {

constexpr std::uint64_t kLeastBytes = std::uint64_t{1} << 20U;
constexpr std::uint64_t kSegments = 32;  // of the room that is allowed
constexpr std::uint32_t kNamesRecord = 1;
constexpr std::uint32_t kDataRecord = 2;
constexpr const char* kSegmentEnding = ".backlog";
constexpr mode_t kSegmentMode = 0600;

// Before each record.
struct RecordHeader {
  std::uint64_t check = 0;  // fnv1a64 of kind and body
  std::uint32_t size = 0;   // of the body
  std::uint32_t kind = 0;
};

std::uint64_t check_of(std::uint32_t kind, std::string_view body) {
  return abi::fnv1a64(body.data(), body.size()) ^ kind;
}

// Returns the record at the front; nothing if it is not complete.
struct FoundRecord {
  std::uint32_t kind;
  std::string_view body;
};
std::optional<FoundRecord> record_at(std::string_view bytes) {
  RecordHeader header;
  if (bytes.size() < sizeof header) {
    return std::nullopt;
  }
  std::memcpy(&header, bytes.data(), sizeof header);
  if (bytes.size() - sizeof header < header.size) {
    return std::nullopt;
  }
  const std::string_view body = bytes.substr(sizeof header, header.size);
  return header.check == check_of(header.kind, body) ? std::optional(FoundRecord{header.kind, body}) : std::nullopt;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t size = ::write(file, bytes.data(), bytes.size());
    if (size < 0 && errno != EINTR) {
      return false;
    }
    bytes.remove_prefix(size > 0 ? static_cast<std::size_t>(size) : 0);
  }
  return true;
}

}  // namespace

Result<Backlog, base::Problem> Backlog::open(const std::filesystem::path& folder, std::uint64_t most_bytes) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return base::Problem{fmt::format("cannot make the folder {}: {}", folder.string(), error.message())};
  }
  Backlog backlog(folder, std::max(most_bytes, kLeastBytes));
  backlog.find_segments();
  backlog.rewind();
  return backlog;
}

std::filesystem::path Backlog::file_of(std::uint64_t segment) const {
  return folder_ / fmt::format("{:020}{}", segment, kSegmentEnding);
}

// A file of a program that was killed may end with a part of a record, which does not count.
std::uint64_t Backlog::complete_bytes(std::uint64_t segment) const {
  const auto text = base::read_file(file_of(segment));
  std::uint64_t at = 0;
  while (text) {
    const auto record = record_at(std::string_view(*text).substr(at));
    if (!record) {
      break;
    }
    at += sizeof(RecordHeader) + record->body.size();
  }
  return at;
}

void Backlog::find_segments() {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string name = entry.path().filename().string();
    std::uint64_t number = 0;
    const auto parsed = std::from_chars(name.data(), name.data() + name.size(), number);
    if (parsed.ec == std::errc() && std::string_view(parsed.ptr) == kSegmentEnding) {
      bytes_[number] = complete_bytes(number);
      last_segment_ = std::max(last_segment_, number);
    }
  }
}

void Backlog::rewind() {
  read_ = {bytes_.empty() ? 0 : bytes_.begin()->first, 0};
  names_of_ = 0;
  const auto file = base::read_file(folder_ / "position");
  std::istringstream text(file ? *file : std::string());
  Position kept;
  if (text >> kept.segment >> kept.offset && kept.segment == read_.segment) {
    read_ = kept;
  }
}

void Backlog::set_names(const std::string& board, const Payload& names) {
  std::string body;
  body += static_cast<char>(board.size());  // names of boards are short
  body += board.substr(0, UINT8_MAX);
  body += encode(names);
  if (names_[board] != body) {
    names_[board] = std::move(body);
    written_names_.erase(board);
  }
}

std::string Backlog::begin_segment() {
  written_names_.clear();
  writing_ = ++last_segment_;
  const auto path = file_of(writing_);
  file_ = base::Descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, kSegmentMode));
  if (!file_.is_open()) {
    return base::cannot_write(path, base::file_problem(errno));
  }
  bytes_[writing_] = 0;
  if (bytes_.size() == 1) {
    read_ = {writing_, 0};
  }
  return {};
}

std::string Backlog::write_record(std::uint32_t kind, const std::string& body) {
  RecordHeader header;
  header.size = static_cast<std::uint32_t>(body.size());
  header.kind = kind;
  header.check = check_of(header.kind, body);
  std::string bytes(sizeof header, '\0');
  std::memcpy(bytes.data(), &header, sizeof header);
  bytes += body;
  if (!write_all(file_.get(), bytes)) {
    std::string why = base::cannot_write(file_of(writing_), base::file_problem(errno));
    (void)file_.close();  // what follows half a record could not be read
    return why;
  }
  bytes_[writing_] += bytes.size();
  unsynced_ = true;
  return {};
}

std::string Backlog::add(const std::string& board, const Payload& data) {
  make_room();
  std::string why = file_.is_open() ? std::string() : begin_segment();
  if (why.empty() && !written_names_.contains(board)) {
    why = write_record(kNamesRecord, names_[board]);
    if (why.empty()) {
      written_names_.insert(board);
    }
  }
  return why.empty() ? write_record(kDataRecord, encode(data)) : why;
}

void Backlog::sync() {
  if (unsynced_ && file_.is_open()) {
    (void)::fdatasync(file_.get());
  }
  unsynced_ = false;
}

void Backlog::make_room() {
  if (file_.is_open() && bytes_[writing_] > most_bytes_ / kSegments) {
    sync();
    (void)file_.close();
  }
  std::uint64_t total = 0;
  for (const auto& [segment, size] : bytes_) {
    total += size;
  }
  while (total > most_bytes_ && !bytes_.empty()) {
    const auto [segment, size] = *bytes_.begin();
    total -= size;
    lost_bytes_ += size;
    remove(segment);
  }
}

void Backlog::remove(std::uint64_t segment) {
  if (segment == writing_) {
    (void)file_.close();
  }
  std::error_code ignored;
  std::filesystem::remove(file_of(segment), ignored);
  bytes_.erase(segment);
  if (read_.segment <= segment) {
    read_ = {bytes_.empty() ? 0 : bytes_.begin()->first, 0};
  }
}

std::vector<Backlog::Stored> Backlog::read(std::uint64_t most_bytes) {
  std::vector<Stored> all;
  while (all.empty() && bytes_.contains(read_.segment)) {
    const Position before = read_;
    read_segment(most_bytes, all);
    if (all.empty() && read_ == before) {
      const auto next = bytes_.upper_bound(read_.segment);
      if (next == bytes_.end()) {
        break;
      }
      read_ = {next->first, 0};
    }
  }
  return all;
}

void Backlog::read_segment(std::uint64_t most_bytes, std::vector<Stored>& to) {
  if (text_of_ != read_.segment || text_.size() < bytes_[read_.segment]) {
    auto text = base::read_file(file_of(read_.segment));
    text_ = text ? std::move(*text) : std::string();
    text_of_ = read_.segment;
  }
  const std::string_view bytes = text_;
  std::uint64_t at = read_.offset;
  if (names_of_ != read_.segment) {  // those before the present place are needed, too
    known_.clear();
    names_of_ = read_.segment;
    at = 0;
  }
  const std::uint64_t end = read_.offset + most_bytes;
  while (at < bytes.size() && at < end) {
    const auto record = record_at(bytes.substr(at));
    if (!record) {
      break;
    }
    const Position begin{read_.segment, at};
    at += sizeof(RecordHeader) + record->body.size();
    if (record->kind == kNamesRecord) {
      take_names(record->body);
    } else if (begin >= read_) {
      auto some = data_of(record->body, begin, {read_.segment, at});
      std::move(some.begin(), some.end(), std::back_inserter(to));
    }
  }
  read_.offset = std::max(read_.offset, at);
}

void Backlog::take_names(std::string_view body) {
  const std::size_t size = body.empty() ? 0 : static_cast<unsigned char>(body.front());
  if (body.size() < 1 + size) {
    return;
  }
  const std::string board(body.substr(1, size));
  const auto names = decode(body.substr(1 + size));
  for (const Metric& metric : names ? names->metrics : std::vector<Metric>()) {
    if (metric.alias) {
      known_[*metric.alias] = {board, metric.name};
    }
  }
}

std::vector<Backlog::Stored> Backlog::data_of(std::string_view body, const Position& begin, const Position& end) const {
  std::vector<Stored> all;
  auto data = decode(body);
  if (!data) {
    return all;
  }
  Stored one;
  one.begin = begin;
  one.end = end;
  one.payload.timestamp_ms = data->timestamp_ms;
  for (Metric& metric : data->metrics) {
    const auto name = metric.alias ? known_.find(*metric.alias) : known_.end();
    if (name == known_.end()) {
      continue;
    }
    one.board = name->second.board;
    metric.name = name->second.metric;
    metric.alias.reset();
    metric.timestamp_ms = data->timestamp_ms;
    metric.is_historical = true;
    one.payload.metrics.push_back(std::move(metric));
  }
  if (!one.payload.metrics.empty()) {
    all.push_back(std::move(one));
  }
  return all;
}

void Backlog::commit(const Position& end) {
  while (!bytes_.empty() && bytes_.begin()->first < end.segment) {
    remove(bytes_.begin()->first);
  }
  const auto segment = bytes_.find(end.segment);
  if (segment != bytes_.end() && bytes_.size() == 1 && end.offset >= segment->second) {
    remove(end.segment);  // everything was sent
  }
  if (bytes_.empty()) {
    std::error_code ignored;
    std::filesystem::remove(folder_ / "position", ignored);
    return;
  }
  (void)base::replace_file(folder_ / "position", fmt::format("{} {}\n", end.segment, end.offset), base::Durable::No);
}

}  // namespace indurop::mqtt
