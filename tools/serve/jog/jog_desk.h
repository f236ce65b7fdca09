// SPDX-License-Identifier: Apache-2.0
// Remote jogging of robots: the enabling switch of ROBOT_JOG, which is pressed as long as its client keeps renewing. It
// is released by the client, by this desk when the client does not renew in time, and by the robot task when the desk's
// heartbeat stops.

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "store/vars/store.h"
#include "tools/serve/audit.h"
#include "tools/serve/desk.h"

namespace indurop::serve {

// The motion that a client requests.
struct JogRequest {
  std::string frame;          // "axes", "base", "tool" or a work frame
  std::vector<double> speed;  // in %, of axes, or along and about x, y, z; one is not 0
};

class JogDesk {
 public:
  // A client has to renew within this time.
  static constexpr std::int64_t kKeepNs = 250'000'000;

  explicit JogDesk(const Audit& audit) : desk_(audit, "end of jog", kKeepNs) {}
  ~JogDesk();
  JogDesk(const JogDesk&) = delete;
  JogDesk& operator=(const JogDesk&) = delete;

  // Presses the switch of `robot`, the namespace of its ROBOT_JOG. Returns the name to renew it by, or why it was
  // refused.
  Result<std::string, base::Problem> begin(const std::string& board, const std::string& robot, const std::string& who,
                                           const std::string& from, const JogRequest& request);
  // Renews. Returns false if this client does not hold the switch any more.
  bool keep(const std::string& board, const std::string& name, const std::string& who);
  bool end(const std::string& board, const std::string& name, const std::string& who);
  // Releases switches whose client did not renew in time.
  void end_overdue();
  [[nodiscard]] bool busy() const noexcept { return !desk_.is_empty(); }

 private:
  // The enabling switch of one robot.
  struct Switch {
    const vars::DirectoryEntry* entry = nullptr;
    schema::Type type;
    std::uint32_t beat_offset = 0;
    std::size_t axes = 0;
  };
  // A client that presses it.
  struct Hand : HeldBase {
    std::string robot;
    vars::Store store;
    Switch place;
    std::uint32_t beat = 0;

    Hand(vars::Store opened, Switch pressed) : store(std::move(opened)), place(std::move(pressed)) {}
    void count_beat();
    // `change` writes fields into the value of the switch. Returns false if it cannot be written.
    template <class Change>
    bool write(Change change);
    void release();
  };
  static Result<Switch, base::Problem> switch_of(const vars::Store& store, const std::string& robot);

  Desk<Hand> desk_;
};

}  // namespace indurop::serve
