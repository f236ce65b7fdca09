// SPDX-License-Identifier: Apache-2.0
#include "network/dds/log.h"

#include <dds/ddsrt/log.h>

#include <atomic>
#include <mutex>
#include <string_view>

namespace indurop::dds {
namespace {

struct Log {
  std::mutex mutex;
  std::string last;
  std::string refusal;
  std::atomic<std::uint64_t> count{0};
  std::atomic<std::uint64_t> unreadable{0};
};
Log& log() {
  static Log instance;
  return instance;
}

void sink(void* /*context*/, const dds_log_data_t* data) {
  // DDS traces are off; a stored message is one line of at most this length.
  constexpr std::size_t kLongest = 240;
  std::string_view text(data->message, data->size);
  text = text.substr(0, text.find_first_of("\r\n"));
  Log& to = log();
  to.count.fetch_add(1, std::memory_order_relaxed);
  if (text.starts_with("data(application") && text.find("deserialization") != std::string_view::npos) {
    to.unreadable.fetch_add(1, std::memory_order_relaxed);
  }
  const std::lock_guard<std::mutex> guard(to.mutex);
  to.last.assign(text.substr(0, kLongest));
  if (text.find("handshake") != std::string_view::npos && text.find("failed") != std::string_view::npos) {
    to.refusal = to.last;
  }
}

}  // namespace

void catch_dds_log() {
  dds_set_log_sink(&sink, nullptr);
}

std::string last_dds_message() {
  const std::lock_guard<std::mutex> guard(log().mutex);
  return log().last;
}

std::string last_refusal() {
  const std::lock_guard<std::mutex> guard(log().mutex);
  return log().refusal;
}

std::uint64_t dds_message_count() noexcept {
  return log().count.load(std::memory_order_relaxed);
}

std::uint64_t unreadable_samples() noexcept {
  return log().unreadable.load(std::memory_order_relaxed);
}

}  // namespace indurop::dds
