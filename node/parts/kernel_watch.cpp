// SPDX-License-Identifier: Apache-2.0
#include "node/parts/kernel_watch.h"

#include <pthread.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "history/explain/kernel_log.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kKernelPoll{100};

}  // namespace

struct KernelWatch::Impl {
  explicit Impl(explain::KernelSampler sampler) : sampler_(std::move(sampler)) {}

  void loop() {
    std::unique_lock lock(mutex_);
    do {
      sampler_.sample(rt::now_ns());
    } while (!end_.wait_for(lock, kKernelPoll, [this] { return stop_; }));
    sampler_.sample(rt::now_ns());
  }

  explain::KernelSampler sampler_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool stop_ = false;
  std::thread thread_;
};

KernelWatch::KernelWatch(const std::string& node, bool realtime, std::vector<int> cores) {
  auto sampler = explain::KernelSampler::begin(node, "/proc/self", realtime);
  if (!sampler) {
    return;
  }
  impl_ = std::make_unique<Impl>(std::move(sampler).value());
  impl_->thread_ = std::thread([impl = impl_.get(), cores = std::move(cores)] {
    ::pthread_setname_np(::pthread_self(), "irp-kernel");
    (void)rt::pin_to_cores(cores);
    impl->loop();
  });
}

KernelWatch::~KernelWatch() {
  if (!impl_) {
    return;
  }
  {
    const std::lock_guard lock(impl_->mutex_);
    impl_->stop_ = true;
  }
  impl_->end_.notify_all();
  impl_->thread_.join();
}

}  // namespace indurop::node
