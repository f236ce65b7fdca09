// SPDX-License-Identifier: Apache-2.0
// What I/O dispatch asks of a kind of field device. A driver knows its device and numbers; it knows nothing of shared
// variables, scaling, threads or XML. docs/io.md shows how another fieldbus plugs in here.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "config/model/io_config.h"
#include "io/sample.h"

namespace indurop::io {

class Driver {
 public:
  Driver() = default;
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  virtual ~Driver() = default;

  // True: exchange() is real-time safe, its result depends on its arguments alone, and the tick itself calls it.
  // False: it may wait for a device; a thread of the device's own calls it.
  [[nodiscard]] virtual bool in_tick() const noexcept = 0;

  // Makes the device ready: opens the port, connects. False: problem() says why; it is called again later.
  virtual bool open() = 0;

  // Sends the outputs and fetches the inputs, in the order of the points of their direction. `elapsed` is the time
  // since the exchange before, as the schedule counts it. An output whose quality is not Good is not to be sent. The
  // driver sets the quality of each input and of each output it was to send, and leaves the value of an input that is
  // not Good as it is. After Lost, close() and open() come next.
  enum class Outcome { Good, Partly, Lost };  // unless Good, problem() says why
  virtual Outcome exchange(std::span<Sample> outputs, std::span<Sample> inputs, std::chrono::nanoseconds elapsed) = 0;

  virtual void close() noexcept = 0;

  [[nodiscard]] virtual std::string problem() const = 0;
};

// The driver for a device with these points. Errors: why the configuration cannot work, a file that is not there for
// example. Not real-time safe.
Result<std::unique_ptr<Driver>, std::vector<base::Diagnostic>> make_driver(const config::IoDevice& device,
                                                                           std::span<const config::IoPoint> outputs,
                                                                           std::span<const config::IoPoint> inputs);

}  // namespace indurop::io
