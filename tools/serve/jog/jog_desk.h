// SPDX-License-Identifier: Apache-2.0
// Remote jogging of robots: the enabling switch of ROBOT_JOG, which is pressed as long as its client keeps renewing. It
// is released by the client, by this desk when the client does not renew in time, and by the robot task when the desk's
// heartbeat stops.

#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "store/vars/store.h"
#include "tools/serve/api/audit.h"

namespace indurop::serve {

// The motion that a client requests.
struct JogWish {
  std::string frame;          // "axes", "base", "tool" or a work frame
  std::vector<double> speed;  // in %, of axes, or along and about x, y, z; one is not 0
};

class JogDesk {
 public:
  // A client has to renew within this time.
  static constexpr std::int64_t kKeepNs = 250'000'000;

  explicit JogDesk(const Audit& audit);
  ~JogDesk();
  JogDesk(const JogDesk&) = delete;
  JogDesk& operator=(const JogDesk&) = delete;

  // Presses the switch of `robot`, the namespace of its ROBOT_JOG. Returns the name to renew it by, or why it was
  // refused.
  Result<std::string, base::Problem> begin(const std::string& board, const std::string& robot, const std::string& who,
                                           const std::string& from, const JogWish& wish);
  // Renews. Returns false if this client does not hold the switch any more.
  bool keep(const std::string& board, const std::string& name, const std::string& who);
  bool end(const std::string& board, const std::string& name, const std::string& who);
  // Releases switches whose client did not renew in time.
  void look();
  [[nodiscard]] bool busy() const noexcept { return hands_.load() > 0; }

 private:
  struct Hand;
  void release(Hand& hand, const char* outcome);

  const Audit* audit_;
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<Hand>> all_;
  std::atomic<std::size_t> hands_ = 0;
};

}  // namespace indurop::serve
