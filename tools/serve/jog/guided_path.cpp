// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/jog/guided_path.h"

#include <chrono>
#include <utility>

namespace indurop::serve {

GuidedPath::GuidedPath(vars::Store store, tools::GuidedRecord record)
    : store_(std::move(store)),
      record_(std::move(record)),
      thread_([this](const std::stop_token& ended) { run(ended); }) {}

void GuidedPath::stop() {
  const std::lock_guard guard(mutex_);
  records_ = false;
  thread_.request_stop();
}

GuidedPath::View GuidedPath::view() const {
  const std::lock_guard guard(mutex_);
  return {records_,
          records_ && record_.guided(),
          record_.places().size(),
          record_.marks(),
          record_.length(),
          record_.tool(),
          problem_};
}

std::vector<robot::GuidedPlace> GuidedPath::places() const {
  const std::lock_guard guard(mutex_);
  return record_.places();
}

bool GuidedPath::take() {
  const std::lock_guard guard(mutex_);
  if (!records_) {
    return false;
  }
  const auto news = record_.take(store_, false);
  if (!news || store_.retired()) {
    problem_ = news ? "the node has ended" : news.error().text;
    records_ = false;
  } else if (news->filled) {
    problem_ = "the path is as long as it may be: nothing more is recorded";
  }
  return records_;
}

void GuidedPath::run(const std::stop_token& ended) {
  auto next = std::chrono::steady_clock::now();
  while (!ended.stop_requested() && take()) {
    next += std::chrono::nanoseconds(tools::GuidedRecord::kEachNs);
    std::this_thread::sleep_until(next);
  }
}

}  // namespace indurop::serve
