// SPDX-License-Identifier: Apache-2.0
#include "core/base/line_journal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/base/descriptor.h"
#include "core/base/read_file.h"
#include "core/rt/file_lock.h"

namespace indurop::base {
namespace {

std::filesystem::path before(const std::filesystem::path& file) {
  return file.string() + ".1";
}

// A loss of power or a full disk may have left a part of a line.
bool ends_within_a_line(int file) {
  const off_t size = ::lseek(file, 0, SEEK_END);
  char last = '\n';
  return size > 0 && ::pread(file, &last, 1, size - 1) == 1 && last != '\n';
}

// Renames the open file if it has grown too large. Of several processes and threads that find this, one does it: those
// that come later would put the new file in the place of the one that was just put aside, which would be lost.
bool put_aside(const LineJournal& journal, int file) {
  struct stat own {};
  struct stat named {};
  return ::fstat(file, &own) == 0 && static_cast<std::uintmax_t>(own.st_size) > journal.max_bytes &&
         rt::lock_file(file, rt::FileLock::Exclusive).ok() && ::stat(journal.file.c_str(), &named) == 0 &&
         named.st_ino == own.st_ino && named.st_dev == own.st_dev &&
         ::rename(journal.file.c_str(), before(journal.file).c_str()) == 0;
}

Descriptor open_journal(const LineJournal& journal) {
  return Descriptor(::open(journal.file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, journal.mode));
}

}  // namespace

std::string append_line(const LineJournal& journal, std::string line) {
  std::error_code error;
  std::filesystem::create_directories(journal.file.parent_path(), error);
  Descriptor fd = open_journal(journal);
  if (fd.is_open() && put_aside(journal, fd.get())) {
    fd = open_journal(journal);
  }
  if (!fd.is_open()) {
    return std::strerror(errno);
  }
  line = (ends_within_a_line(fd.get()) ? "\n" : "") + line + '\n';
  const ssize_t written = ::write(fd.get(), line.data(), line.size());
  if (written >= 0 && static_cast<std::size_t>(written) < line.size()) {
    return std::strerror(ENOSPC);
  }
  const bool good = written >= 0 && (journal.durable == Durable::No || ::fdatasync(fd.get()) == 0);
  return good ? std::string() : std::strerror(errno);
}

void each_line(const std::filesystem::path& file, const std::function<void(std::string_view)>& use) {
  for (const std::filesystem::path& part : {before(file), file}) {
    const auto text = read_file(part);
    std::string_view rest = text ? std::string_view(*text) : std::string_view();
    while (!rest.empty()) {
      const auto end = std::min(rest.find('\n'), rest.size());
      use(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
}

}  // namespace indurop::base
