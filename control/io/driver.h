// SPDX-License-Identifier: Apache-2.0
// Interface of I/O dispatch to one kind of field device. A driver knows its device and numbers; it knows nothing of
// shared variables, scaling, threads or XML. docs/io.md shows how to add another fieldbus.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/model/io_config.h"
#include "control/io/ethercat_wires.h"
#include "control/io/sample.h"
#include "core/base/diagnostic.h"

namespace indurop::io {

inline constexpr std::size_t kThreadStackBytes = std::size_t{256} * 1024;  // of a thread that serves devices

class Driver {
 public:
  Driver() = default;
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  virtual ~Driver() = default;

  // Returns true if exchange() is real-time safe and depends on its arguments alone; the tick itself then calls it. An
  // FMU need not be real-time safe: it is for virtual time only.
  // false: it may wait for a device and is called by a thread of the device's own.
  [[nodiscard]] virtual bool in_tick() const noexcept = 0;

  // Makes the device ready: opens the port, connects. Returns false if that fails: problem() returns the reason, and
  // open() is called again later; of a driver in the tick it is called once, before the first tick, and has to succeed.
  virtual bool open() = 0;

  // Sends the outputs and reads the inputs, in the order of the points of their direction. `elapsed` is the time since
  // the last exchange, as the schedule counts it. Outputs whose quality is not Good must not be sent. The driver sets
  // the quality of each input and of each output it had to send, and does not change the value of an input that is not
  // Good. After Lost, close() and open() are called next. After Failed, which only a driver in the tick returns,
  // nothing but close() is called: the module cannot go on. May throw what a model throws.
  enum class Outcome { Good, Partly, Lost, Failed };  // unless Good, problem() returns the reason
  virtual Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) = 0;

  // Points that are texts are not among the points of exchange(). Call it before open(). Such a driver returns their
  // texts, in this order: those of outputs are set before exchange(), those of inputs read after it.
  virtual void add_texts(std::span<const config::IoPoint> /*points*/) {}
  [[nodiscard]] virtual std::span<std::string> texts() noexcept { return {}; }

  // The cable of a ring that is cut: 1 is that from the first interface to the first slave. 0: none is, or the device
  // is not on a ring. Real-time safe.
  [[nodiscard]] virtual std::uint32_t cut() const noexcept { return 0; }

  // Broken frames and lost links that the device has counted at its plugs. Real-time safe.
  [[nodiscard]] virtual std::uint64_t cable_errors() const noexcept { return 0; }

  virtual void close() noexcept = 0;

  [[nodiscard]] virtual std::string problem() const = 0;
};

class EthercatBus;
// The EtherCAT buses of a module: devices with the same address share one.
struct EthercatBuses {
  EthercatWires wires;
  std::map<std::string, std::shared_ptr<EthercatBus>> by_address;
};

// Makes the driver for a device with these points. Errors: why the configuration cannot work, for example a missing
// file. Not real-time safe.
Result<std::unique_ptr<Driver>, std::vector<base::Diagnostic>> make_driver(const config::IoDevice& device,
                                                                           std::span<const config::IoPoint> outputs,
                                                                           std::span<const config::IoPoint> inputs,
                                                                           EthercatBuses& buses);

}  // namespace indurop::io
