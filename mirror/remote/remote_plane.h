// SPDX-License-Identifier: Apache-2.0
// The external planes of all boards as a tool sees them from anywhere in the network: no node here, no types library.
// Boards tell what they show (external_directory.h); of programs that are no boards the types on the network tell it.
// One thread uses it. No DDS in this header.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/problem.h"
#include "dds/network_settings.h"
#include "rt/clock.h"
#include "schema/schema.h"

namespace indurop::mirror {

struct RemoteBoard {
  std::string name;
  std::string plant;   // empty: a node of its own
  bool heard = false;  // false: another board of its plant names it, or it was there before
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
    std::string note;  // something the user should know, or empty
  };
  // Errors: the network cannot be had now.
  static Result<Opened, base::Problem> open(const dds::NetworkSettings& settings);
  RemotePlane(const RemotePlane&) = delete;
  RemotePlane& operator=(const RemotePlane&) = delete;
  ~RemotePlane();

  // Waits for news until `deadline` and takes them.
  void look(rt::MonoTime deadline);

  [[nodiscard]] std::vector<RemoteBoard> boards() const;        // by name
  [[nodiscard]] std::vector<RemoteVariable> variables() const;  // by name and board
  [[nodiscard]] std::uint64_t generation() const noexcept;      // another one: other variables
  // Variable -> its board, of boards that are not heard, as far as others read it from them.
  [[nodiscard]] std::map<std::string, std::string> silent_variables() const;
  // Everybody who was seen has told what he shows, and all boards that are known of are there.
  [[nodiscard]] bool complete() const;
  // Topics that are there and cannot be shown, with the reason.
  [[nodiscard]] std::vector<std::string> hidden() const;

  // Reads this variable from now on; again and again without harm. An empty board: of a program that is none.
  void follow(const std::string& variable, const std::string& board);
  // Whether the keys of this participant forbid to read or to set what is followed, as far as that was tried.
  [[nodiscard]] bool may_not_read(const std::string& variable) const;
  [[nodiscard]] bool may_not_set(const std::string& variable) const;
  // What is followed has another type now.
  void reopen(const std::string& variable);
  // Hands over the values that have come since.
  using Use = std::function<void(const std::string& variable, const std::string& board, std::span<const std::uint8_t>)>;
  void take(const Use& use);
  // Sends a value to the board. False while it does not listen (yet).
  bool send(const std::string& variable, const std::string& board, std::span<const std::uint8_t> value);

 private:
  struct Impl;
  explicit RemotePlane(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::mirror
