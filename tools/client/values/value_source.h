// SPDX-License-Identifier: Apache-2.0
// The source of values: a node of this machine, or boards anywhere in the network. Independent of the command line.

#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "store/vars/store.h"
#include "tools/client/failure.h"

namespace indurop::tools {

class ValueSource {
 public:
  ValueSource() = default;
  ValueSource(const ValueSource&) = delete;
  ValueSource& operator=(const ValueSource&) = delete;
  virtual ~ValueSource() = default;

  // Returns the current store. If generation() changes afterwards, or the store has retired: attach again.
  virtual Result<vars::Store> attach() = 0;
  [[nodiscard]] virtual std::uint64_t generation() const = 0;

  // Returns why values are old: "not running, last seen 3.2 s ago", "not heard: control"; empty if they are not.
  // `store`: the one that was attached last, null if the next one could not be attached.
  virtual std::string absence(const vars::Store* store) = 0;

  [[nodiscard]] virtual bool here() const = 0;          // in memory of this machine
  [[nodiscard]] virtual std::string title() const = 0;  // for JSON: "local", "plant cell"
  [[nodiscard]] virtual std::string whose() const = 0;  // for messages: "node 'local'", "plant cell"
  [[nodiscard]] virtual std::string gone(const std::string& absence) const = 0;  // "node 'local' is not running"
  [[nodiscard]] virtual std::string back() const = 0;                            // "node 'local' runs again"

  // Writes `bytes` at `offset` of a variable of the store.
  virtual Result<void, Failure> set(vars::Store& store, const std::string& name, const vars::DirectoryEntry& entry,
                                    const schema::Place& place, std::span<const std::uint8_t> bytes) = 0;

  // NAME@BOARD: for variables that several boards show, uses this board for names that match from now on. Returns why
  // that is impossible, else an empty text.
  virtual std::string prefer(const std::string& pattern, const std::string& board) = 0;
  // Returns the board from which the variable's value comes; empty: none.
  [[nodiscard]] virtual std::string owner(const std::string& variable) const = 0;
  // Returns the board that has the variable and is not being received; empty: none is known. `name` as the user wrote
  // it, with or without its namespaces.
  [[nodiscard]] virtual std::string silent_owner(const std::string& name) const = 0;
  // Waits until each of these has a value, up to the time limit. Returns those without a value.
  virtual std::vector<std::string> follow(const std::set<std::string>& variables) = 0;
  // Returns true if the given keys do not permit reading this variable; known once it is followed.
  [[nodiscard]] virtual bool forbidden(const std::string& /*variable*/) const { return false; }
};

}  // namespace indurop::tools
