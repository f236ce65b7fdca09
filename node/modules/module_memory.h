// SPDX-License-Identifier: Apache-2.0
// What a loaded thread module keeps from one run to the next, as it declares it (<indurop/state.h>): copied to bytes
// and put back from bytes, by name and type. Not real-time safe.

#pragma once

#include <indurop/state.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "node/modules/relocation.h"

namespace indurop::node {

class ModuleMemory {
 public:
  ModuleMemory() = default;
  explicit ModuleMemory(const StateDescriptor& declared);

  // Returns true if all that the module keeps can be taken.
  [[nodiscard]] bool is_whole() const noexcept { return most_ > 0 && missing_.empty(); }
  // Returns true if the module says that it keeps nothing.
  [[nodiscard]] bool is_empty() const noexcept { return declared_ && most_ == 0 && missing_.empty(); }
  // What the module itself says cannot be taken; empty: nothing.
  [[nodiscard]] const std::string& missing() const noexcept { return missing_; }
  [[nodiscard]] std::uint64_t most() const noexcept { return most_; }
  // A line for each item, "name, tab, type, tab, bytes": what the bytes of a keyframe are. If any is an address, the
  // place of each item follows.
  [[nodiscard]] const std::string& form() const noexcept { return form_; }

  // Address: points into what is kept. Place: names an item that others point into, and has no bytes of its own. Shown:
  // only tools read it.
  enum class Kind { Value, Address, Place, Shown };
  [[nodiscard]] static Kind kind_of(std::string_view type) noexcept;
  // One variable that is kept.
  struct Item {
    std::string name;
    std::string type;
    void* address = nullptr;
    std::size_t size = 0;
    Kind kind = Kind::Value;
    [[nodiscard]] std::size_t bytes() const noexcept { return kind == Kind::Place ? 0 : size; }
  };
  [[nodiscard]] const std::vector<Item>& items() const noexcept { return items_; }
  // Returns true if functions of the module copy what it keeps, or a part of it.
  [[nodiscard]] bool uses_functions() const noexcept {
    return functions_.save != nullptr && functions_.restore != nullptr;
  }

  // Returns true if some of it are addresses, which restore() leads to where the items are now.
  [[nodiscard]] bool has_addresses() const noexcept { return has_addresses_; }

  // Copies the state; a run of the module may change it meanwhile. Returns the bytes written, 0: it cannot be taken
  // now.
  std::size_t save(std::span<std::byte> to) const;

  // Names of items that lead to what is not kept, for people: while there are any, save() returns 0. A run of the
  // module may change them meanwhile.
  [[nodiscard]] std::string astray() const;

  // What an address leads to, for people: "motor.speed", "motor + 8 bytes", "nothing", "what is not kept".
  [[nodiscard]] std::string led_to(const Item& item) const;

  // Puts bytes of this form back. Returns the names of items that differ: kept in the bytes and unknown here, of
  // another type, or new here; not of those that are only shown. Items of the same name and type are put back whatever
  // the others are, also those of arrays that have more elements here.
  [[nodiscard]] std::vector<std::string> restore(std::string_view form, std::span<const std::uint8_t> bytes) const;

 private:
  struct Old;  // an item in the bytes of a keyframe
  void add(const StateItem& item);
  [[nodiscard]] const Item* find(const Old& old) const noexcept;
  [[nodiscard]] std::vector<std::string> restore(std::span<const Old> all, std::span<const std::uint8_t> places) const;
  static bool lead(const Item& item, const Relocation& moved);
  [[nodiscard]] bool is_astray(const Item& item, const std::byte* bytes) const noexcept;

  bool declared_ = false;
  std::vector<Item> items_;
  bool has_addresses_ = false;
  Relocation here_;  // all items where they are
  StateDescriptor functions_;
  std::uint64_t most_ = 0;
  std::string form_;
  std::string missing_;
};

}  // namespace indurop::node
