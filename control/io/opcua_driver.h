// SPDX-License-Identifier: Apache-2.0
// The points of an OPC UA server. `indurop-opcua --client` speaks OPC UA; this driver asks it through a socket of this
// machine, once in each cycle: what it writes to the server, and what it has read from it. Both are lines of JSON
// (doors/opcua/src/client/protocol.ts).

#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "control/io/driver.h"

namespace indurop::io {

class OpcuaDriver final : public Driver {
 public:
  OpcuaDriver(const config::IoDevice& device, std::span<const config::IoPoint> outputs,
              std::span<const config::IoPoint> inputs);
  OpcuaDriver(const OpcuaDriver&) = delete;
  OpcuaDriver& operator=(const OpcuaDriver&) = delete;
  ~OpcuaDriver() override;

  [[nodiscard]] bool in_tick() const noexcept override { return false; }
  // Returns true as soon as the program has a session. It takes as long as the server likes, so the next call waits for
  // it on the same connection.
  bool open() override;
  Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) override;
  void close() noexcept override;
  [[nodiscard]] std::string problem() const override { return problem_; }

  // Of the program if it is not named: in the folder of the user's session, else of the system's services.
  static std::string default_socket();

 private:
  bool reach();
  [[nodiscard]] std::string description() const;
  [[nodiscard]] std::string request(std::span<const Sample> outputs) const;
  bool send(const std::string& line);
  // The next line of the program; nothing if there is none within the time-out of the device.
  std::optional<std::string> receive();
  Outcome take(const std::string& line, std::span<Sample> outputs, std::span<Sample> inputs);

  config::IoDevice device_;
  std::vector<std::string> outputs_;  // NodeIds
  std::vector<std::string> inputs_;
  std::string path_;
  int socket_ = -1;
  std::string received_;
  std::string problem_;
};

}  // namespace indurop::io
