// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/serve/connection.h"

#include <fmt/format.h>
#include <netdb.h>
#include <openssl/err.h>
#include <openssl/x509v3.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace indurop::mqtt {
namespace {

constexpr int kPatienceMs = 5000;
constexpr std::size_t kReadBytes = 16384;

bool is_ready(int socket, short events, int wait_ms) {
  pollfd one{socket, events, 0};
  return ::poll(&one, 1, wait_ms) > 0;
}

std::string reason_of(int error) {
  return std::error_code(error, std::generic_category()).message();
}

base::Problem no_answer(const Address& address, const std::string& why) {
  return {fmt::format("{} cannot be reached: {}", address.host_and_port(), why)};
}

// Returns a connected socket that does not block, or an errno.
Result<base::Descriptor, base::Problem> connect_to(const addrinfo& one, const Address& address) {
  base::Descriptor socket(::socket(one.ai_family, one.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, one.ai_protocol));
  if (!socket.is_open()) {
    return no_answer(address, reason_of(errno));
  }
  if (::connect(socket.get(), one.ai_addr, one.ai_addrlen) == 0) {
    return socket;
  }
  if (errno != EINPROGRESS) {
    return no_answer(address, reason_of(errno));
  }
  if (!is_ready(socket.get(), POLLOUT, kPatienceMs)) {
    return no_answer(address, "no answer in time");
  }
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0) {
    return no_answer(address, reason_of(error));
  }
  return socket;
}

Result<base::Descriptor, base::Problem> connect_to(const Address& address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(address.port);
  if (const int code = ::getaddrinfo(address.host.c_str(), port.c_str(), &hints, &found); code != 0) {
    return no_answer(address, ::gai_strerror(code));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(found, &::freeaddrinfo);
  Result<base::Descriptor, base::Problem> last = no_answer(address, "it has no address");
  for (const addrinfo* one = all.get(); one != nullptr; one = one->ai_next) {
    last = connect_to(*one, address);
    if (last) {
      break;
    }
  }
  return last;
}

// The certificate must be for this host.
bool expect_host(SSL* tls, const std::string& host) {
  if (X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(tls), host.c_str()) == 1) {
    return true;
  }
  std::string name = host;  // the interface of OpenSSL is without const
  return SSL_set1_host(tls, host.c_str()) == 1 &&
         SSL_ctrl(tls, SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name, name.data()) == 1;
}

std::string tls_reason(SSL* tls) {
  if (const long verified = SSL_get_verify_result(tls); verified != X509_V_OK) {
    return X509_verify_cert_error_string(verified);
  }
  const unsigned long error = ERR_peek_last_error();
  const char* const text = error != 0 ? ERR_reason_error_string(error) : nullptr;
  return text != nullptr ? text : "the handshake failed";
}

// Returns true while a call of TLS has to be repeated once the socket is ready for `events`.
bool wants_more(SSL* tls, int result, short& events) {
  const int error = SSL_get_error(tls, result);
  events = error == SSL_ERROR_WANT_WRITE ? POLLOUT : POLLIN;
  return error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE;
}

}  // namespace

Result<Connection, base::Problem> Connection::open(const Address& address, const std::filesystem::path& ca) {
  auto socket = connect_to(address);
  if (!socket) {
    return std::move(socket).error();
  }
  if (!address.tls) {
    return Connection(std::move(*socket), nullptr);
  }
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
  SSL_CTX_set_mode(context.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  const int known = ca.empty() ? SSL_CTX_set_default_verify_paths(context.get())
                               : SSL_CTX_load_verify_locations(context.get(), ca.c_str(), nullptr);
  if (known != 1) {
    ERR_clear_error();
    return base::Problem{fmt::format("{} cannot be read, or holds no certificate", ca.string())};
  }
  std::unique_ptr<SSL, FreeSsl> tls(SSL_new(context.get()));
  SSL_set_fd(tls.get(), socket->get());
  if (!expect_host(tls.get(), address.host)) {
    return no_answer(address, "its name cannot be compared with a certificate");
  }
  for (int result = SSL_connect(tls.get()); result != 1; result = SSL_connect(tls.get())) {
    short events = 0;
    if (!wants_more(tls.get(), result, events) || !is_ready(socket->get(), events, kPatienceMs)) {
      const std::string why = tls_reason(tls.get());
      ERR_clear_error();
      return no_answer(address, why);
    }
  }
  return Connection(std::move(*socket), std::move(tls));
}

long Connection::read_some(char* to, std::size_t most, short& events) {
  events = POLLIN;
  if (tls_ == nullptr) {
    const ssize_t size = ::recv(socket_.get(), to, most, 0);
    const bool later = size < 0 && (errno == EAGAIN || errno == EINTR);
    return later ? 0 : size > 0 ? size : -1;
  }
  ERR_clear_error();
  const int size = SSL_read(tls_.get(), to, static_cast<int>(most));
  return size > 0 ? size : wants_more(tls_.get(), size, events) ? 0 : -1;
}

long Connection::write_some(std::string_view bytes, short& events) {
  events = POLLOUT;
  if (tls_ == nullptr) {
    const ssize_t size = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return size < 0 && (errno == EAGAIN || errno == EINTR) ? 0 : size;
  }
  ERR_clear_error();
  const int size = SSL_write(tls_.get(), bytes.data(), static_cast<int>(bytes.size()));
  return size > 0 ? size : wants_more(tls_.get(), size, events) ? 0 : -1;
}

Result<void, base::Problem> Connection::send(std::string_view bytes) {
  while (!bytes.empty()) {
    short events = 0;
    const long size = write_some(bytes, events);
    if (size < 0 || (size == 0 && !is_ready(socket_.get(), events, kPatienceMs))) {
      return base::Problem{"the connection was lost"};
    }
    bytes.remove_prefix(static_cast<std::size_t>(size));
  }
  return {};
}

Result<void, base::Problem> Connection::receive(std::string& to, std::chrono::milliseconds wait) {
  std::string buffer(kReadBytes, '\0');
  bool any = false;
  for (;;) {
    short events = 0;
    const long size = read_some(buffer.data(), buffer.size(), events);
    if (size < 0) {
      return any ? Result<void, base::Problem>() : base::Problem{"the server closed the connection"};
    }
    if (size > 0) {
      to.append(buffer.data(), static_cast<std::size_t>(size));
      any = true;
      continue;  // TLS may have more that the socket does not show
    }
    if (any || !is_ready(socket_.get(), events, static_cast<int>(wait.count()))) {
      return {};
    }
    any = events == POLLOUT;
  }
}

Result<void, base::Problem> try_to_reach(const Address& address) {
  auto socket = connect_to(address);
  return socket ? Result<void, base::Problem>() : Result<void, base::Problem>(std::move(socket).error());
}

}  // namespace indurop::mqtt
