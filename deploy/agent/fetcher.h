// SPDX-License-Identifier: Apache-2.0
// Fetches the files of a deployment that a board lacks, one after the other, from a deployer or another board. Files
// that are stored already and match their digest are not fetched again; an interrupted file is continued where it
// ended.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/keys/digest.h"
#include "core/rt/clock.h"
#include "deploy/agent/agent_state.h"
#include "deploy/link/deploy_link.h"
#include "deploy/transaction/blob_fetch.h"

namespace indurop::deploy {

class Fetcher {
 public:
  // If a deployment of a plant does not include `board`, only its package is fetched.
  Fetcher(AgentState& state, std::uint64_t self, std::string board)
      : state_(state), self_(self), board_(std::move(board)) {}
  Fetcher(const Fetcher&) = delete;
  Fetcher& operator=(const Fetcher&) = delete;
  ~Fetcher();

  // `sources`: sessions that may have its files, at least one; the next is asked if one does not have a file, or is
  // silent. `size`: of the package's text.
  void begin(std::vector<std::uint64_t> sources, const std::string& id, std::uint64_t size);
  struct Wanted {
    std::string digest;
    std::uint64_t size = 0;
    std::string name;  // for people
  };
  // Fetches one file that belongs to no deployment.
  void begin_file(std::uint64_t source, Wanted file);
  void cancel();
  enum class State { Working, Done, Failed };
  // Processes what has arrived and requests more. Failed: problem() returns why.
  State step(DeployLink& link, rt::MonoTime now);

  [[nodiscard]] bool active() const noexcept { return active_; }
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  [[nodiscard]] FetchProgress progress() const noexcept;

 private:
  using Attempt = Result<void, base::Problem>;
  void begin_with(std::vector<std::uint64_t> sources, const std::string& id);
  Attempt advance(DeployLink& link, rt::MonoTime now);
  Attempt open_next();
  Attempt open_part(const Wanted& wanted);
  Attempt take(const BlobChunk& chunk, rt::MonoTime now);
  Attempt finish_part();
  Attempt next_source();
  void ask_another();
  Attempt plan_files();
  void close_part();

  AgentState& state_;
  std::uint64_t self_;
  std::string board_;
  std::vector<std::uint64_t> sources_;
  std::size_t source_ = 0;         // index of the source in use
  std::set<std::size_t> without_;  // sources without the file that is fetched now
  rt::MonoTime last_progress_;     // when something arrived, or another source was asked
  std::string id_;
  bool active_ = false;
  bool planned_ = false;  // the package is complete, wanted_ are its files
  bool again_ = false;    // the part was damaged once before
  std::vector<Wanted> wanted_;
  std::size_t at_ = 0;
  std::uint64_t room_ = 0;  // bytes that may be under way
  int part_ = -1;
  std::optional<deploy::BlobFetch> blob_;
  std::optional<keys::Digest> digest_;
  std::string problem_;
  FetchProgress progress_;  // complete files
};

}  // namespace indurop::deploy
