// SPDX-License-Identifier: Apache-2.0
// The external planes of all boards as a tool sees them from anywhere in the network: no node here, no types library.
// Boards tell what they show (external_directory.h); of programs that are no boards the types on the network tell it.
// One thread uses it. No DDS in this header.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "schema/schema.h"

namespace indurop::mirror {

struct FarSettings {
  int domain = 0;
  std::string interface_name;      // empty: the first that is up
  std::vector<std::string> peers;  // looked for there as well, for networks without multicast
  bool one_host = false;           // loopback only
};

struct FarBoard {
  std::string name;
  std::string plant;   // empty: a node of its own
  bool heard = false;  // false: another board of its plant names it, or it was there before
};

struct FarVariable {
  schema::Variable declared;
  std::string board;  // empty: of a program that is no board
  bool writable = false;
};

class FarPlane {
 public:
  // Null, and `problem` says why, if the network cannot be had now. Else `problem` may hold something to be told.
  static std::unique_ptr<FarPlane> open(const FarSettings& settings, std::string& problem);
  FarPlane(const FarPlane&) = delete;
  FarPlane& operator=(const FarPlane&) = delete;
  ~FarPlane();

  // Waits for news until CLOCK_MONOTONIC `deadline_ns` and takes them.
  void look(std::int64_t deadline_ns);

  [[nodiscard]] std::vector<FarBoard> boards() const;        // by name
  [[nodiscard]] std::vector<FarVariable> variables() const;  // by name and board
  [[nodiscard]] std::uint64_t generation() const noexcept;   // another one: other variables
  // Everybody who was seen has told what he shows, and all boards that are known of are there.
  [[nodiscard]] bool complete() const;
  // Topics that are there and cannot be shown, with the reason.
  [[nodiscard]] std::vector<std::string> hidden() const;

  // Reads this variable from now on; again and again without harm. An empty board: of a program that is none.
  void follow(const std::string& variable, const std::string& board);
  // What is followed has another type now.
  void reopen(const std::string& variable);
  // Hands over the values that have come since.
  using Use = std::function<void(const std::string& variable, const std::string& board, std::span<const std::uint8_t>)>;
  void take(const Use& use);
  // Sends a value to the board. False while it does not listen (yet).
  bool send(const std::string& variable, const std::string& board, std::span<const std::uint8_t> value);

 private:
  struct Impl;
  explicit FarPlane(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::mirror
