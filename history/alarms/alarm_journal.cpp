// SPDX-License-Identifier: Apache-2.0
#include "history/alarms/alarm_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/read_file.h"
#include "core/rt/file_lock.h"
#include "store/vars/retain.h"

namespace indurop::alarms {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{8} << 20U;
constexpr mode_t kFileMode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH;

// Calls `use` for each complete line and returns the total size of these lines in bytes.
template <class Use>
std::size_t for_each_line(std::string_view text, Use use) {
  std::size_t done = 0;
  for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', done)) {
    use(text.substr(done, end - done));
    done = end + 1;
  }
  return done;
}

void read_entries(const std::filesystem::path& file, std::vector<AlarmEntry>& to) {
  const auto text = base::read_file(file);
  for_each_line(text ? std::string_view(*text) : std::string_view(), [&to](std::string_view line) {
    if (auto entry = parse_alarm_line(line); entry && entry->event) {
      to.push_back(std::move(*entry));
    }
  });
}

std::string problem() {
  return std::strerror(errno);
}

// Appends the whole text and syncs it to the disk.
std::string write_all(const std::filesystem::path& file, int flags, const std::string& text) {
  const base::Descriptor fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, kFileMode));
  const bool good = fd.is_open() && ::write(fd.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                    ::fdatasync(fd.get()) == 0;
  return good ? std::string() : problem();
}

}  // namespace

AlarmJournal::AlarmJournal(const std::string& node) : AlarmJournal(vars::state_directory(node) / "alarms", kMaxBytes) {}

AlarmJournal::AlarmJournal(std::filesystem::path folder, std::size_t max_bytes)
    : folder_(std::move(folder)), max_bytes_(max_bytes) {}

void AlarmJournal::refresh() {
  const base::Descriptor fd(::open(file().c_str(), O_RDONLY | O_CLOEXEC));
  struct stat info {};
  if (!fd.is_open() || ::fstat(fd.get(), &info) != 0) {
    return;
  }
  if (info.st_ino != inode_ || info.st_size < read_) {
    book_ = AlarmBook();
    inode_ = info.st_ino;
    read_ = 0;
  }
  if (info.st_size == read_) {
    return;
  }
  std::string text(static_cast<std::size_t>(info.st_size - read_), '\0');
  const ssize_t count = ::pread(fd.get(), text.data(), text.size(), read_);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  read_ += static_cast<off_t>(for_each_line(text, [this](std::string_view line) {
    if (const auto entry = parse_alarm_line(line)) {
      book_.add(*entry);
    }
  }));
}

std::string AlarmJournal::change(const std::function<std::vector<AlarmEntry>(const AlarmBook&)>& decide) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  const base::Descriptor lock(::open((folder_ / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kFileMode));
  if (!lock.is_open() || !rt::lock_file_when_free(lock.get(), rt::FileLock::Exclusive)) {
    return fmt::format("{}: {}", folder_.string(), problem());
  }
  refresh();
  const std::vector<AlarmEntry> entries = decide(book_);
  std::string why = entries.empty() ? std::string() : append(entries);
  refresh();
  if (why.empty() && static_cast<std::size_t>(read_) > max_bytes_) {
    why = cut();
  }
  return why.empty() ? why : fmt::format("{}: {}", file().string(), why);
}

std::string AlarmJournal::append(const std::vector<AlarmEntry>& entries) {
  std::string text;
  struct stat info {};
  if (::stat(file().c_str(), &info) == 0 && info.st_size > read_) {
    text.push_back('\n');  // after a line that a loss of power has truncated
  }
  for (const AlarmEntry& entry : entries) {
    text += json_of(entry).dump() + "\n";
  }
  return write_all(file(), O_APPEND, text);
}

// The new file replaces the old one in one step, so there is a complete one at all times.
std::string AlarmJournal::cut() {
  std::string text;
  for (const auto& [name, record] : book_.standing()) {
    AlarmEntry entry = record.last;
    entry.alarm = name;
    entry.event.reset();
    entry.state = record.state;
    entry.wall_ns = record.since_ns;
    entry.count = record.count;
    text += json_of(entry).dump() + "\n";
  }
  const std::filesystem::path fresh = folder_ / "events.jsonl.new";
  std::string why = write_all(fresh, O_TRUNC, text);
  if (why.empty()) {
    std::error_code error;
    std::filesystem::remove(older(), error);
    std::filesystem::create_hard_link(file(), older(), error);
    why = ::rename(fresh.c_str(), file().c_str()) == 0 ? std::string() : problem();
  }
  refresh();
  return why;
}

std::vector<AlarmEntry> AlarmJournal::history(std::size_t most) const {
  std::vector<AlarmEntry> all;
  read_entries(older(), all);
  read_entries(file(), all);
  if (all.size() > most) {
    all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(most));
  }
  return all;
}

bool AlarmJournal::become_watcher() {
  if (watching_.is_open()) {
    return true;
  }
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  base::Descriptor fd(::open((folder_ / "watcher").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kFileMode));
  if (!fd.is_open() || !rt::lock_file(fd.get(), rt::FileLock::Exclusive)) {
    return false;
  }
  watching_ = std::move(fd);
  return true;
}

bool AlarmJournal::watched() const {
  if (watching_.is_open()) {
    return true;
  }
  const base::Descriptor fd(::open((folder_ / "watcher").c_str(), O_RDONLY | O_CLOEXEC));
  const Status free = fd.is_open() ? rt::lock_file(fd.get(), rt::FileLock::Shared) : Status();
  return !free && free.error().code == Errc::Busy;
}

}  // namespace indurop::alarms
