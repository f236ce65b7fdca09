// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/debug_link.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstring>

namespace indurop::tools {
namespace {

constexpr std::uint32_t kLongest = 256U << 20U;  // maximum size of a message

bool receive(int socket, void* to, std::size_t size) {
  return size == 0 || ::recv(socket, to, size, MSG_WAITALL) == static_cast<ssize_t>(size);
}

// Reads the parts of a message one after the other.
class ReplyParts {
 public:
  explicit ReplyParts(const std::string& text) : rest_(text) {}
  template <class T>
  T take() {
    T value{};
    if (rest_.size() < sizeof value) {
      good_ = false;
      return value;
    }
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }
  std::string_view text() {
    const auto size = take<std::uint32_t>();
    if (rest_.size() < size) {
      good_ = false;
      return {};
    }
    const std::string_view part = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return part;
  }
  std::vector<std::uint8_t> bytes() {
    const std::string_view part = text();
    return {part.begin(), part.end()};
  }
  [[nodiscard]] bool good() const noexcept { return good_; }

 private:
  std::string_view rest_;
  bool good_ = true;
};

std::optional<DebugStop> stop_of(const std::string& text) {
  ReplyParts parts(text);
  DebugStop stop;
  const char kind = parts.take<char>();
  stop.kind = kind == 'B' ? DebugStop::Kind::Begin : kind == 'S' ? DebugStop::Kind::Line : DebugStop::Kind::Fault;
  stop.time_ns = parts.take<std::int64_t>();
  stop.mark = parts.take<std::uint64_t>();
  stop.line = parts.take<std::uint32_t>();
  stop.module = parts.text();
  stop.why = parts.text();
  for (auto left = parts.take<std::uint32_t>(); left > 0 && parts.good(); --left) {
    DebugStop::Frame& frame = stop.frames.emplace_back();
    frame.number = parts.take<std::uint32_t>();
    frame.values = parts.bytes();
  }
  stop.globals = parts.bytes();
  return parts.good() ? std::optional(std::move(stop)) : std::nullopt;
}

}  // namespace

DebugLink::DebugLink(const std::filesystem::path& path) {
  sockaddr_un at{};
  at.sun_family = AF_UNIX;
  const std::string name = path.string();
  if (name.size() >= sizeof at.sun_path) {
    return;
  }
  std::copy(name.begin(), name.end(), at.sun_path);
  base::Descriptor made(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  constexpr int kWaiting = 64;
  if (made.get() >= 0 && ::bind(made.get(), reinterpret_cast<const sockaddr*>(&at), sizeof at) == 0 &&
      ::listen(made.get(), kWaiting) == 0) {
    listener_ = std::move(made);
  }
}

std::optional<DebugStop> DebugLink::wait(int milliseconds) {
  std::vector<pollfd> files{{listener_.get(), POLLIN, 0}};
  for (const base::Descriptor& one : modules_) {
    files.push_back({one.get(), POLLIN, 0});
  }
  if (::poll(files.data(), files.size(), milliseconds) <= 0) {
    return std::nullopt;
  }
  for (std::size_t i = 1; i < files.size(); ++i) {
    if (files[i].revents != 0) {
      return read(i - 1);
    }
  }
  base::Descriptor module(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  if (module.get() >= 0) {
    modules_.push_back(std::move(module));
  }
  return std::nullopt;
}

std::optional<DebugStop> DebugLink::read(std::size_t which) {
  std::uint32_t size = 0;
  std::string text;
  std::optional<DebugStop> stop;
  if (receive(modules_[which].get(), &size, sizeof size) && size <= kLongest) {
    text.resize(size);
    stop = receive(modules_[which].get(), text.data(), size) ? stop_of(text) : std::nullopt;
  }
  if (!stop) {  // it has ended
    modules_.erase(modules_.begin() + static_cast<std::ptrdiff_t>(which));
    return std::nullopt;
  }
  last_ = which;
  return stop;
}

void DebugLink::answer(DebugMode mode, const std::vector<std::uint32_t>& breakpoints) {
  std::string text(1, static_cast<char>(mode));
  const auto count = static_cast<std::uint32_t>(breakpoints.size());
  text.append(reinterpret_cast<const char*>(&count), sizeof count);
  text.append(reinterpret_cast<const char*>(breakpoints.data()), breakpoints.size() * sizeof(std::uint32_t));
  if (last_ < modules_.size()) {
    (void)::send(modules_[last_].get(), text.data(), text.size(), MSG_NOSIGNAL);
  }
}

void DebugLink::close() {
  modules_.clear();
  listener_ = base::Descriptor();
}

}  // namespace indurop::tools
