// SPDX-License-Identifier: Apache-2.0
// Both ends of a cable that leads through all slaves and back to the master, as one wire: each frame leaves at both
// ends, so that every slave is reached although the cable is cut at one place. On a cable that is whole, slaves work on
// the frame of the first end, which comes out at the last one. Real-time safe after construction.

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "control/io/ethercat/master/query.h"

namespace indurop::io::ethercat {

class RingLink final : public Link {
 public:
  // Both are borrowed until the end. Slaves count from the first one.
  RingLink(Link& first, Link& last);

  // Positions are those of the whole cable. True if one end took the frame.
  bool send(Bytes frame) noexcept override;
  // What both ends brought of a frame, as one. A frame of which only one end has brought something by now comes as that
  // says.
  std::size_t receive(std::span<std::uint8_t> to) noexcept override;

  // Which slaves the ends reach; nothing if the cable is whole, as far as the last frames show it.
  struct Cut {
    std::size_t before = 0;  // this one is the first that the first end does not reach
    std::size_t behind = 0;  // and this one the first that the last end reaches
  };
  [[nodiscard]] std::optional<Cut> cut() const noexcept { return cut_; }

 private:
  enum class End : std::uint8_t { First, Last };
  struct Copy {
    std::size_t size = 0;  // 0: it did not come back
    std::array<std::uint8_t, kMaxFrame> bytes{};
    [[nodiscard]] Bytes frame() const noexcept { return Bytes(bytes).first(size); }
  };
  struct Sent {
    bool is_out = false;
    bool is_whole = false;  // its copy of the first end came out at the last one
    Copy frame;
    Copy first;  // that left at the first end
    Copy last;
  };

  void mark_for_last(std::span<std::uint8_t> frame) const noexcept;
  void take(Bytes frame, End from) noexcept;
  void learn(const Sent& sent) noexcept;
  std::size_t merge(Sent& sent, std::span<std::uint8_t> to) const noexcept;
  void merge_datagram(const Datagram& asked, const Sent& sent, std::span<std::uint8_t> to) const noexcept;

  Link& first_;
  Link& last_;
  std::vector<Sent> sent_;  // a ring
  std::size_t next_ = 0;
  std::optional<Cut> cut_;
  std::size_t slaves_ = 0;  // that were ever reached
};

}  // namespace indurop::io::ethercat
