// SPDX-License-Identifier: Apache-2.0
// Robots moved by hand from afar: the enabling switch of ROBOT_JOG, pressed as long as its client says so again and
// again. Three things let it go: the client, this desk when it does not hear the client, and the robot task when it
// does not see the desk's beat.

#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.h"
#include "serve/api/audit.h"
#include "vars/store.h"

namespace indurop::serve {

// What a client wants moved.
struct JogWish {
  std::string frame;          // "axes", "base", "tool" or a work frame
  std::vector<double> speed;  // %, of axes, or along and about x, y, z; one is not 0
};

class JogDesk {
 public:
  // A client has to say so again within this time.
  static constexpr std::int64_t kKeepNs = 250'000'000;

  explicit JogDesk(const Audit& audit);
  ~JogDesk();
  JogDesk(const JogDesk&) = delete;
  JogDesk& operator=(const JogDesk&) = delete;

  // Presses the switch of `robot`, the namespace of its ROBOT_JOG. Returns the name to go on by; or why not.
  Result<std::string, base::Problem> begin(const std::string& board, const std::string& robot, const std::string& who,
                                           const std::string& from, const JogWish& wish);
  // False: that hand is not at the switch any more.
  bool keep(const std::string& board, const std::string& name, const std::string& who);
  bool end(const std::string& board, const std::string& name, const std::string& who);
  // Releases those whose client was not heard in time.
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
