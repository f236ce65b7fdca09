// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/door/listener.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

namespace indurop::serve {
namespace {

// Bytes of a stream that the kernel buffers for a client that does not read: a few frames, not megabytes of old ones.
constexpr int kSendBytes = 128 << 10;

struct FreeAddresses {
  void operator()(addrinfo* list) const noexcept { freeaddrinfo(list); }
};

std::string cannot(const std::string& address, int port, const char* why) {
  return fmt::format("cannot listen on {} port {}: {}", address, port, why);
}

int port_of(int file) {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  std::array<char, NI_MAXSERV> text{};
  int port = 0;
  auto* const address = reinterpret_cast<sockaddr*>(&bound);
  if (getsockname(file, address, &size) == 0 &&
      getnameinfo(address, size, nullptr, 0, text.data(), text.size(), NI_NUMERICSERV) == 0) {
    std::from_chars(text.data(), text.data() + std::strlen(text.data()), port);
  }
  return port;
}

}  // namespace

Result<Listener, base::Problem> Listener::open(const std::string& address, int port) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV | (address == "localhost" ? 0 : AI_NUMERICHOST);
  addrinfo* found = nullptr;
  if (getaddrinfo(address.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) {
    return base::Problem{cannot(address, port, "that is no address; give one as numbers, like 192.168.0.5")};
  }
  const std::unique_ptr<addrinfo, FreeAddresses> list(found);
  base::Descriptor file(socket(list->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;
  setsockopt(file.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  setsockopt(file.get(), SOL_SOCKET, SO_SNDBUF, &kSendBytes, sizeof kSendBytes);  // connections inherit it
  if (list->ai_family == AF_INET6) {
    setsockopt(file.get(), IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof on);
  }
  if (!file.is_open() || bind(file.get(), list->ai_addr, list->ai_addrlen) != 0 || listen(file.get(), SOMAXCONN) != 0) {
    const std::string why =
        errno == EADDRINUSE ? "the port is taken; choose another with --port" : std::strerror(errno);
    return base::Problem{cannot(address, port, why.c_str())};
  }
  const int bound = port_of(file.get());
  return Listener(std::move(file), bound);
}

Result<Listener::Taken, Error> Listener::take() const {
  sockaddr_storage peer{};
  socklen_t size = sizeof peer;
  auto* const address = reinterpret_cast<sockaddr*>(&peer);
  Taken taken{base::Descriptor(accept4(file_.get(), address, &size, SOCK_CLOEXEC | SOCK_NONBLOCK)), {}, false};
  if (!taken.file.is_open()) {
    const bool none = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ECONNABORTED;
    return Error{none ? Errc::NotFound : Errc::System, none ? 0 : errno, "accept"};
  }
  const int on = 1;
  setsockopt(taken.file.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  std::array<char, NI_MAXHOST> text{};
  if (getnameinfo(address, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0) {
    taken.address = text.data();
  }
  taken.loopback = taken.address == "::1" || taken.address.starts_with("127.");
  return taken;
}

}  // namespace indurop::serve
