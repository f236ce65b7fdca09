// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/pool_bindings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

#include "scheduler/run_block.h"
#include "store/runtime/host.h"
#include "store/runtime/module_file.h"
#include "store/runtime/process.h"

namespace indurop::runtime {

namespace {

// Shown in `indurop status`.
std::string user_name(std::uint32_t module) {
  const scheduler::RunBlock* run = hot.run.load(std::memory_order_acquire);
  if (run == nullptr || module >= run->module_count) {
    return program_invocation_short_name;
  }
  const char* const name = run->modules()[module].name;
  return {name, strnlen(name, sizeof run->modules()[module].name)};
}

std::string what_to_do(Errc code, const std::string& node) {
  switch (code) {
    case Errc::NotFound:
      return fmt::format("node '{}' does not have it: name this program in the node's module.xml and restart the node",
                         node);
    case Errc::TypeMismatch:
      return fmt::format("node '{}' has other chunks of this name: rebuild against the same .glb", node);
    case Errc::NoSpace:
      return fmt::format("{} modules and programs use it already (`indurop status`): end one of them", pools::kSeats);
    default:
      return fmt::format("node '{}': {}", node, to_string(code));
  }
}

}  // namespace

std::vector<BindingProblem> PoolBindings::add(abi::PoolUse& use, std::uint32_t module, const std::string& node) {
  std::vector<BindingProblem> problems;
  uses_.push_back({&use, module});
  if (!node.empty()) {
    bind_one(uses_.back(), node, true, problems);
  }
  return problems;
}

void PoolBindings::remove(abi::PoolUse& use) {
  end(use);
  std::erase_if(uses_, [&use](const Use& one) { return one.use == &use; });
}

std::vector<BindingProblem> PoolBindings::bind(const std::string& node) {
  return bind_all(node, true);
}

std::vector<BindingProblem> PoolBindings::search(const std::string& node) {
  return bind_all(node, false);
}

std::vector<BindingProblem> PoolBindings::bind_all(const std::string& node, bool must_exist) {
  for (auto& binding : owned_) {
    if (binding->ended && binding->pool && !binding->chunks.has_any(binding->seat)) {
      binding->pool.reset();  // its memory, one round after its end: then no thread is about to use it
    }
  }
  std::vector<BindingProblem> problems;
  for (const Use& use : uses_) {
    const auto* bound = static_cast<const PoolBinding*>(use.use->binding.load(std::memory_order_acquire));
    if (node.empty() || (bound != nullptr && !bound->pool->is_current())) {
      end(*use.use);
      bound = nullptr;
    }
    if (!node.empty() && bound == nullptr && !use.apart) {
      bind_one(use, node, must_exist, problems);
    }
  }
  return problems;
}

void PoolBindings::bind_apart(const void* inside) {
  const void* const image = image_of(inside);
  for (Use& use : uses_) {
    if (image_of(use.use) == image) {
      use.apart = true;
      end(*use.use);
    }
  }
}

void PoolBindings::bind_back(const void* inside, const std::string& node) {
  const void* const image = image_of(inside);
  std::vector<BindingProblem> known;  // since the file was loaded
  for (Use& use : uses_) {
    if (use.apart && image_of(use.use) == image) {
      use.apart = false;
      bind_one(use, node, false, known);
    }
  }
}

void PoolBindings::release_of(std::uint32_t module) noexcept {
  for (const auto& slot : bindings_) {
    PoolBinding* const binding = slot.load(std::memory_order_acquire);
    if (binding == nullptr) {
      return;
    }
    if (binding->module == module && !binding->ended) {
      binding->epoch.fetch_add(1, std::memory_order_relaxed);
      (void)binding->chunks.release_all(binding->seat);
    }
  }
}

void PoolBindings::bind_one(const Use& use, const std::string& node, bool must_exist,
                            std::vector<BindingProblem>& problems) {
  const Errc code = open(use, node);
  if (code != Errc::Ok && (must_exist || code != Errc::NotFound)) {
    problems.push_back({fmt::format("pool {}: {}", use.use->name, what_to_do(code, node)), true});
  }
}

Errc PoolBindings::open(const Use& use, const std::string& node) {
  auto pool = pools::Pool::open(node, use.use->name, use.use->type_hash, vars::Mode::ReadWrite);
  if (!pool) {
    return pool.error().code;
  }
  if (pool->shape().chunk_bytes != use.use->chunk_bytes) {
    return Errc::TypeMismatch;
  }
  const auto seat = pool->take_seat(user_name(use.module));
  if (!seat || owned_.size() == kMaxBindings) {
    return seat ? Errc::Overflow : seat.error().code;
  }
  owned_.push_back(std::make_unique<PoolBinding>(std::move(pool).value(), *seat, use.module));
  bindings_[owned_.size() - 1].store(owned_.back().get(), std::memory_order_release);
  use.use->binding.store(owned_.back().get(), std::memory_order_release);
  return Errc::Ok;
}

void PoolBindings::end(abi::PoolUse& use) {
  auto* const binding = static_cast<PoolBinding*>(use.binding.exchange(nullptr, std::memory_order_acq_rel));
  if (binding != nullptr) {
    binding->ended = true;
    if (!binding->chunks.has_any(binding->seat)) {
      binding->pool->leave_seat(binding->seat);
    }
  }
}

}  // namespace indurop::runtime
