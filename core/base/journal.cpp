// SPDX-License-Identifier: Apache-2.0
#include "core/base/journal.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace indurop::base {
namespace {

// A value with line feeds is preceded by its length: 64 bits, little endian.
void append(std::string& entry, std::string_view name, std::string_view value) {
  entry += name;
  if (value.find('\n') == std::string_view::npos) {
    entry += '=';
  } else {
    entry += '\n';
    for (unsigned shift = 0; shift < 64; shift += 8) {
      entry += static_cast<char>(std::uint64_t{value.size()} >> shift & 0xffU);
    }
  }
  entry += value;
  entry += '\n';
}

}  // namespace

bool stderr_is_journal() {
  const char* stream = std::getenv("JOURNAL_STREAM");  // device:inode of what systemd connected
  struct stat file {};
  return stream != nullptr && ::fstat(STDERR_FILENO, &file) == 0 &&
         fmt::format("{}:{}", file.st_dev, file.st_ino) == stream;
}

Journal::Journal(const std::string& socket) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  address_.sun_family = AF_UNIX;
  socket.copy(address_.sun_path, sizeof address_.sun_path - 1);
}

void Journal::write(Priority priority, std::string_view message, std::span<const Field> fields) const {
  if (!send(priority, message, fields)) {
    lost_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  if (const std::uint64_t lost = lost_.exchange(0, std::memory_order_relaxed); lost > 0) {
    const std::string text = fmt::format("{} messages were lost before: the journal did not take them", lost);
    if (!send(Priority::Warning, text, fields)) {
      lost_.fetch_add(lost, std::memory_order_relaxed);
    }
  }
}

bool Journal::send(Priority priority, std::string_view message, std::span<const Field> fields) const {
  std::string entry;
  append(entry, "MESSAGE", message);
  append(entry, "PRIORITY", std::to_string(static_cast<int>(priority)));
  for (const Field& field : fields) {
    append(entry, field.name, field.value);
  }
  return ::sendto(socket_.get(), entry.data(), entry.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address_),
                  sizeof address_) >= 0;
}

}  // namespace indurop::base
