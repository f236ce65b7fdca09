// SPDX-License-Identifier: Apache-2.0
// The connection of a PLC program built with --debug to `indurop plc debug`, which can halt it at any statement. Only
// for simulations: a halted program does not return, and nothing here is real-time safe.

#pragma once

#include <indurop/plc/watch.h>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace indurop::iec {

class DebugFrame;

// One object per module. Does nothing unless INDUROP_PLC_DEBUG names the socket of a debugger.
class Debugger {
 public:
  // `mark`: identifies the program to the debugger.
  Debugger(const char* module, std::uint64_t mark) noexcept : module_(module), mark_(mark) {}
  Debugger(const Debugger&) = delete;
  Debugger& operator=(const Debugger&) = delete;
  ~Debugger() { disconnect(); }

  // Begins a scan. `show` writes the `bytes` bytes of the shared variables as the scan sees them.
  void begin(std::int64_t time_ns, std::size_t bytes, void (*show)(Watch&)) {
    time_ns_ = time_ns;
    bytes_ = bytes;
    show_ = show;
    top_ = nullptr;
    thrown_.clear();
    if (!tried_) {
      tried_ = true;
      connect();
    }
    ask('B', 0, "");
  }
  // Announces that the statement with this number is next.
  void line(std::uint32_t number) {
    last_ = number;
    const bool stops = mode_ == 'i' || (mode_ == 'o' && depth() <= limit_) ||
                       std::binary_search(breakpoints_.begin(), breakpoints_.end(), number);
    if (stops) {
      ask('S', number, "");
    }
  }
  // Reports a fault that ends the scan, and the program with it.
  void fault(const char* why) { ask('F', last_, why); }

 private:
  friend class DebugFrame;

  void connect() {
    const char* path = std::getenv("INDUROP_PLC_DEBUG");
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    if (path == nullptr || std::strlen(path) >= sizeof to.sun_path) {
      return;
    }
    std::strncpy(to.sun_path, path, sizeof to.sun_path - 1);
    socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket_ >= 0 && ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
      disconnect();
    }
  }
  void disconnect() {
    if (socket_ >= 0) {
      ::close(socket_);
    }
    socket_ = -1;
    mode_ = 'c';
    breakpoints_.clear();
  }

  // Reports where the program is halted, waits until it is resumed, and receives up to which point.
  void ask(char kind, std::uint32_t number, std::string_view why);
  void append_frames(std::string& out) const;
  [[nodiscard]] std::size_t depth() const;

  static void append(std::string& out, const void* value, std::size_t size) {
    out.append(static_cast<const char*>(value), size);
  }
  static void append_number(std::string& out, std::uint32_t number) { append(out, &number, sizeof number); }
  static void append_text(std::string& out, std::string_view text) {
    append_number(out, static_cast<std::uint32_t>(text.size()));
    out += text;
  }
  bool send(const std::string& bytes) const {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) {
        return false;
      }
      sent += static_cast<std::size_t>(count);
    }
    return true;
  }
  bool receive(void* to, std::size_t size) const {
    return size == 0 || ::recv(socket_, to, size, MSG_WAITALL) == static_cast<ssize_t>(size);
  }

  const char* module_;
  std::uint64_t mark_;
  int socket_ = -1;
  bool tried_ = false;
  char mode_ = 'c';  // 'c': to the next breakpoint; 'i': to the next statement; 'o': to the next one not inside a call
  std::size_t limit_ = 0;
  std::vector<std::uint32_t> breakpoints_;  // sorted
  std::uint32_t last_ = 0;
  std::int64_t time_ns_ = 0;
  std::size_t bytes_ = 0;
  void (*show_)(Watch&) = nullptr;
  DebugFrame* top_ = nullptr;
  std::string thrown_;  // frames unwound by a fault
  std::uint32_t thrown_count_ = 0;
};

// Makes the variables of a body visible while it runs.
class DebugFrame {
 public:
  template <class Show>
  DebugFrame(Debugger& debugger, std::uint32_t number, std::size_t bytes, const Show& show) noexcept
      : debugger_(debugger),
        below_(debugger.top_),
        number_(number),
        bytes_(bytes),
        show_(&show),
        call_([](const void* what, Watch& out) { (*static_cast<const Show*>(what))(out); }),
        exceptions_(std::uncaught_exceptions()) {
    debugger.top_ = this;
  }
  DebugFrame(const DebugFrame&) = delete;
  DebugFrame& operator=(const DebugFrame&) = delete;
  ~DebugFrame() {
    if (std::uncaught_exceptions() > exceptions_) {
      debugger_.thrown_count_ = debugger_.thrown_.empty() ? 1 : debugger_.thrown_count_ + 1;
      append(debugger_.thrown_);
    }
    debugger_.top_ = below_;
  }

 private:
  friend class Debugger;

  void append(std::string& out) const {
    std::vector<std::uint8_t> bytes(bytes_);
    Watch watch(bytes.data());
    call_(show_, watch);
    Debugger::append_number(out, number_);
    Debugger::append_text(out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  Debugger& debugger_;
  DebugFrame* below_;
  std::uint32_t number_;
  std::size_t bytes_;
  const void* show_;
  void (*call_)(const void*, Watch&);
  int exceptions_;
};

inline std::size_t Debugger::depth() const {
  std::size_t count = 0;
  for (const DebugFrame* one = top_; one != nullptr; one = one->below_) {
    ++count;
  }
  return count;
}

// Writes the innermost frame first.
inline void Debugger::append_frames(std::string& out) const {
  if (!thrown_.empty()) {
    append_number(out, thrown_count_);
    out += thrown_;
    return;
  }
  append_number(out, static_cast<std::uint32_t>(depth()));
  for (const DebugFrame* one = top_; one != nullptr; one = one->below_) {
    one->append(out);
  }
}

inline void Debugger::ask(char kind, std::uint32_t number, std::string_view why) {
  if (socket_ < 0) {
    return;
  }
  std::string text(1, kind);
  append(text, &time_ns_, sizeof time_ns_);
  append(text, &mark_, sizeof mark_);
  append_number(text, number);
  append_text(text, module_);
  append_text(text, why);
  append_frames(text);
  std::vector<std::uint8_t> globals(bytes_);
  Watch watch(globals.data());
  show_(watch);
  append_text(text, {reinterpret_cast<const char*>(globals.data()), globals.size()});
  std::string message;
  append_text(message, text);
  std::uint32_t count = 0;
  char mode = 'c';
  if (!send(message) || !receive(&mode, 1) || !receive(&count, sizeof count)) {
    disconnect();
    return;
  }
  breakpoints_.resize(count);
  if (!receive(breakpoints_.data(), count * sizeof(std::uint32_t))) {
    disconnect();
    return;
  }
  // 'o': step over calls, 'u': up to the caller.
  mode_ = mode == 'u' ? 'o' : mode;
  const std::size_t now = depth();
  limit_ = mode == 'u' ? now - std::min<std::size_t>(now, 1) : now;
}

}  // namespace indurop::iec
