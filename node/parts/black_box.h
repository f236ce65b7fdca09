// SPDX-License-Identifier: Apache-2.0
// Black box: the tape, written to disk after a fault of a module, and when a node starts whose last run crashed. A box
// is a recording like any other.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "node/parts/board_mirror.h"
#include "node/run/checked.h"
#include "node/run/console.h"
#include "node/run/prepared.h"

namespace indurop::node {

inline constexpr std::size_t kMaxBoxes = 10;  // maximum number of boxes of a node; older ones are deleted

// Writes the box of a node that crashed, before its memory is reused; does nothing if the node ended normally or there
// is no tape. Reports on the console where the box is, or why it could not be written.
void keep_box_of_crash(const std::string& node, const Console& console);

// The black box of the running node: it notices a fault, and a thread writes what the runs before and shortly after it
// read and wrote.
class BlackBox {
 public:
  // All arguments are borrowed.
  BlackBox(const Options& options, const Checked& checked, const Prepared& prepared, const BoardMirror& mirror,
           Console& console);
  ~BlackBox();
  BlackBox(const BlackBox&) = delete;
  BlackBox& operator=(const BlackBox&) = delete;

  // Called repeatedly on one normal thread. Writes at most one box a minute for faults of this node, and one for
  // overruns.
  void check(rt::MonoTime now);
  // end() keeps what led to this.
  void keep_at_end(std::string why);
  // Called when the run is over: writes a box for a fault that has none yet.
  void end();

 private:
  [[nodiscard]] std::uint64_t faults() const noexcept;
  void keep();
  [[nodiscard]] std::string newest_fault() const;
  [[nodiscard]] std::string many_overruns(rt::MonoTime now);
  void poll_requests(rt::MonoTime now);

  const Options& options_;
  const Checked& checked_;
  const Prepared& prepared_;
  const BoardMirror& mirror_;
  Console& console_;
  std::uint64_t kept_ = 0;           // faults already handled
  std::optional<rt::MonoTime> due_;  // when the next box is written, if one is due
  rt::MonoTime next_{};              // earliest time of the next box for a fault; below: for other reasons
  rt::MonoTime next_overruns_{};
  rt::MonoTime next_request_{};
  std::string request_;  // why a box is requested, if not for a fault of this node
  rt::MonoTime requests_polled_{};
  rt::MonoTime overruns_checked_{};
  std::uint64_t overruns_ = 0;
  std::thread writer_;
};

}  // namespace indurop::node
