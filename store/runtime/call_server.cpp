// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/call_server.h"

#include <fmt/format.h>
#include <indurop/irp.h>
#include <unistd.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/guard.h"
#include "core/rt/shared_mutex.h"
#include "store/runtime/attachment.h"
#include "store/runtime/host.h"
#include "store/runtime/module_file.h"
#include "store/runtime/process.h"
#include "store/vars/call_state.h"

namespace indurop::runtime {

namespace {

using detail::FunctionOffer;
using vars::CallFunction;
using vars::CallSlot;
using vars::CallState;
using vars::sequence_of;
using vars::state_of;
using vars::word_of;

constexpr std::int64_t kStoreCheckNs = 100'000'000;  // interval at which an idle server checks for a new store
constexpr int kTriesBeforeComplaint = 5;

// A function offered by a module; modules are distinguished by the file they were loaded from.
struct Served {
  FunctionOffer* offer = nullptr;
  CallFunction* function = nullptr;  // null: not (yet) served
  int tries = 0;
};

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): what a thread serves
[[gnu::tls_model("initial-exec")]] thread_local const std::vector<Served>* t_served = nullptr;

}  // namespace

Errc invoke_contained(const FunctionOffer& offer, const void* arguments, void* result) noexcept {
  try {
    offer.invoke(arguments, result);
    return Errc::Ok;
  } catch (const std::exception& error) {
    irp::printf("shared function %s threw: %s\n", offer.name, error.what());
  } catch (...) {
    irp::printf("shared function %s threw an exception of an unknown type\n", offer.name);
  }
  return Errc::Failed;
}

const FunctionOffer* offer_of_this_server(std::uint64_t name_hash) noexcept {
  if (t_served != nullptr) {
    for (const Served& served : *t_served) {
      if (served.offer->name_hash == name_hash) {
        return served.offer;
      }
    }
  }
  return nullptr;
}

// One thread serving the functions of one file.
class FunctionServers::Server {
 public:
  Server(const void* owner, std::uint32_t module, const std::vector<FunctionOffer*>& offers)
      : owner_(owner), module_(module) {
    own_wake_.init(false);
    for (FunctionOffer* offer : offers) {
      served_.push_back({offer, nullptr, 0});
    }
  }
  ~Server() { end(); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  Status begin(int fifo_priority, int core) {
    rt::ThreadSettings settings;
    settings.name = "indurop-calls";
    settings.fifo_priority = fifo_priority;
    settings.core = core;
    auto thread = rt::Thread::start(settings, [this] { run(); });
    if (!thread) {
      return thread.error();
    }
    thread_ = std::move(thread).value();
    return {};
  }
  // Waits for the call in progress.
  void end() noexcept {
    stop_.store(true, std::memory_order_release);
    own_wake_.wake();
    if (rt::SignalWord* wake = wake_.load(std::memory_order_acquire)) {
      wake->wake();
    }
    thread_.join();
  }
  [[nodiscard]] const void* owner() const noexcept { return owner_; }
  [[nodiscard]] bool serves(const FunctionOffer& offer) const noexcept {
    return std::any_of(served_.begin(), served_.end(), [&offer](const Served& one) { return one.offer == &offer; });
  }

 private:
  void run() {
    set_current_module(module_);
    t_served = &served_;
    const rt::HandlerStack stack;
    guard_.enter();
    // A crash of an implementation jumps back to this point (in the node, whose handlers call catch_fault()).
    if (sigsetjmp(guard_.target(), 0) != 0) {
      crashed();
    } else {
      serve();
    }
    leave();
    guard_.leave();
    t_served = nullptr;
  }

  void serve() {
    std::int64_t next_check = 0;
    while (!stop_.load(std::memory_order_acquire)) {
      const std::int64_t now = rt::now_ns();
      if (now >= next_check) {
        next_check = now + kStoreCheckNs;
        Process::get().refresh();
        enter();
      }
      if (!serve_all()) {
        rt::SignalWord* wake = wake_.load(std::memory_order_relaxed);
        (void)(wake != nullptr ? *wake : own_wake_).wait_until(rt::mono_time(next_check));
      }
    }
  }

  // Starts serving every function that is not served yet in the store to which the process is bound now.
  void enter() {
    Attachment* now = hot.attachment.load(std::memory_order_acquire);
    if (now != attachment_) {
      leave();
      attachment_ = now;
    }
    if (attachment_ == nullptr) {
      return;
    }
    for (Served& served : served_) {
      if (served.function == nullptr) {
        take_over(served);
      }
    }
  }

  void take_over(Served& served) {
    const FunctionOffer& offer = *served.offer;
    CallFunction* function = attachment_->calls().function(offer.name_hash);
    if (function == nullptr || function->type_hash != offer.type_hash || function->args_size != offer.args_size ||
        function->result_size != offer.result_size) {
      Process::get().report(fmt::format(
          "shared function {}: {} in node '{}', so this module's implementation is not used: rebuild against the same "
          ".glb and restart the node",
          offer.name, function == nullptr ? "is not known" : "has another type", attachment_->node()));
      return;
    }
    if (!rt::is_locked(rt::lock_within(function->serving))) {
      if (++served.tries == kTriesBeforeComplaint) {  // a server that is just ending still holds it
        Process::get().report(
            fmt::format("shared function {}: implemented twice, process {} serves it already: "
                        "implement it in one module only",
                        offer.name, function->server_pid.load(std::memory_order_relaxed)));
      }
      return;
    }
    clean_up(*function);
    served.function = function;
    served.tries = 0;
    if (waking_ == nullptr) {
      waking_ = function;  // all functions of this server share the wake word of the first one
      wake_.store(&function->wake, std::memory_order_release);
    }
    function->wake_index.store(attachment_->calls().index_of(*waking_), std::memory_order_release);
    function->server_pid.store(::getpid(), std::memory_order_relaxed);
  }

  // Answers the calls that a dead server was working on; frees slots that no caller waits for.
  void clean_up(CallFunction& function) noexcept {
    for (std::size_t i = 0; i < vars::kCallSlots; ++i) {
      CallSlot& slot = attachment_->calls().slot(function, i);
      std::uint64_t word = slot.state.load(std::memory_order_acquire);
      if (state_of(word) == CallState::Running) {
        answer(slot, sequence_of(word), Errc::Dead);
      } else if (state_of(word) == CallState::Abandoned) {
        slot.state.compare_exchange_strong(word, word_of(sequence_of(word), CallState::Free));
      }
    }
  }

  bool serve_all() noexcept {
    bool any = false;
    for (const Served& served : served_) {
      for (std::size_t i = 0; served.function != nullptr && i < vars::kCallSlots; ++i) {
        CallSlot& slot = attachment_->calls().slot(*served.function, i);
        std::uint64_t word = slot.state.load(std::memory_order_acquire);
        if (state_of(word) == CallState::Ready &&
            slot.state.compare_exchange_strong(word, word_of(sequence_of(word), CallState::Running))) {
          work_on(served, slot, sequence_of(word));
          any = true;
        }
      }
    }
    return any;
  }

  void work_on(const Served& served, CallSlot& slot, std::uint64_t sequence) noexcept {
    auto* bytes = reinterpret_cast<std::byte*>(&slot);
    working_ = &slot;
    working_sequence_ = sequence;
    working_offer_ = served.offer;
    guard_.arm();
    const Errc code =
        invoke_contained(*served.offer, bytes + vars::kCallArgsOffset, bytes + served.function->result_offset);
    guard_.disarm();
    working_ = nullptr;
    answer(slot, sequence, code);
  }

  static void answer(CallSlot& slot, std::uint64_t sequence, Errc code) noexcept {
    slot.error.store(static_cast<std::uint32_t>(code), std::memory_order_relaxed);
    std::uint64_t word = word_of(sequence, CallState::Running);
    if (slot.state.compare_exchange_strong(word, word_of(sequence, CallState::Done), std::memory_order_acq_rel)) {
      slot.reply.wake();
    } else if (word == word_of(sequence, CallState::Abandoned)) {
      slot.state.store(word_of(sequence, CallState::Free), std::memory_order_release);
    }
  }

  void crashed() noexcept {
    guard_.recovered();
    release_calls_of_this_thread();
    attachment_->store().release_locks_of_this_thread();
    irp::printf("shared function %s crashed with signal %d (%s): its module's functions are no longer served\n",
                working_offer_->name, guard_.signal_number(), ::strsignal(guard_.signal_number()));
    answer(*working_, working_sequence_, Errc::Failed);
  }

  void leave() noexcept {
    wake_.store(nullptr, std::memory_order_release);
    waking_ = nullptr;
    for (Served& served : served_) {
      if (served.function != nullptr) {
        served.function->server_pid.store(0, std::memory_order_relaxed);
        rt::unlock(served.function->serving);
        served.function = nullptr;
      }
    }
    attachment_ = nullptr;
  }

  const void* owner_;
  std::uint32_t module_;
  std::vector<Served> served_;
  std::atomic<bool> stop_{false};
  std::atomic<rt::SignalWord*> wake_{nullptr};  // in the store
  CallFunction* waking_ = nullptr;
  Attachment* attachment_ = nullptr;
  rt::Guard guard_;
  CallSlot* working_ = nullptr;
  std::uint64_t working_sequence_ = 0;
  const FunctionOffer* working_offer_ = nullptr;
  rt::SignalWord own_wake_{};
  rt::Thread thread_;
};

FunctionServers::FunctionServers() = default;
FunctionServers::~FunctionServers() = default;

void FunctionServers::offer(FunctionOffer& offer) {
  const std::lock_guard lock(mutex_);
  offers_.push_back({&offer, image_of(reinterpret_cast<const void*>(offer.invoke)), current_module()});
}

void FunctionServers::withdraw(const FunctionOffer& offer) {
  std::unique_ptr<Server> ended;
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(offers_, [&offer](const Offered& one) { return one.offer == &offer; });
    const auto server =
        std::find_if(servers_.begin(), servers_.end(), [&offer](const auto& one) { return one->serves(offer); });
    if (server != servers_.end()) {
      ended = std::move(*server);
      servers_.erase(server);
    }
  }
}

Status FunctionServers::start(int fifo_priority, int core) {
  const std::lock_guard lock(mutex_);
  for (const Offered& first : offers_) {
    const bool running = std::any_of(servers_.begin(), servers_.end(),
                                     [&first](const auto& server) { return server->owner() == first.owner; });
    if (running) {
      continue;
    }
    std::vector<FunctionOffer*> together;
    for (const Offered& one : offers_) {
      if (one.owner == first.owner) {
        together.push_back(one.offer);
      }
    }
    auto server = std::make_unique<Server>(first.owner, first.module, std::move(together));
    if (const Status status = server->begin(fifo_priority, core); !status) {
      return status;
    }
    servers_.push_back(std::move(server));
  }
  return {};
}

void FunctionServers::stop() {
  std::vector<std::unique_ptr<Server>> ended;
  {
    const std::lock_guard lock(mutex_);
    ended.swap(servers_);
  }
}

}  // namespace indurop::runtime

extern "C" {
void indurop_offer_function(indurop::detail::FunctionOffer* offer) noexcept {
  indurop::runtime::Process::get().servers().offer(*offer);
}
void indurop_withdraw_function(indurop::detail::FunctionOffer* offer) noexcept {
  indurop::runtime::Process::get().servers().withdraw(*offer);
}
}
