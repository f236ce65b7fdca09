// SPDX-License-Identifier: Apache-2.0
// A Modbus TCP server for a few masters, run from one loop: no call waits longer than its limit.
#pragma once

#include <modbus/modbus.h>

#include <cstdint>
#include <memory>
#include <vector>

class ModbusServer {
 public:
  ModbusServer(const char* address, int port, int coils, int inputs);
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  // Answers what comes within the time. false: the port cannot be opened; tried again with the next call.
  bool serve(int milliseconds);

  [[nodiscard]] bool coil(int number) const { return map_->tab_bits[number] != 0; }
  void set_input(int number, bool value) { map_->tab_input_bits[number] = value ? 1 : 0; }
  [[nodiscard]] std::uint32_t requests() const { return requests_; }

 private:
  void answer(std::size_t client);

  struct Free {
    void operator()(modbus_t* context) const { modbus_free(context); }
    void operator()(modbus_mapping_t* map) const { modbus_mapping_free(map); }
  };
  std::unique_ptr<modbus_t, Free> context_;
  std::unique_ptr<modbus_mapping_t, Free> map_;
  int listener_ = -1;
  std::vector<int> clients_;
  std::uint32_t requests_ = 0;
};
