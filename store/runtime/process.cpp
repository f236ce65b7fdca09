// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/process.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "store/runtime/host.h"
#include "store/vars/node_lock.h"
#include "store/vars/shm_file.h"

namespace indurop::runtime {

constinit Hot hot;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): there is one process

namespace {

// Number of replaced mappings that are kept for threads that may still be reading them.
constexpr std::size_t kKeptMappings = 4;

template <class T>
T* keep(std::deque<std::unique_ptr<T>>& all, T newest) {
  all.push_back(std::make_unique<T>(std::move(newest)));
  if (all.size() > kKeptMappings) {
    all.pop_front();
  }
  return all.back().get();
}

// A process started by a node finds its messages and properties without any call.
[[gnu::constructor]] void map_run_at_load() {
  if (std::getenv("INDUROP_MODULE") != nullptr) {  // NOLINT(concurrency-mt-unsafe): before main
    if (auto mapping = RunMapping::open(default_node())) {
      Process::get().adopt_run(std::move(mapping).value());
    }
  }
}

}  // namespace

rt::MonoTime schedule_now() noexcept {
  if (const auto* run = hot.run.load(std::memory_order_acquire); run != nullptr) {
    const std::int64_t simulated = run->virtual_ns.load(std::memory_order_relaxed);
    return simulated != 0 ? rt::mono_time(simulated) : rt::MonoClock::now();
  }
  const Attachment* attachment = hot.attachment.load(std::memory_order_acquire);
  return attachment != nullptr ? attachment->store().now() : rt::MonoClock::now();
}

namespace {

std::string named_node() {
  const char* node = std::getenv("INDUROP_NODE");  // NOLINT(concurrency-mt-unsafe): read only
  return node != nullptr ? node : "";
}

// A program without a given node binds to the default one only while that runs, not to what it left behind.
bool binds_at_load() {
  return !named_node().empty() || vars::running_node(default_node()) != 0;
}

}  // namespace

std::string default_node() {
  const std::string named = named_node();
  return named.empty() ? "local" : named;
}

Process& Process::get() {
  static auto* process = new Process;  // NOLINT: unregistering happens after static destructors
  return *process;
}

Process::Process() {
  const char* module = std::getenv("INDUROP_MODULE");  // NOLINT(concurrency-mt-unsafe): read only
  std::uint32_t index = kNoModule;
  if (module != nullptr) {
    std::from_chars(module, module + std::strlen(module), index);
  }
  hot.process_module.store(index, std::memory_order_relaxed);
}

std::string Process::node_in_use() const {
  const Attachment* attachment = hot.attachment.load(std::memory_order_relaxed);
  return attachment != nullptr ? attachment->node() : "";
}

void Process::attach_at_load() {
  if (!std::exchange(tried_at_load_, true) && !hosted() && binds_at_load()) {
    std::size_t unbound = 0;
    const Status status = attach_locked(default_node(), unbound);
    if (!status && status.error().code != Errc::NotFound) {
      report(fmt::format("node '{}' is there but this program cannot use it: {} ({})", default_node(),
                         to_string(status.error().code), status.error().where));
    }
  }
}

void Process::register_refs(abi::Ref* refs, std::uint32_t count) {
  const std::lock_guard lock(mutex_);
  attach_at_load();
  report_all(tables_.add(refs, count, hot.attachment.load(std::memory_order_relaxed)));
}

void Process::unregister_refs(const abi::Ref* refs) {
  const std::lock_guard lock(mutex_);
  tables_.remove(refs);
}

void Process::register_pool(abi::PoolUse& use) {
  const std::lock_guard lock(mutex_);
  attach_at_load();
  report_all(pools_.add(use, current_module(), node_in_use()));
}

void Process::unregister_pool(abi::PoolUse& use) {
  const std::lock_guard lock(mutex_);
  pools_.remove(use);
}

bool Process::pool_is_missing() noexcept {
  constexpr std::int64_t kSearchNs = 100'000'000;
  const std::int64_t now = rt::now_ns();
  if (hosted() || now < next_search_ns_.load(std::memory_order_relaxed)) {
    return false;
  }
  next_search_ns_.store(now + kSearchNs, std::memory_order_relaxed);
  if (hot.process_module.load(std::memory_order_relaxed) != kNoModule) {
    pools_missing_.store(true, std::memory_order_relaxed);
    return false;
  }
  const std::lock_guard lock(mutex_);
  report_all(pools_.search(node_in_use()));
  return true;
}

void Process::bind_apart(const void* inside) {
  const std::lock_guard lock(mutex_);
  pools_.bind_apart(inside);
  if (const Attachment* attachment = hot.attachment.load(std::memory_order_relaxed); attachment != nullptr) {
    tables_.bind_apart(inside, *attachment);
  }
}

void Process::bind_back(const void* inside) {
  const std::lock_guard lock(mutex_);
  if (const Attachment* attachment = hot.attachment.load(std::memory_order_relaxed); attachment != nullptr) {
    tables_.bind_back(inside, *attachment);
    pools_.bind_back(inside, attachment->node());
  }
}

Status Process::attach(const std::string& node, std::size_t& unbound) {
  const std::lock_guard lock(mutex_);
  return attach_locked(node, unbound);
}

Status Process::attach_locked(const std::string& node, std::size_t& unbound) {
  tried_at_load_ = true;
  Attachment* current = hot.attachment.load(std::memory_order_relaxed);
  if (!hosted() && (current == nullptr || current->node() != node || current->retired())) {
    auto opened = Attachment::open(node);
    if (!opened) {
      return opened.error();
    }
    current = keep(attachments_, std::move(opened).value());
    hot.attachment.store(current, std::memory_order_release);
  }
  unbound = report_all(tables_.bind(current)) + report_all(pools_.bind(current->node()));
  return {};
}

std::vector<tape::VariableUse> Process::uses_of(const vars::Store& store) {
  const std::lock_guard lock(mutex_);
  std::vector<tape::VariableUse> uses;
  for (const auto& [name_hash, access] : tables_.access()) {
    const vars::DirectoryEntry* const entry = store.find(name_hash);
    if (entry != nullptr && (access.reads || access.writes)) {
      uses.push_back({static_cast<std::uint32_t>(entry - store.directory().data()), access.reads, access.writes});
    }
  }
  return uses;
}

void Process::refresh() noexcept {
  const Attachment* current = hot.attachment.load(std::memory_order_acquire);
  if (current != nullptr && current->retired() && !hosted()) [[unlikely]] {
    std::size_t unbound = 0;
    (void)attach(current->node(), unbound);  // not there at this moment: the old block stays usable, retried later
  } else if (pools_missing_.load(std::memory_order_relaxed)) [[unlikely]] {
    const std::lock_guard lock(mutex_);
    pools_missing_.store(false, std::memory_order_relaxed);
    report_all(pools_.search(node_in_use()));
  }
}

RunMapping* Process::adopt_run(RunMapping&& mapping) {
  const std::lock_guard lock(mutex_);
  RunMapping* newest = keep(runs_, std::move(mapping));
  hot.run.store(&newest->block(), std::memory_order_release);
  return newest;
}

std::vector<std::string> Process::host(vars::Store& store, scheduler::RunBlock& run) {
  const std::lock_guard lock(mutex_);
  hosted_.store(true, std::memory_order_release);
  tried_at_load_ = true;
  hot.process_module.store(kNoModule, std::memory_order_relaxed);
  hot.run.store(&run, std::memory_order_release);
  Attachment* attachment = keep(attachments_, Attachment(store));
  hot.attachment.store(attachment, std::memory_order_release);
  std::vector<std::string> lines;
  for (const BindingProblem& problem : tables_.bind(attachment)) {
    lines.push_back(problem.text);
  }
  for (const BindingProblem& problem : pools_.bind(attachment->node())) {
    lines.push_back(problem.text);
  }
  return lines;
}

void Process::unhost() {
  const std::lock_guard lock(mutex_);
  hot.run.store(nullptr, std::memory_order_release);
  hot.attachment.store(nullptr, std::memory_order_release);
  (void)tables_.bind(nullptr);
  (void)pools_.bind("");
  attachments_.clear();  // they borrow the store, which the node is about to close
  hosted_.store(false, std::memory_order_release);
}

std::size_t Process::report_all(const std::vector<BindingProblem>& problems) {
  std::size_t used = 0;
  for (const BindingProblem& problem : problems) {
    if (problem.used) {
      ++used;
      report(problem.text);
    }
  }
  return used;
}

void Process::report(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (!first_time(text)) {
    return;
  }
  if (hosted()) {
    errors_.push_back(text);
  } else {
    std::fprintf(stderr, "indurop: %s\n", text.c_str());
  }
}

bool Process::first_time(const std::string& text) {
  const std::lock_guard lock(mutex_);
  return reported_.insert(text).second;
}

std::vector<std::string> Process::take_errors() {
  const std::lock_guard lock(mutex_);
  return std::exchange(errors_, {});
}

}  // namespace indurop::runtime
