// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/simulated_mirror.h"

#include <functional>
#include <utility>

#include "core/rt/clock.h"

namespace indurop::node {

SimulatedMirror::SimulatedMirror(const BoardPlace& place, const vars::Store& store, scheduler::SimulatedKernel& kernel,
                                 std::unique_ptr<mirror::Exchange> exchange)
    : kernel_(kernel), plane_(place.boards, place.own, store), exchange_(std::move(exchange)) {
  for (rt::SignalWord* word : {&wake_manager_, &wake_sender_, &wake_bulk_}) {
    word->init(false);
  }
}

Result<std::unique_ptr<SimulatedMirror>> SimulatedMirror::start(mirror::Settings settings, const std::string& node,
                                                                const BoardPlace& place, vars::Store& store,
                                                                const std::atomic<std::uint64_t>& tick,
                                                                scheduler::SimulatedKernel& kernel) {
  auto exchange = mirror::Exchange::make(std::move(settings), node, store, tick);
  if (!exchange) {
    return exchange.error();
  }
  auto made = std::make_unique<SimulatedMirror>(place, store, kernel, std::move(exchange).value());
  (void)made->exchange_->open(made->plane_);
  made->exchange_->block().network.store(mirror::Network::Up);
  if (const Status started = made->start_threads(); !started) {
    return started.error();
  }
  return made;
}

SimulatedMirror::~SimulatedMirror() {
  stop_ = true;
  for (rt::SignalWord* word : {&wake_manager_, &wake_sender_, &wake_bulk_}) {
    word->wake();
  }
  for (const auto& thread : threads_) {
    thread->join();
  }
  exchange_->close();
}

Status SimulatedMirror::start_threads() {
  if (Status started = start_thread("irp-mirror-mgr", wake_manager_,
                                    [this](std::int64_t now) { return exchange_->poll(now, schedule_); });
      !started) {
    return started;
  }
  const auto send = [this](bool bulk) { return [this, bulk](std::int64_t now) { return exchange_->send(now, bulk); }; };
  if (exchange_->sends()) {
    if (Status started = start_thread("irp-mirror", wake_sender_, send(false)); !started) {
      return started;
    }
  }
  return exchange_->sends_bulk() ? start_thread("irp-mirror-bulk", wake_bulk_, send(true)) : Status{};
}

Status SimulatedMirror::start_thread(const char* name, rt::SignalWord& wake,
                                     std::function<std::int64_t(std::int64_t)> step) {
  auto thread = kernel_.start({name, 0, -1}, [this, &wake, step = std::move(step)] {
    while (!stop_) {
      const std::int64_t next = step(rt::to_ns(kernel_.now()));
      (void)kernel_.wait_until(wake, rt::mono_time(next));
    }
  });
  if (!thread) {
    return thread.error();
  }
  threads_.push_back(std::move(thread).value());
  return {};
}

void SimulatedMirror::arrived(const mirror::Message& message) {
  plane_.arrived(message, *exchange_);
  if (!message.is_frame()) {
    wake_manager_.wake();  // as a board that joins or leaves does in a network
  }
}

}  // namespace indurop::node
