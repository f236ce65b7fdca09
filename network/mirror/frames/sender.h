// SPDX-License-Identifier: Apache-2.0
// Detects which of the board's outgoing variables have changed and sends their parts as frames.

#pragma once

#include <indurop/detail/abi.h>

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "network/mirror/frames/change_collector.h"
#include "network/mirror/frames/frame_layout.h"
#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/plane.h"
#include "network/mirror/frames/settings.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class Sender {
 public:
  // `session` distinguishes this run of the board from earlier ones. Variables that the store does not hold are left
  // out. `store` and `settings` are borrowed until the end.
  Sender(vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block);

  // Publishes the catalogue; from then on `plane` transports what is sent, until it is closed.
  Plane::Opened open(Plane& plane);

  // Sends those of the variables, too, that it does not send yet, and publishes the catalogue again. They get parts of
  // their own: what a part number means stays as long as the session lasts, so that other boards go on with the parts
  // they know. They are sent a moment after the catalogue, which is to be there first. `writers` are borrowed until the
  // end. Called by the thread that calls open().
  Plane::Opened add(std::span<const Outgoing> outgoing, const std::deque<Writers>& writers, std::int64_t now_ns);

  // Sends what has changed, and what has not been sent for its keep-alive time; large values only with `bulk`. One
  // thread at a time for each of the two. Returns true if it must be called again soon: values wait for the end of a
  // run that is not notified.
  bool cycle(std::int64_t now_ns, std::uint64_t tick, bool bulk) noexcept;

  // Called by the thread that calls open().
  [[nodiscard]] bool has_bulk() const noexcept { return !sides_[1].parts.empty(); }
  [[nodiscard]] bool empty() const noexcept { return sides_[0].parts.empty() && sides_[1].parts.empty(); }

 private:
  struct Content {
    vars::DirectoryEntry entry{};
    std::string name;
  };
  struct Outbox {
    std::uint32_t number = 0;
    Part part;
    std::vector<Content> content;  // as of part.content
    std::vector<std::uint8_t> image;
    std::uint64_t update = 0;  // number of the last update that contains this part
    std::int64_t sent_ns = 0;
    std::int64_t not_before_ns = 0;
    bool dirty = true;
    bool due = false;
    // Returns whether its values change together with those of other parts.
    [[nodiscard]] bool together() const noexcept { return part.stream == Stream::Prompt && part.every_ns == 0; }
  };
  // What one thread sends. The mutex is between that thread and the one that adds parts; no module waits for either.
  struct Side {
    explicit Side(const vars::Store& store) : collector(store) {}
    std::mutex mutex;
    std::vector<std::unique_ptr<Outbox>> parts;
    ChangeCollector collector;
    std::uint64_t updates = 0;
  };

  // Returns the text that identifies where the variables are.
  std::string place(std::span<const Outgoing> outgoing, const std::deque<Writers>& writers, std::int64_t not_before_ns);
  [[nodiscard]] bool sends(const std::string& variable) const noexcept;
  Plane::Opened offer();
  bool choose(Side& side, std::int64_t now_ns) noexcept;
  void send(Outbox& out, std::uint64_t tick, std::int64_t now_ns) noexcept;
  void publish_catalogue() noexcept;

  vars::Store& store_;
  MirrorBlock& block_;
  std::uint64_t session_;
  std::uint64_t layout_ = 0;
  std::string board_;
  std::string schema_text_;
  std::uint32_t part_count_ = 0;
  std::array<Side, 2> sides_;  // of the prompt and the bulk thread
  Plane* plane_ = nullptr;
  std::uint64_t update_sum_ = 0;  // sum over the parts that change together
};

}  // namespace indurop::mirror
