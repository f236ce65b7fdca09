// SPDX-License-Identifier: Apache-2.0
#include "control/io/modbus_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <tuple>
#include <utility>

#include <modbus/modbus.h>

#include "control/io/modbus_frame.h"

namespace indurop::io {
namespace {

using config::IoPoint;

constexpr int kBacklog = 32;
constexpr std::size_t kRequestHeader = 6;  // transaction, protocol, length of the rest
constexpr std::size_t kUnitAt = 6;
constexpr std::size_t kLeast = 8;      // header, unit, function
constexpr unsigned kAnyUnit = 0xFF;    // "MODBUS messaging on TCP/IP" 4.4.1.2: of a device without a serial line
constexpr std::size_t kRequests = 64;  // of one client in one exchange: no client delays the others

std::string address_of(const sockaddr_storage& peer, socklen_t size) {
  std::array<char, NI_MAXHOST> host{};
  const auto* address = reinterpret_cast<const sockaddr*>(&peer);  // NOLINT: what the socket interface asks for
  const int error = ::getnameinfo(address, size, host.data(), host.size(), nullptr, 0, NI_NUMERICHOST);
  return error == 0 ? host.data() : "of unknown address";
}

}  // namespace

void ModbusServer::Free::operator()(modbus_t* context) const noexcept {
  modbus_free(context);
}

ModbusServer::ModbusServer(const config::IoDevice& device, std::span<const IoPoint> outputs,
                           std::span<const IoPoint> inputs)
    : device_(device), places_(outputs, inputs), writers_(inputs.size()) {
  for (const IoPoint& point : inputs) {
    names_.push_back(point.variable);
  }
}

ModbusServer::~ModbusServer() {
  close();
}

bool ModbusServer::open() {
  close();
  const std::string port = std::to_string(device_.port);
  context_.reset(modbus_new_tcp_pi(device_.address.c_str(), port.c_str()));
  listener_ = context_ == nullptr ? -1 : modbus_tcp_pi_listen(context_.get(), kBacklog);
  if (listener_ < 0 || ::fcntl(listener_, F_SETFL, O_NONBLOCK) != 0) {
    const std::string reason = errno != 0 ? modbus_strerror(errno) : "this board has no such address";
    problem_ = fmt::format("cannot listen at {} port {}: {}; trying again", device_.address, port, reason);
    close();
    return false;
  }
  // modbus_reply waits this long before it refuses some requests; ours were checked before.
  modbus_set_response_timeout(context_.get(), 0, 1);
  return true;
}

void ModbusServer::close() noexcept {
  while (!clients_.empty()) {
    drop(clients_.size() - 1);
  }
  if (listener_ >= 0) {
    ::close(std::exchange(listener_, -1));
  }
  context_.reset();
}

void ModbusServer::drop(std::size_t place) noexcept {
  ::close(clients_[place].socket);
  clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(place));
}

// Clients that never sent a request or left silently must not block others; new clients must not displace an active
// one.
bool ModbusServer::make_room() {
  if (clients_.size() < kMaxClients) {
    return true;
  }
  const auto order = [](const Client& a, const Client& b) {
    return std::tuple(!a.asked, a.silent) < std::tuple(!b.asked, b.silent);
  };
  const auto least = std::max_element(clients_.begin(), clients_.end(), order);
  if (least->asked && least->silent < device_.timeout) {
    return false;
  }
  drop(static_cast<std::size_t>(least - clients_.begin()));
  return true;
}

void ModbusServer::accept_clients() {
  for (std::size_t i = 0; i < kMaxClients; ++i) {
    sockaddr_storage peer{};
    socklen_t size = sizeof peer;
    auto* address = reinterpret_cast<sockaddr*>(&peer);  // NOLINT: what the socket interface asks for
    const int socket = ::accept4(listener_, address, &size, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (socket < 0) {
      return;
    }
    if (!make_room()) {
      ::close(socket);
      return;
    }
    Client& client = clients_.emplace_back();
    client.number = ++last_number_;
    client.socket = socket;
    client.address = address_of(peer, size);
  }
}

bool ModbusServer::answer(Client& client, std::span<const std::uint8_t> frame, std::span<Sample> inputs) {
  modbus_set_socket(context_.get(), client.socket);
  const auto request = frame.subspan(kUnitAt + 1);
  const unsigned unit = frame[kUnitAt];
  const bool ours = unit == static_cast<unsigned>(device_.unit) || unit == kAnyUnit || unit == 0;
  const int refusal = ours ? places_.refusal(request) : MODBUS_EXCEPTION_GATEWAY_TARGET;
  if (refusal != 0) {
    return modbus_reply_exception(context_.get(), frame.data(), static_cast<unsigned>(refusal)) > 0;
  }
  if (modbus_reply(context_.get(), frame.data(), static_cast<int>(frame.size()), &places_.table()) <= 0) {
    return false;
  }
  for (const std::size_t i : places_.take(request, inputs)) {
    inputs[i].quality = Quality::Good;
    writers_[i] = client.number;
  }
  return true;
}

bool ModbusServer::serve(Client& client, std::span<Sample> inputs) {
  for (std::size_t done = 0; done < kRequests;) {
    const std::size_t whole = client.size < kRequestHeader
                                  ? kLeast
                                  : kRequestHeader +
                                        (static_cast<std::size_t>(client.bytes[kRequestHeader - 2]) << kBitsPerByte) +
                                        client.bytes[kRequestHeader - 1];
    if (whole < kLeast || whole > kMaxBytes || (client.size > 3 && (client.bytes[2] | client.bytes[3]) != 0)) {
      return false;  // not Modbus
    }
    if (client.size >= kRequestHeader && client.size >= whole) {
      client.silent = {};
      client.asked = true;
      if (!answer(client, std::span(client.bytes).first(whole), inputs)) {
        return false;
      }
      std::copy(client.bytes.begin() + static_cast<std::ptrdiff_t>(whole),
                client.bytes.begin() + static_cast<std::ptrdiff_t>(client.size), client.bytes.begin());
      client.size -= whole;
      ++done;
      continue;
    }
    const ssize_t got = ::recv(client.socket, &client.bytes.at(client.size), kMaxBytes - client.size, 0);
    if (got <= 0) {
      return got < 0 && (errno == EAGAIN || errno == EINTR);
    }
    client.size += static_cast<std::size_t>(got);
  }
  return true;
}

// Returns true if the clients of all written inputs are still active.
bool ModbusServer::judge(std::span<Sample> inputs) {
  bool good = true;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (writers_[i] == 0) {
      continue;
    }
    const auto writer = std::find_if(clients_.begin(), clients_.end(),
                                     [&](const Client& client) { return client.number == writers_[i]; });
    const bool gone = writer == clients_.end();
    if (!gone && writer->silent < device_.timeout) {
      inputs[i].quality = Quality::Good;
      continue;
    }
    inputs[i].quality = Quality::Lost;
    if (good) {
      problem_ = gone ? fmt::format("the client that wrote {} has left", names_[i])
                      : fmt::format("client {} that wrote {} is silent", writer->address, names_[i]);
    }
    good = false;
  }
  return good;
}

Driver::Outcome ModbusServer::exchange(std::span<Sample> outputs, std::span<Sample> inputs,
                                       std::chrono::nanoseconds elapsed) {
  places_.offer(outputs);
  for (Client& client : clients_) {
    client.silent += elapsed;
  }
  accept_clients();
  for (std::size_t i = clients_.size(); i > 0; --i) {
    if (!serve(clients_[i - 1], inputs)) {
      drop(i - 1);
    }
  }
  return judge(inputs) ? Outcome::Good : Outcome::Partly;
}

}  // namespace indurop::io
