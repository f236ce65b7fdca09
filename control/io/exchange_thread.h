// SPDX-License-Identifier: Apache-2.0
// Exchanges with one device that may block, in its own normal thread, so that a hanging device delays neither the tick
// nor another device: opens the device, reopens it after increasing pauses, and reports changes.

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "control/io/device_image.h"
#include "control/io/driver.h"
#include "control/io/triple_buffer.h"
#include "core/rt/thread.h"

namespace indurop::io {

class ExchangeThread {
 public:
  // Borrows `device` and `driver`. Nothing runs before start().
  ExchangeThread(const config::IoDevice& device, Driver& driver, DeviceImage image);
  ExchangeThread(const ExchangeThread&) = delete;
  ExchangeThread& operator=(const ExchangeThread&) = delete;
  ~ExchangeThread();

  // Not real-time safe. Messages are those of module `module`. Errors: NoSpace, System.
  Status start(std::uint32_t module);
  // Sends the stop values and closes the device. Waits for the exchange in progress. Not real-time safe.
  void stop();

  // Functions for the tick, real-time safe. Fill next_outputs() completely before send().
  [[nodiscard]] OutputImage& next_outputs() noexcept { return outputs_.back(); }
  void send() noexcept { outputs_.publish(); }
  [[nodiscard]] const InputImage& receive() noexcept {
    inputs_.update();
    return inputs_.front();
  }

 private:
  using Clock = std::chrono::steady_clock;
  void work();
  void open(Clock::time_point now);
  void exchange(Clock::time_point now);
  void hand_over();
  DeviceImage::Outputs check_outputs(Clock::time_point now);
  void report(Quality now, Clock::time_point when);
  bool wait_until(Clock::time_point when);

  const config::IoDevice& device_;
  Driver& driver_;
  DeviceImage image_;
  TripleBuffer<OutputImage> outputs_;
  TripleBuffer<InputImage> inputs_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;  // guarded by the mutex
  bool is_open_ = false;
  bool had_outputs_ = false;
  bool holding_ = false;
  Clock::time_point began_;
  Clock::time_point last_outputs_;
  Clock::time_point last_exchange_;
  Clock::time_point bad_since_;
  Clock::duration pause_{};
  Quality reported_ = Quality::None;
  std::uint64_t errors_when_good_ = 0;
  rt::Thread thread_;
};

}  // namespace indurop::io
