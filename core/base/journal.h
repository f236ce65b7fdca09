// SPDX-License-Identifier: Apache-2.0
// Entries with fields for systemd's journal, in its native protocol (systemd.io/JOURNAL_NATIVE_PROTOCOL).

#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/descriptor.h"

namespace indurop::base {

// Returns true if the journal gets what this process writes to standard error: it is a service of systemd.
bool stderr_is_journal();

// Not real-time safe. Any thread may write.
class Journal {
 public:
  // The numbers of syslog(3).
  enum class Priority { Error = 3, Warning = 4, Info = 6 };
  struct Field {
    std::string_view name;  // capital letters, digits and '_'
    std::string_view value;
  };

  // `socket`: where the journal listens. It may come and go.
  explicit Journal(const std::string& socket = "/run/systemd/journal/socket");

  // Does not wait: entries that the journal does not take at once are counted, and the next one that it takes is
  // followed by their number.
  void write(Priority priority, std::string_view message, std::span<const Field> fields) const;

 private:
  [[nodiscard]] bool send(Priority priority, std::string_view message, std::span<const Field> fields) const;

  Descriptor socket_;
  sockaddr_un address_{};
  mutable std::atomic<std::uint64_t> lost_{0};
};

}  // namespace indurop::base
