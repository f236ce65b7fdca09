// SPDX-License-Identifier: Apache-2.0
// The state of libindurop in this process: variables, the store they are bound to, the node's run block, the module
// that this process is. One object per process, because generated headers register themselves when they are loaded; it
// lives until the process ends.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "store/runtime/attachment.h"
#include "store/runtime/call_server.h"
#include "store/runtime/pool_bindings.h"
#include "store/runtime/ref_tables.h"
#include "store/runtime/run_mapping.h"
#include "store/tape/track.h"

namespace indurop::runtime {

// The words that real-time code reads: plain atomics, valid from the first instruction of the process on.
struct Hot {
  std::atomic<Attachment*> attachment{nullptr};
  std::atomic<scheduler::RunBlock*> run{nullptr};
  std::atomic<std::uint32_t> process_module{0xFFFFFFFF};  // kNoModule
};
extern constinit Hot hot;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): there is one process

// The time of the node this process is bound to; CLOCK_MONOTONIC without one. Real-time safe.
rt::MonoTime schedule_now() noexcept;

// INDUROP_NODE, else "local".
std::string default_node();

class Process {
 public:
  static Process& get();

  // At load: binds to the default node if it exists. Later calls bind to whatever the process is bound to.
  void register_refs(abi::Ref* refs, std::uint32_t count);
  void unregister_refs(const abi::Ref* refs);
  // The same for pools.
  void register_pool(abi::PoolUse& use);
  void unregister_pool(abi::PoolUse& use);
  // A use found no pool, or a retired one. A process that waits for periods searches for it there; another one does it
  // now, at most ten times a second. Returns true if it did. Real-time safe in modules.
  bool pool_is_missing() noexcept;
  // See host.h.
  void release_chunks_of(std::uint32_t module) noexcept { pools_.release_of(module); }

  // See host.h.
  void bind_apart(const void* inside);
  void bind_back(const void* inside);

  // Binds to `node` unless already bound to its current block. `unbound`: number of variables used by the program that
  // could not be bound; each is reported once on stderr. Errors: those of Store::attach.
  Status attach(const std::string& node, std::size_t& unbound);
  // What the program's code uses of the store, for its track. Not real-time safe.
  std::vector<tape::VariableUse> uses_of(const vars::Store& store);
  // Attaches again if the block was replaced. Otherwise costs one load.
  void refresh() noexcept;

  // Messages and properties use this run block from now on; the previous one stays mapped for threads still using it.
  RunMapping* adopt_run(RunMapping&& mapping);

  // The node's own process.
  std::vector<std::string> host(vars::Store& store, scheduler::RunBlock& run);
  void unhost();
  [[nodiscard]] bool hosted() const noexcept { return hosted_.load(std::memory_order_acquire); }

  // Stores a line for take_errors() in the node, prints it to stderr elsewhere; each text once.
  void report(const std::string& text);
  std::vector<std::string> take_errors();
  // Returns true at the first call with `text`.
  bool first_time(const std::string& text);

  FunctionServers& servers() noexcept { return servers_; }

 private:
  Process();
  void attach_at_load();
  [[nodiscard]] std::string node_in_use() const;
  std::size_t report_all(const std::vector<BindingProblem>& problems);
  Status attach_locked(const std::string& node, std::size_t& unbound);

  std::recursive_mutex mutex_;
  RefTables tables_;
  PoolBindings pools_;
  std::atomic<bool> pools_missing_{false};
  std::atomic<std::int64_t> next_search_ns_{0};  // for pools
  bool tried_at_load_ = false;
  std::atomic<bool> hosted_{false};
  std::deque<std::unique_ptr<Attachment>> attachments_;  // the newest is in use
  std::deque<std::unique_ptr<RunMapping>> runs_;
  std::vector<std::string> errors_;
  std::set<std::string> reported_;
  FunctionServers servers_;
};

}  // namespace indurop::runtime
