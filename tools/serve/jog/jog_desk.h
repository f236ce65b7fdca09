// SPDX-License-Identifier: Apache-2.0
// Remote jogging of robots: the enabling switch of ROBOT_JOG, which is pressed as long as its client keeps renewing. It
// is released by the client, by this desk when the client does not renew in time, and by the robot task when the desk's
// heartbeat stops. Also guiding by hand, whose path is recorded meanwhile.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "store/vars/store.h"
#include "tools/serve/audit.h"
#include "tools/serve/desk.h"
#include "tools/serve/door/request.h"

namespace indurop::serve {

class GuidedPath;

// The motion that a client requests.
struct JogRequest {
  std::string frame;          // "axes", "base", "tool", "hand" or a work frame
  std::vector<double> speed;  // in %, of axes, or along and about x, y, z; one is not 0. Of "hand": none
};

class JogDesk {
 public:
  // A client has to renew within this time.
  static constexpr std::int64_t kKeepNs = 250'000'000;
  // Of guiding by hand: it needs the enabling device of manual mode, too, and the arm stands if nothing pushes it. The
  // desk beats meanwhile.
  static constexpr std::int64_t kKeepByHandNs = 1'000'000'000;

  explicit JogDesk(const Audit& audit) : desk_(audit, "end of jog", kKeepNs) {}
  ~JogDesk();
  JogDesk(const JogDesk&) = delete;
  JogDesk& operator=(const JogDesk&) = delete;

  // Presses the switch of `robot`, the namespace of its ROBOT_JOG. Returns the name to renew it by, or why it was
  // refused.
  Result<std::string, base::Problem> begin(const std::string& board, const std::string& robot, const std::string& who,
                                           const std::string& from, const JogRequest& request);
  // Renews. Returns false if this client does not hold the switch any more: also if it may no longer change ROBOT_JOG,
  // or another client has written it.
  bool keep(const std::string& board, const std::string& name, const Client& client);
  bool end(const std::string& board, const std::string& name, const std::string& who);
  // Releases switches whose client did not renew in time, and beats for hands. To be called every 0.1 s.
  void end_overdue();
  // Returns the path along which a hand guided this robot last; null: none since the server started.
  [[nodiscard]] std::shared_ptr<const GuidedPath> guided_path(const std::string& board, const std::string& robot) const;
  [[nodiscard]] bool busy() const noexcept { return !desk_.is_empty(); }

 private:
  // The enabling switch of one robot.
  struct Switch {
    const vars::DirectoryEntry* entry = nullptr;
    std::string name;  // full name of the variable
    schema::Type type;
    std::uint32_t beat_offset = 0;
    std::uint32_t enable_offset = 0;
    std::size_t enable_size = 0;
    std::size_t axes = 0;
  };
  // A client that presses it.
  struct Hand : HeldBase {
    std::string robot;
    vars::Store store;
    Switch place;
    std::shared_ptr<GuidedPath> path;  // that is recorded; null: it is not moved by hand
    std::uint32_t beat = 0;
    std::uint64_t run = 0;  // of the node: a switch that was pressed in one run is not pressed in the next one

    Hand(vars::Store opened, Switch pressed) : store(std::move(opened)), place(std::move(pressed)) {}
    void count_beat();
    [[nodiscard]] bool is_pressed(std::span<const std::uint8_t> bytes) const;
    // Writes the next beat, if the switch is still as this client has left it. Else, and if the board is locked,
    // releases the switch and returns the outcome: two clients that press it would not know who moves the robot.
    const char* send_beat();
    void release();
  };
  static Result<Switch, base::Problem> switch_of(const vars::Store& store, const std::string& robot);
  // A press is an edge: releases a switch that a client which has gone left pressed, and waits for the robot to see it.
  static void release_before(Hand& hand);
  // Begins to record a path. Returns why that was refused.
  std::optional<base::Problem> record_path(Hand& hand);

  mutable std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<GuidedPath>> paths_;  // of boards and robots
  Desk<Hand> desk_;
};

}  // namespace indurop::serve
