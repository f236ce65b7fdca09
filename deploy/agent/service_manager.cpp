// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/service_manager.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "core/base/descriptor.h"

namespace indurop::deploy {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// systemd expects two signs of life within the watchdog time.
std::chrono::nanoseconds half_of_watchdog() {
  const std::string text = variable("WATCHDOG_USEC");
  const std::string pid = variable("WATCHDOG_PID");
  std::int64_t us = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), us);
  const bool whole = error == std::errc() && end == text.data() + text.size() && us > 0;
  const bool ours = pid.empty() || pid == std::to_string(::getpid());
  return whole && ours ? std::chrono::microseconds(us) / 2 : std::chrono::nanoseconds{};
}

}  // namespace

ServiceManager::ServiceManager() : socket_(variable("NOTIFY_SOCKET")), every_(half_of_watchdog()) {}

void ServiceManager::alive(rt::MonoTime now) {
  if (every_.count() > 0 && now - notified_ >= every_ / 2) {
    notified_ = now;
    notify("WATCHDOG=1");
  }
}

void ServiceManager::notify(const std::string& state) const {
  sockaddr_un address{};
  if (socket_.empty() || socket_.size() >= sizeof address.sun_path) {
    return;
  }
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (socket_.front() == '@') {
    address.sun_path[0] = '\0';  // an abstract socket name
  }
  const base::Descriptor file(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  (void)::sendto(file.get(), state.data(), state.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address),
                 length);
}

}  // namespace indurop::deploy
