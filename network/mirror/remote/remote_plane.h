// SPDX-License-Identifier: Apache-2.0
// The external planes of all boards as a tool sees them from anywhere in the network, without a local node or a types
// library. Boards announce their variables (external_directory.h); for programs that are no boards the types come from
// the network. Used by one thread. No DDS in this header.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/rt/clock.h"
#include "core/schema/schema.h"
#include "network/dds/network_settings.h"

namespace indurop::mirror {

struct RemoteBoard {
  std::string name;
  std::string plant;   // empty: a single node without a plant
  bool heard = false;  // false: named by another board of its plant, or seen earlier
};

struct RemoteVariable {
  schema::Variable declared;
  std::string board;  // empty: of a program that is no board
  bool writable = false;
};

class RemotePlane {
 public:
  struct Opened {
    std::unique_ptr<RemotePlane> plane;
    std::string note;  // a note for the user, or empty
  };
  // Errors: the network is not available now.
  static Result<Opened, base::Problem> open(const dds::NetworkSettings& settings);
  RemotePlane(const RemotePlane&) = delete;
  RemotePlane& operator=(const RemotePlane&) = delete;
  ~RemotePlane();

  // Waits for news until `deadline` and processes them.
  void poll(rt::MonoTime deadline);

  [[nodiscard]] std::vector<RemoteBoard> boards() const;        // by name
  [[nodiscard]] std::vector<RemoteVariable> variables() const;  // by name and board
  [[nodiscard]] std::uint64_t generation() const noexcept;      // changes when the variables change
  // Maps variables to their board, for boards that are not received, as far as other boards read them.
  [[nodiscard]] std::map<std::string, std::string> silent_variables() const;
  // Returns whether all discovered participants have announced their variables, and all known boards are present.
  [[nodiscard]] bool complete() const;
  // Returns the topics that exist but cannot be shown, with the reason.
  [[nodiscard]] std::vector<std::string> hidden() const;

  // Reads this variable from now on; repeated calls are harmless. An empty board: of a program that is no board.
  void follow(const std::string& variable, const std::string& board);
  // Returns whether this participant's keys forbid to read or set a followed variable, as far as that was tried.
  [[nodiscard]] bool may_not_read(const std::string& variable) const;
  [[nodiscard]] bool may_not_set(const std::string& variable) const;
  // To be called when a followed variable has changed its type.
  void reopen(const std::string& variable);
  // Passes on the values received since the last call.
  using Use = std::function<void(const std::string& variable, const std::string& board, std::span<const std::uint8_t>)>;
  void take(const Use& use);
  // Sends a value to the board. Returns false while the board has no reader (yet).
  bool send(const std::string& variable, const std::string& board, std::span<const std::uint8_t> value);

 private:
  struct Impl;
  explicit RemotePlane(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::mirror
