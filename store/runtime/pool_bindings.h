// SPDX-License-Identifier: Apache-2.0
// The pools that the code loaded into this process uses: each use has a seat in the pool's file.

#pragma once

#include <indurop/detail/pool_use.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/pools/pool.h"
#include "store/runtime/ref_tables.h"

namespace indurop::runtime {

struct PoolBinding {
  PoolBinding(pools::Pool&& of, std::uint32_t its_seat, std::uint32_t its_module) noexcept
      : pool(std::move(of)), chunks(pool->chunks()), seat(its_seat), module(its_module) {}
  std::optional<pools::Pool> pool;
  pools::Chunks chunks;
  std::uint32_t seat;
  std::uint32_t module;                 // kNoModule: a program that is no module
  std::atomic<std::uint32_t> epoch{0};  // what was taken in an earlier one is not in its hand any more
  bool ended = false;
};

class PoolBindings {
 public:
  // Registers a use by the module that is being loaded and binds it to the pool of `node`; empty: there is no node.
  std::vector<BindingProblem> add(abi::PoolUse& use, std::uint32_t module, const std::string& node);
  void remove(abi::PoolUse& use);
  // Binds all uses that have no pool or a retired one. An empty node ends all bindings. Returns the problems.
  std::vector<BindingProblem> bind(const std::string& node);
  // The same while the node may be about to make its pools: one that is not there is no problem.
  std::vector<BindingProblem> search(const std::string& node);
  // Ends the bindings of the loaded file that holds `inside`, until bind_back().
  void bind_apart(const void* inside);
  void bind_back(const void* inside, const std::string& node);
  // Frees what a module has in its hand that faulted. Real-time safe, on any thread.
  void release_of(std::uint32_t module) noexcept;

 private:
  struct Use {
    abi::PoolUse* use = nullptr;
    std::uint32_t module = 0;
    bool apart = false;
  };
  static constexpr std::size_t kMaxBindings = 1024;  // of a process, over all its restarts of the node
  std::vector<BindingProblem> bind_all(const std::string& node, bool must_exist);
  void bind_one(const Use& use, const std::string& node, bool must_exist, std::vector<BindingProblem>& problems);
  Errc open(const Use& use, const std::string& node);
  void end(abi::PoolUse& use);

  std::vector<Use> uses_;
  // Bindings stay: a thread may still have a chunk of one that has ended. Real-time threads read the array.
  std::array<std::atomic<PoolBinding*>, kMaxBindings> bindings_{};
  std::vector<std::unique_ptr<PoolBinding>> owned_;
};

}  // namespace indurop::runtime
