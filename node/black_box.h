// SPDX-License-Identifier: Apache-2.0
// The tape kept on disk when something went wrong: after a fault of a module, and when a node starts whose last run
// crashed. A box is a recording like any other.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>

#include "node/board_mirror.h"
#include "node/checked.h"
#include "node/console.h"
#include "node/prepared.h"

namespace indurop::node {

inline constexpr std::size_t kMostBoxes = 10;  // of a node; older ones go

// What a node left that crashed, before its memory is used again; nothing if it ended well or there is no tape. Says
// on the console where it is, or why it could not be kept.
void keep_box_of_crash(const std::string& node, const Console& console);

// Of the running node: a fault is noticed, and what the runs before and shortly after it saw is written by a thread.
class BlackBox {
 public:
  // All is borrowed.
  BlackBox(const Options& options, const Checked& checked, const Prepared& prepared, const BoardMirror& mirror,
           Console& console);
  ~BlackBox();
  BlackBox(const BlackBox&) = delete;
  BlackBox& operator=(const BlackBox&) = delete;

  // Again and again, on one normal thread. At most one box a minute for faults of this node, and one for overruns.
  void look(rt::MonoTime now);
  // end() keeps what led to this.
  void keep_at_end(std::string why);
  // The run is over: a fault not yet kept is.
  void end();

 private:
  [[nodiscard]] std::uint64_t faults() const noexcept;
  void keep();
  [[nodiscard]] std::string newest_fault() const;
  [[nodiscard]] std::string many_overruns(rt::MonoTime now);
  void look_for_wish(rt::MonoTime now);

  const Options& options_;
  const Checked& checked_;
  const Prepared& prepared_;
  const BoardMirror& mirror_;
  Console& console_;
  std::uint64_t kept_ = 0;  // faults that were dealt with
  rt::MonoTime due_{};      // when the box of a new fault is written; 0: there is none
  rt::MonoTime next_{};     // earliest time of the next for a fault, and for other reasons
  rt::MonoTime next_overruns_{};
  rt::MonoTime next_wish_{};
  std::string wish_;  // why it is to be kept, if not for a fault of this node
  rt::MonoTime wish_looked_{};
  rt::MonoTime overruns_looked_{};
  std::uint64_t overruns_ = 0;
  std::thread writer_;
};

}  // namespace indurop::node
