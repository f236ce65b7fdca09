// SPDX-License-Identifier: Apache-2.0
// Gets what a board lacks of a deployment, file after file, from a deployer or another board. What is here already is
// not fetched again; a file that was cut off goes on where it ended.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "deploy/blob_fetch.h"
#include "deploy/digest.h"
#include "mirror/deploy_link.h"
#include "node/agent_state.h"

namespace indurop::node {

class Fetcher {
 public:
  // Of a deployment that does not have `board` nothing but the package is fetched.
  Fetcher(AgentState& state, std::uint64_t self, std::string board)
      : state_(state), self_(self), board_(std::move(board)) {}
  Fetcher(const Fetcher&) = delete;
  Fetcher& operator=(const Fetcher&) = delete;
  ~Fetcher();

  // `size`: of the package's text.
  void begin(std::uint64_t source, const std::string& id, std::uint64_t size);
  void cancel();
  enum class Result { Working, Done, Failed };
  // Takes what has come and asks for more.
  Result step(mirror::DeployLink& link, std::int64_t now_ns);

  [[nodiscard]] bool active() const noexcept { return active_; }
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  [[nodiscard]] std::uint32_t files() const noexcept { return files_; }
  [[nodiscard]] std::uint32_t files_done() const noexcept { return files_done_; }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::uint64_t bytes_done() const noexcept;

 private:
  struct Wanted {
    std::string digest;
    std::uint64_t size = 0;
    std::string name;  // for people
  };
  bool open_next();
  bool open_part(const Wanted& wanted);
  bool take(const deploy::BlobChunk& chunk, std::int64_t now_ns);
  bool finish_part();
  bool plan_files();
  bool fail(const std::string& problem);
  void close_part();

  AgentState& state_;
  std::uint64_t self_;
  std::string board_;
  std::uint64_t source_ = 0;
  std::string id_;
  bool active_ = false;
  bool planned_ = false;  // the package is here, wanted_ are its files
  bool again_ = false;    // the part was damaged once already
  std::vector<Wanted> wanted_;
  std::size_t at_ = 0;
  std::uint64_t room_ = 0;  // for what is under way
  int part_ = -1;
  std::optional<deploy::BlobFetch> blob_;
  std::optional<deploy::Digest> digest_;
  std::string problem_;
  std::uint32_t files_ = 0;
  std::uint32_t files_done_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t bytes_done_ = 0;  // of whole files
};

}  // namespace indurop::node
