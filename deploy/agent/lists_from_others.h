// SPDX-License-Identifier: Apache-2.0
// Takes lists of the plant from other boards, so that one that was off or not reached learns of changes: asks each
// agent when it appears and all of them in turn later, for lists that are newer than the board's own, one at a time.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "core/rt/clock.h"
#include "deploy/link/deploy_link.h"
#include "deploy/link/text_pieces.h"

namespace indurop::deploy {

// A list that boards pass on. All functions get the name of the plant.
struct PassedList {
  std::string what;                                         // "a list of users"
  std::string blob;                                         // its name at other agents is this and the id
  std::function<std::string(const std::string& plant)> id;  // of the board's own
  // Judges and stores a list. Returns what was done, for people.
  std::function<Result<std::string, base::Problem>(const std::string& plant, const std::string& text)> take;
};

class ListsFromOthers {
 public:
  ListsFromOthers(std::uint64_t self, std::vector<PassedList> lists, const base::Log& log)
      : self_(self), lists_(std::move(lists)), log_(log) {}

  // Returns true if each of the agents was asked for all lists in this round and has answered, or was silent.
  [[nodiscard]] bool has_asked(const std::vector<std::uint64_t>& agents) const;
  // `agents`: of the other boards of `plant`, which this board runs.
  void step(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant, rt::MonoTime now);

 private:
  static constexpr std::size_t kLargest = 4U << 20U;  // bytes of a list

  void ask_next(DeployLink& link, const std::vector<std::uint64_t>& agents, const std::string& plant, rt::MonoTime now);
  void ask(DeployLink& link, std::uint64_t agent, std::size_t list, const std::string& plant, rt::MonoTime now);
  void request(DeployLink& link, rt::MonoTime now);
  void take(const BlobChunk& chunk, const std::string& plant);

  std::uint64_t self_;
  std::vector<PassedList> lists_;
  const base::Log& log_;
  std::set<std::pair<std::uint64_t, std::size_t>> asked_;  // agents and lists, in this round
  rt::MonoTime round_;                                     // when it began
  std::uint64_t source_ = 0;                               // the agent that is asked; 0: none
  std::size_t wanted_ = 0;                                 // for this list
  rt::MonoTime until_;                                     // until then its answer is waited for
  rt::MonoTime again_;                                     // then the request is sent again, unless pieces arrive
  std::string blob_;
  TextPieces text_{kLargest};  // of its answer
  std::string last_problem_;   // logged once
};

}  // namespace indurop::deploy
