// SPDX-License-Identifier: Apache-2.0
// The server role of Modbus TCP: an operator panel reads and writes the node's variables. Answers the requests received
// since the last exchange and never waits for a client. A value that a client wrote is good as long as that client is
// connected and sends requests.

#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/io/driver.h"
#include "control/io/modbus_places.h"

typedef struct _modbus modbus_t;  // NOLINT: libmodbus's own name

namespace indurop::io {

class ModbusServer final : public Driver {
 public:
  static constexpr std::size_t kMaxClients = 32;

  ModbusServer(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
               std::span<const config::IoPoint> inputs);
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;
  ~ModbusServer() override;

  [[nodiscard]] bool in_tick() const noexcept override { return false; }
  bool open() override;
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  void close() noexcept override;
  [[nodiscard]] std::string problem() const override { return problem_; }

 private:
  static constexpr std::size_t kMaxBytes = 260;  // of a request

  struct Client {
    std::uint64_t number = 0;
    int socket = -1;
    std::string address;
    std::chrono::nanoseconds silent{0};
    bool asked = false;
    std::array<std::uint8_t, kMaxBytes> bytes{};
    std::size_t size = 0;
  };
  struct Free {
    void operator()(modbus_t* context) const noexcept;
  };

  void accept_clients();
  bool make_room();  // false: no space for another client
  // Returns false if the client must be dropped.
  bool serve(Client& client, std::span<Sample> inputs);
  bool answer(Client& client, std::span<const std::uint8_t> frame, std::span<Sample> inputs);
  void drop(std::size_t place) noexcept;
  bool judge(std::span<Sample> inputs);

  config::IoDevice device_;
  std::vector<std::string> names_;  // of inputs
  ModbusPlaces places_;
  std::unique_ptr<modbus_t, Free> context_;
  int listener_ = -1;
  std::vector<Client> clients_;
  std::vector<std::uint64_t> writers_;  // of inputs: number of the client that wrote it, 0: none yet
  std::uint64_t last_number_ = 0;
  std::string problem_;
};

}  // namespace indurop::io
