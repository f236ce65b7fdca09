// SPDX-License-Identifier: Apache-2.0
// Writes the frames of one other board to the landings of its variables in this board's store.

#pragma once

#include <indurop/idl/wire.h>
#include <indurop/result.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "network/mirror/frames/frame_layout.h"
#include "network/mirror/frames/landing.h"
#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/plane.h"
#include "network/mirror/frames/staging.h"
#include "network/mirror/frames/update_word.h"
#include "store/vars/store.h"

namespace indurop::mirror {

class Receiver final : public FrameListener {
 public:
  // `mutex` guards the landings; taken by the plane's receive thread and the mirror's manager, never by the control
  // loop. `store`, whose time is used, and all other references are borrowed until the end.
  Receiver(std::string board, const vars::Store& store, const std::vector<Landing*>& landings, std::mutex& mutex,
           PeerRecord& record);
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  [[nodiscard]] const std::string& board() const noexcept { return board_; }

  // The board announced itself (again). Compares its variables with this board's and, if they agree, reads its frames
  // from now on; last values arrive at once. If it only sends more than before, what it sent goes on. Called by the
  // mirror's manager only.
  void announced(const indurop_wire_Catalogue& catalogue, Plane& plane);
  // From now on these are read from the board, and no others; what was read before and is among them goes on. Those
  // that were not read at the start are read as soon as the board sends them; that it does not is no disagreement, as
  // it may get them later. They have their fallback after `patience_ns`. `plane` null: the network is not open yet.
  // Called by the mirror's manager only.
  void follow(const std::vector<Landing*>& landings, std::int64_t patience_ns, Plane* plane);
  // The board fell silent: its values are no longer confirmed. This and alive(): any thread.
  void silent() noexcept;
  // This run of the board is alive. It seemed silent if it was busy for longer than the lease, and does not announce
  // itself again.
  void alive(std::uint64_t session) noexcept;
  // The board is present, but runs a release with another protocol; an empty problem: no longer. Called by the mirror's
  // manager only.
  void other_release(const std::string& problem);
  // Stops reading.
  void close() noexcept;

 private:
  struct Item {
    Landing* landing = nullptr;
    std::size_t source = 0;  // this board's number in the landing
    bool is_read = true;
    bool at_start = true;
  };
  struct Offer {  // of the catalogue
    std::uint64_t name_hash = 0;
    std::uint64_t type_hash = 0;
    std::uint32_t part = 0;
    std::uint32_t offset = 0;
    std::uint32_t size = 0;
    std::uint8_t stream = 0;
  };
  struct Arrival {  // where the board put an item
    std::uint32_t item = 0;
    std::uint32_t offset = 0;
  };
  struct Inbox {
    Stream stream = Stream::Prompt;
    std::uint32_t size = 0;    // minimum size of a frame in bytes
    std::uint64_t update = 0;  // newest update accepted, if the part is sent on its own
    std::vector<Arrival> content;
  };
  struct Port {  // one per stream
    std::unique_ptr<Subscription> subscription;
    std::uint64_t newest_update = 0;
  };

  void subscribe(Plane& plane);
  void frame_came(const indurop_wire_Frame& frame, Stream stream) noexcept override;
  void accept(const indurop_wire_Frame& frame, Port& port) noexcept;
  void apply_alone(const indurop_wire_Frame& frame, std::int64_t now_ns) noexcept;
  void apply_together(const indurop_wire_Frame& frame, std::int64_t now_ns) noexcept;
  void deliver(const Inbox& inbox, std::span<const std::uint8_t> data, UpdateWord* word, std::int64_t now_ns) noexcept;
  struct Match {
    std::vector<Inbox> inboxes;  // positions of the variables that are read from the board
    std::string problem;
    bool agrees = true;
  };
  // `schema`: the board's; null: not known any more.
  [[nodiscard]] Match match(const char* schema) const;
  void read_again(const char* schema);
  void lend_room(Landing& landing);

  std::string board_;
  const vars::Store& store_;
  std::mutex& mutex_;
  PeerRecord& record_;
  std::vector<Item> items_;
  std::uint64_t session_ = 0;
  std::uint64_t layout_ = 0;
  bool other_release_ = false;
  bool matched_ = false;        // this session's variables agree with ours
  std::vector<Offer> offers_;   // of this session
  std::vector<Inbox> inboxes_;  // by part, for all parts of the board
  Staging staging_;
  UpdateWord word_;
  bool has_room_ = false;  // for the word
  std::array<Port, kStreams> ports_;
};

}  // namespace indurop::mirror
