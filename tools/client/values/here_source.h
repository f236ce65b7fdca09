// SPDX-License-Identifier: Apache-2.0
// Values of a node of this machine, read from its shared memory.

#pragma once

#include "tools/client/values/value_source.h"

namespace indurop::tools {

class HereSource final : public ValueSource {
 public:
  HereSource(std::string node, vars::Mode mode) : node_(std::move(node)), mode_(mode) {}

  Result<vars::Store> attach() override;
  [[nodiscard]] std::uint64_t generation() const override;  // inode of the store's file, 0: there is none
  std::string absence(const vars::Store* store) override;
  [[nodiscard]] bool here() const override { return true; }
  [[nodiscard]] std::string title() const override { return node_; }
  [[nodiscard]] std::string whose() const override { return "node '" + node_ + "'"; }
  [[nodiscard]] std::string gone(const std::string& absence) const override { return whose() + " is " + absence; }
  [[nodiscard]] std::string back() const override { return whose() + " runs again"; }
  Result<void, Failure> set(vars::Store& store, const std::string& name, const vars::DirectoryEntry& entry,
                            const schema::Place& place, std::span<const std::uint8_t> bytes) override;
  // Fails: a local node has no boards to choose from.
  std::string prefer(const std::string& pattern, const std::string& board) override;
  [[nodiscard]] std::string owner(const std::string& variable) const override;
  [[nodiscard]] std::string silent_owner(const std::string& name) const override;
  std::vector<std::string> follow(const std::set<std::string>& variables) override;

 private:
  std::string node_;
  vars::Mode mode_;
  std::int64_t last_beat_ns_ = 0;
};

}  // namespace indurop::tools
