// SPDX-License-Identifier: Apache-2.0
#include "control/io/exchange_thread.h"

#include <indurop/irp.h>

#include <algorithm>
#include <utility>

#include "store/runtime/host.h"

namespace indurop::io {
namespace {

constexpr std::chrono::seconds kToBegin{1};  // a device that starts together with the node may not be ready immediately

}  // namespace

ExchangeThread::ExchangeThread(const config::IoDevice& device, Driver& driver, DeviceImage image)
    : device_(device), driver_(driver), image_(std::move(image)), pause_(device.retry) {
  outputs_.fill(OutputImage(image_.current().outputs.size()));
  inputs_.fill(image_.current());
}

ExchangeThread::~ExchangeThread() {
  stop();
}

Status ExchangeThread::start(std::uint32_t module) {
  auto thread = rt::Thread::start({"irp-io", 0, -1, kThreadStackBytes}, [this, module] {
    runtime::set_current_module(module);
    work();
  });
  if (!thread) {
    return thread.error();
  }
  thread_ = std::move(thread).value();
  return {};
}

void ExchangeThread::stop() {
  if (!thread_.joinable()) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

bool ExchangeThread::wait_until(Clock::time_point when) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_until(lock, when, [this] { return stop_; });
}

void ExchangeThread::work() {
  Clock::time_point next = began_ = last_exchange_ = Clock::now();
  do {
    const Clock::time_point now = Clock::now();
    if (!is_open_) {
      open(now);
    }
    if (is_open_) {
      exchange(now);
    }
    if (is_open_) {
      // Keeps to a grid of cycles; missed cycles are not made up for.
      next = std::max(next + device_.cycle, now);
    } else {
      next = Clock::now() + pause_;
      pause_ = std::min<Clock::duration>(pause_ * 2, device_.retry_max);
    }
  } while (wait_until(next));
  if (is_open_ && image_.has_stop_values()) {
    (void)image_.exchange(driver_, outputs_.front(), DeviceImage::Outputs::Hold, {});
  }
  driver_.close();
}

void ExchangeThread::open(Clock::time_point now) {
  is_open_ = driver_.open();
  if (!is_open_) {
    image_.lose();
    hand_over();
    if (reported_ != Quality::None || now - began_ >= kToBegin) {
      report(Quality::Lost, now);
    }
  }
}

DeviceImage::Outputs ExchangeThread::check_outputs(Clock::time_point now) {
  if (outputs_.update()) {
    had_outputs_ = true;
    last_outputs_ = now;
  }
  if (!had_outputs_) {
    return DeviceImage::Outputs::Unknown;
  }
  const bool late = now - last_outputs_ > device_.watchdog;
  if (late != std::exchange(holding_, late) && !image_.current().outputs.empty()) {
    irp::printf(late ? "I/O device %s: the tick has stopped; its outputs are no longer refreshed\n"
                     : "I/O device %s: the tick runs again, and outputs are refreshed again\n",
                device_.name);
  }
  return late ? DeviceImage::Outputs::Hold : DeviceImage::Outputs::Fresh;
}

void ExchangeThread::exchange(Clock::time_point now) {
  const DeviceImage::Outputs how = check_outputs(now);
  const auto outcome = image_.exchange(driver_, outputs_.front(), how, now - std::exchange(last_exchange_, now));
  if (outcome == Driver::Outcome::Lost) {
    driver_.close();
    is_open_ = false;
  } else {
    pause_ = device_.retry;
  }
  hand_over();
  report(image_.current().device, now);
}

void ExchangeThread::hand_over() {
  inputs_.back() = image_.current();
  inputs_.publish();
}

void ExchangeThread::report(Quality now, Clock::time_point when) {
  const Quality before = std::exchange(reported_, now);
  if (now == before) {
    return;
  }
  const std::uint64_t errors = image_.current().errors;
  if (now == Quality::Good) {
    if (before == Quality::None) {
      irp::printf("I/O device %s: exchanging\n", device_.name);
    } else {
      const double seconds = std::chrono::duration<double>(when - bad_since_).count();
      irp::printf("I/O device %s: good again after %.1f s, %u failed exchanges\n", device_.name, seconds,
                  errors - errors_when_good_);
    }
    errors_when_good_ = errors;
    return;
  }
  if (before == Quality::None || before == Quality::Good) {
    bad_since_ = when;
  }
  irp::printf("I/O device %s: %s\n", device_.name, driver_.problem());
}

}  // namespace indurop::io
