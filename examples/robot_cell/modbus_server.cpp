// SPDX-License-Identifier: Apache-2.0
#include "modbus_server.h"

#include <poll.h>
#include <unistd.h>

#include <cstddef>

namespace {
constexpr std::size_t kMostClients = 8;
}

ModbusServer::ModbusServer(const char* address, int port, int coils, int inputs)
    : context_(modbus_new_tcp(address, port)), map_(modbus_mapping_new(coils, inputs, 0, 0)) {}

ModbusServer::~ModbusServer() {
  for (const int client : clients_) {
    ::close(client);
  }
  if (listener_ >= 0) {
    ::close(listener_);
  }
}

bool ModbusServer::serve(int milliseconds) {
  if (listener_ < 0) {
    listener_ = modbus_tcp_listen(context_.get(), static_cast<int>(kMostClients));
    if (listener_ < 0) {
      return false;
    }
  }
  std::vector<pollfd> waiting{{listener_, POLLIN, 0}};
  for (const int client : clients_) {
    waiting.push_back({client, POLLIN, 0});
  }
  if (::poll(waiting.data(), waiting.size(), milliseconds) <= 0) {
    return true;
  }
  for (std::size_t i = waiting.size() - 1; i > 0; --i) {  // from the end: a client that leaves is taken out
    if (waiting[i].revents != 0) {
      answer(i - 1);
    }
  }
  if ((waiting[0].revents & POLLIN) != 0) {
    const int client = modbus_tcp_accept(context_.get(), &listener_);
    if (client >= 0 && clients_.size() < kMostClients) {
      clients_.push_back(client);
    } else if (client >= 0) {
      ::close(client);
    }
  }
  return true;
}

void ModbusServer::answer(std::size_t client) {
  std::uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
  modbus_set_socket(context_.get(), clients_[client]);
  const int length = modbus_receive(context_.get(), query);
  if (length > 0 && modbus_reply(context_.get(), query, length, map_.get()) >= 0) {
    ++requests_;
  } else if (length != 0) {
    ::close(clients_[client]);
    clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(client));
  }
}
