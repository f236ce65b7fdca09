// SPDX-License-Identifier: Apache-2.0
// The objects of a simulated slave, and the answers to SDO requests for them.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/io/ethercat/coe.h"

namespace indurop::io::ethercat {

class ObjectDictionary {
 public:
  // Says why a master may not write a number there now, else nothing.
  using Rule = std::function<std::optional<std::uint32_t>(const ObjectDictionary& objects, std::uint16_t index,
                                                          std::uint8_t subindex, std::uint64_t number)>;

  void add(std::uint16_t index, std::uint8_t subindex, std::vector<std::uint8_t> value, bool writable = true);
  template <class T>
  void add_number(std::uint16_t index, std::uint8_t subindex, T value, bool writable = true) {
    std::vector<std::uint8_t> bytes(sizeof(T));
    store<T>(bytes, 0, value);
    add(index, subindex, std::move(bytes), writable);
  }
  // What it is called, and its type as CoE numbers them; for those that ask for a description. Only of what was added.
  void describe(std::uint16_t index, std::uint8_t subindex, std::uint8_t type, std::string name);
  struct Known {
    std::uint8_t subindex = 0;
    std::size_t bytes = 0;
    bool writable = true;
    std::uint8_t type = 0;  // 0: not described
    std::string name;
  };
  [[nodiscard]] std::vector<std::uint16_t> indices() const;
  [[nodiscard]] std::vector<Known> entries(std::uint16_t index) const;
  // The value as a number, 0 if it is not there.
  [[nodiscard]] std::uint64_t number(std::uint16_t index, std::uint8_t subindex) const;
  [[nodiscard]] bool has(std::uint16_t index) const;
  // The bytes of an object, for the device itself, until the next change; none if it is not there.
  [[nodiscard]] std::span<std::uint8_t> storage(std::uint16_t index, std::uint8_t subindex);
  [[nodiscard]] bool is_writable(std::uint16_t index, std::uint8_t subindex) const;

  // An object's value, or the reason why not. Complete: all subindices in a row, the first as 16 bits.
  std::optional<std::uint32_t> read(std::uint16_t index, std::uint8_t subindex, bool complete,
                                    std::vector<std::uint8_t>& value) const;
  // Complete: the rule sees subindex 0 become 0, the others their values, and subindex 0 the one it gets.
  std::optional<std::uint32_t> write(std::uint16_t index, std::uint8_t subindex, bool complete, Bytes value);
  void set_rule(Rule rule) { rule_ = std::move(rule); }
  // Counts what was added and what a master has written.
  [[nodiscard]] std::uint64_t changes() const noexcept { return changes_; }

 private:
  struct Object {
    std::vector<std::uint8_t> value;
    bool writable = true;
    std::uint8_t type = 0;
    std::string name;
  };
  std::optional<std::uint32_t> put(std::uint16_t index, std::uint8_t subindex, Bytes value);

  std::map<std::pair<std::uint16_t, std::uint8_t>, Object> objects_;
  Rule rule_;
  std::uint64_t changes_ = 0;
};

// Answers SDO requests one after the other, and remembers a transfer in segments. A message is what is behind the
// mailbox header.
class SdoServer {
 public:
  // `room` is the size of the mailbox that the answers go to.
  std::vector<std::uint8_t> answer(Bytes message, ObjectDictionary& objects, std::size_t room);
  void reset() noexcept { transfer_.reset(); }

  // The next request gets this abort code, or none at all (0).
  void refuse_next(std::uint32_t code) noexcept { refusal_ = code; }
  // Transfers by which objects were written since the slave was reset.
  [[nodiscard]] std::uint64_t downloads() const noexcept { return downloads_; }

 private:
  struct Transfer {
    std::uint16_t index = 0;
    std::uint8_t subindex = 0;
    bool complete = false;
    bool toggle = false;
    std::size_t done = 0;
    std::vector<std::uint8_t> value;
  };

  std::vector<std::uint8_t> download(Bytes message, ObjectDictionary& objects);
  std::vector<std::uint8_t> download_segment(Bytes message, ObjectDictionary& objects);
  std::vector<std::uint8_t> upload(Bytes message, const ObjectDictionary& objects, std::size_t room);
  std::vector<std::uint8_t> upload_segment(Bytes message, std::size_t room);
  std::vector<std::uint8_t> finish_download(const Transfer& transfer, ObjectDictionary& objects);

  std::optional<Transfer> transfer_;
  std::optional<std::uint32_t> refusal_;
  std::uint64_t downloads_ = 0;
};

}  // namespace indurop::io::ethercat
