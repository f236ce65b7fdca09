// SPDX-License-Identifier: Apache-2.0
// Detects which of the board's outgoing variables have changed and sends their parts as frames.

#pragma once

#include <indurop/detail/abi.h>

#include <array>
#include <cstdint>
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
  // out. `store` and `settings.writers` are borrowed until the end.
  Sender(vars::Store& store, const Settings& settings, std::uint64_t session, MirrorBlock& block);

  // Publishes the catalogue; from then on `plane` transports what is sent, until it is closed.
  Plane::Opened open(Plane& plane);

  // Sends what has changed, and what has not been sent for its keep-alive time; large values only with `bulk`. One
  // thread at a time for each of the two. Returns true if it must be called again soon: values wait for the end of a
  // run that is not notified.
  bool cycle(std::int64_t now_ns, std::uint64_t tick, bool bulk) noexcept;

  [[nodiscard]] bool has_bulk() const noexcept;
  [[nodiscard]] bool empty() const noexcept { return parts_.empty(); }

 private:
  struct Outbox {
    Part part;
    std::vector<const vars::DirectoryEntry*> content;  // as of part.content
    std::vector<std::uint8_t> image;
    std::uint64_t update = 0;  // number of the last update that contains this part
    std::int64_t sent_ns = 0;
    bool dirty = true;
    bool due = false;
    // Returns whether its values change together with those of other parts.
    [[nodiscard]] bool together() const noexcept { return part.stream == Stream::Prompt && part.every_ns == 0; }
  };

  bool choose(std::int64_t now_ns, bool bulk) noexcept;
  void send(std::uint32_t number, std::uint64_t tick, std::int64_t now_ns) noexcept;
  void publish_catalogue() noexcept;

  vars::Store& store_;
  MirrorBlock& block_;
  std::uint64_t session_;
  std::uint64_t layout_ = 0;
  std::string board_;
  std::string schema_text_;
  std::vector<Outbox> parts_;
  std::array<ChangeCollector, 2> collectors_;  // for the prompt and the bulk thread
  Plane* plane_ = nullptr;
  std::array<std::uint64_t, 2> updates_{};  // for the prompt and the bulk thread
  std::uint64_t update_sum_ = 0;            // sum over the parts that change together
};

}  // namespace indurop::mirror
