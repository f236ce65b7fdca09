// SPDX-License-Identifier: Apache-2.0
// The keyframes of a node that were read and wait for the runs that begin with them.

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "store/tape/keyframes.h"

namespace indurop::recorder {

class KeyframeQueue {
 public:
  // Reads what is there, before runs are read: a run that is seen afterwards may begin with it. `wanted`: modules whose
  // keyframes are of use. The node is asked once whether it has keyframes, when its first run is on the tape.
  // `modules`: those of the tape; a process among them has keyframes from its start on.
  void read(const std::string& node, const tape::TapeHeader& tape, const std::vector<std::uint32_t>& modules,
            const std::function<bool(std::uint32_t)>& wanted);

  // Returns the keyframe that a run of the module begins with; null: there is none. Those of earlier runs are dropped.
  const tape::Keyframe* of(std::uint32_t module, std::uint64_t run);
  // The channel of the module's keyframes, as they are now, in the file that is being written; 0: none yet.
  std::uint16_t& channel(std::uint32_t module) {
    Waiting& waiting = waiting_.at(module);
    return waiting.channels[waiting.form];
  }
  // What the bytes of its keyframes are.
  [[nodiscard]] const std::string& form(std::uint32_t module) const;
  void begin_file();

 private:
  struct Waiting {
    std::shared_ptr<tape::KeyframeFollower> follower;
    std::size_t index = 0;  // in the follower
    std::string form;
    std::map<std::string, std::uint16_t> channels;  // by form; 0: none yet
    std::deque<tape::Keyframe> keyframes;
  };
  void follow(const std::shared_ptr<tape::KeyframeFollower>& follower,
              const std::function<bool(std::uint32_t)>& wanted);
  bool sought_ = false;
  std::map<std::uint32_t, Waiting> waiting_;  // by module
};

}  // namespace indurop::recorder
