// SPDX-License-Identifier: Apache-2.0
// A board's exchange with the other boards of its plant, independent of the transport: no threads, no network.
// Mirror drives it in real time, a simulation in virtual time.

#pragma once

#include <indurop/idl/wire.h>
#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "network/mirror/frames/landing.h"
#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/peer_beacons.h"
#include "network/mirror/frames/plane.h"
#include "network/mirror/frames/receiver.h"
#include "network/mirror/frames/schedule.h"
#include "network/mirror/frames/sender.h"
#include "network/mirror/frames/settings.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class Exchange {
 public:
  // Creates the shared-memory file for tools. `store` and `tick` (number of the current basic period) are borrowed
  // until the end. Not real-time safe. Errors: NoSpace, PermissionDenied, System.
  static Result<std::unique_ptr<Exchange>> make(Settings settings, const std::string& node, vars::Store& store,
                                                const std::atomic<std::uint64_t>& tick);
  Exchange(Settings settings, vars::Store& store, const std::atomic<std::uint64_t>& tick, vars::ShmFile&& file);
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  [[nodiscard]] MirrorBlock& block() noexcept { return block_; }
  [[nodiscard]] const MirrorBlock& block() const noexcept { return block_; }

  // Announces on `plane` what this board has, and receives from the other boards, until close().
  Plane::Opened open(Plane& plane);
  void close() noexcept;

  // From now on exactly the incoming variables are read from other boards, and the outgoing ones are sent, too; what
  // was sent before goes on until the end of the run, whether anyone reads it or not. What both have before and after
  // is not affected. `routes.writers` begins with the earlier ones. The store holds the variables. Called by the thread
  // that calls announced().
  void follow(const Routes& routes);

  // A board announced itself, or is gone. This and the following methods are called by one thread at a time.
  void announced(const indurop_wire_Catalogue& catalogue);
  void gone(const std::string& board) noexcept;
  // Returns whether this is one of the other boards of the plant.
  [[nodiscard]] bool knows(const std::string& board) const noexcept;
  // Calls for each of the other boards with what is wrong with its release; an empty text: nothing.
  template <class Say>
  void other_releases(Say say) {
    for (const auto& receiver : receivers_) {
      receiver->other_release(say(receiver->board()));
    }
  }
  // Announces that this board is alive and sets fallback values, if it is due. Returns when to call again.
  std::int64_t poll(std::int64_t now_ns, const Schedule& schedule) noexcept;

  // Sends what has changed, large values only with `bulk`; one thread at a time for each of the two. Returns when to
  // call again if there is no notification.
  std::int64_t send(std::int64_t now_ns, bool bulk) noexcept;
  // Sends what has changed at the end of the run.
  void send_last(bool bulk) noexcept;
  [[nodiscard]] std::uint64_t tick() const noexcept { return tick_.load(std::memory_order_acquire); }
  [[nodiscard]] bool sends() const noexcept { return !sender_->empty(); }
  [[nodiscard]] bool sends_bulk() const noexcept { return sender_->has_bulk(); }

 private:
  void fill_block();
  void make_receivers();
  Landing* landing_of(const std::string& variable);
  std::vector<Landing*> landings_from(const std::string& board, const std::vector<Incoming>& incoming);
  void list_incoming(const std::vector<Incoming>& incoming);
  [[nodiscard]] Receiver* receiver_of(const std::string& board) const noexcept;

  Settings settings_;
  vars::Store& store_;
  const std::atomic<std::uint64_t>& tick_;
  vars::ShmFile file_;
  MirrorBlock& block_;
  std::uint64_t session_;
  std::mutex landings_mutex_;
  std::vector<std::unique_ptr<Landing>> landings_;
  std::vector<std::unique_ptr<Receiver>> receivers_;
  std::unique_ptr<Sender> sender_;
  std::unique_ptr<Beacons> beacons_;
  Plane* plane_ = nullptr;
};

}  // namespace indurop::mirror
