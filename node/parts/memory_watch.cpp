// SPDX-License-Identifier: Apache-2.0
#include "node/parts/memory_watch.h"

#include <unistd.h>

#include <chrono>

#include "core/rt/lost_pages.h"
#include "store/vars/shm_file.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kNameCheckInterval{200};

}  // namespace

MemoryWatch::MemoryWatch(const std::string& node, Prepared& prepared, scheduler::Engine& engine, Console& console)
    : node_(node), prepared_(prepared), engine_(engine), console_(console) {
  rt::on_lost_page(&MemoryWatch::on_lost_page, this);
}

MemoryWatch::~MemoryWatch() {
  rt::on_lost_page(nullptr, nullptr);
}

// Called in a signal handler, on any thread. The name is valid as long as the mapping.
void MemoryWatch::on_lost_page(void* context, const char* name) noexcept {
  auto& self = *static_cast<MemoryWatch*>(context);
  self.engine_.halt();
  const char* none = nullptr;
  self.missing_.compare_exchange_strong(none, name, std::memory_order_release);
}

void MemoryWatch::lose(const std::string& file) {
  engine_.halt();
  why_ = fmt::format("a process with write access to /dev/shm/{} truncated it: values were lost", file);
  console_.error("{}; modules are stopped and fail-safe values written. `ls -l /dev/shm/{}` shows who has write access",
                 why_, file);
}

void MemoryWatch::check_names(rt::MonoTime now) {
  if (now < next_names_) {
    return;
  }
  next_names_ = now + kNameCheckInterval;
  const auto store = prepared_.store->named();
  const auto run = prepared_.run_file.named();
  if (store == vars::ShmFile::Named::Cut || run == vars::ShmFile::Named::Cut) {
    lose(store == vars::ShmFile::Named::Cut ? vars::block_file(node_) : vars::run_file(node_));
    return;
  }
  const bool locked = prepared_.name.hold();
  const bool gone = store == vars::ShmFile::Named::Gone || run == vars::ShmFile::Named::Gone;
  if ((gone || !locked) && !unnamed_) {
    unnamed_ = true;
    console_.warning(
        "a process removed files of this node from /dev/shm ({}): the schedule continues, but tools cannot show all of "
        "it. End it with `indurop stop --node {}` or `kill {}`, and start it again",
        store == vars::ShmFile::Named::Gone ? vars::block_file(node_)
        : run == vars::ShmFile::Named::Gone ? vars::run_file(node_)
                                            : vars::lock_file(node_),
        node_, ::getpid());
  }
}

std::string MemoryWatch::check(rt::MonoTime now) {
  if (!why_.empty()) {
    return why_;
  }
  if (const char* const missing = missing_.load(std::memory_order_acquire); missing != nullptr) {
    lose(missing);
  } else if (prepared_.store->lost()) {
    lose(vars::block_file(node_));
  } else {
    check_names(now);
  }
  return why_;
}

}  // namespace indurop::node
