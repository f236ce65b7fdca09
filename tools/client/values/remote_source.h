// SPDX-License-Identifier: Apache-2.0
// Variables of boards anywhere in the network as a store like that of a local node: a thread writes a private store
// with what the boards show (network/mirror/remote/remote_plane.h), so that verbs read both in the same way. Leaves
// nothing in /dev/shm.

#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "network/mirror/remote/remote_plane.h"
#include "tools/client/values/value_source.h"

namespace indurop::tools {

// A value being sent to a board.
struct RemoteOrder {
  std::string variable;
  std::vector<std::uint8_t> value;
  bool sent = false;
  int repeats = 0;
  std::int64_t next_ns = 0;  // time to send it next
  bool shown = false;        // the board has reported its value since
  bool forbidden = false;    // by the given keys
  std::vector<std::uint8_t> answer;
};

class RemoteSource final : public ValueSource {
 public:
  // Joins the network and discovers the boards' variables for at most `wait_ns`; less if all boards were discovered,
  // or, even if boards are silent, once `names` are known. `notes` are messages for people: boards that were not
  // discovered.
  static Result<std::unique_ptr<RemoteSource>, Failure> open(const dds::NetworkSettings& network, std::int64_t wait_ns,
                                                             const std::vector<std::string>& names,
                                                             std::vector<std::string>& notes);
  ~RemoteSource() override;

  Result<vars::Store> attach() override;
  [[nodiscard]] std::uint64_t generation() const override { return generation_.load(); }
  std::string absence(const vars::Store* store) override;  // "not heard: control", empty if all boards are received
  [[nodiscard]] bool here() const override { return false; }
  [[nodiscard]] std::string title() const override { return title_; }  // "plant cell", "DDS domain 0"
  [[nodiscard]] std::string whose() const override { return title_; }
  [[nodiscard]] std::string gone(const std::string& absence) const override { return title_ + ": " + absence; }
  [[nodiscard]] std::string back() const override { return title_ + ": all boards are heard again"; }
  // Boards accept whole variables only. Waits until the board shows the value that it has then.
  Result<void, Failure> set(vars::Store& store, const std::string& name, const vars::DirectoryEntry& entry,
                            const schema::Place& place, std::span<const std::uint8_t> bytes) override;
  std::string prefer(const std::string& pattern, const std::string& board) override;
  [[nodiscard]] std::string owner(const std::string& variable) const override;
  [[nodiscard]] std::string silent_owner(const std::string& name) const override;
  std::vector<std::string> follow(const std::set<std::string>& variables) override;
  [[nodiscard]] bool forbidden(const std::string& variable) const override;

 private:
  struct Known {
    schema::Variable declared;
    std::map<std::string, bool> boards;  // boards that show it, and whether they allow it to be set
    std::string owner;
    bool chosen = false;  // the user chose the owner
  };
  RemoteSource(std::unique_ptr<mirror::RemotePlane> plane, std::int64_t wait_ns)
      : plane_(std::move(plane)), wait_ns_(wait_ns) {}
  Result<void, Failure> gather(const dds::NetworkSettings& network, const std::vector<std::string>& names,
                               std::vector<std::string>& notes);
  [[nodiscard]] bool knows(const std::vector<std::string>& names) const;
  Result<void, Failure> set_whole(const std::string& variable, std::span<const std::uint8_t> value);
  void feed();
  void update();
  void rebuild(const std::vector<mirror::RemoteVariable>& variables);
  Status renew_store();
  void value_came(const std::string& variable, const std::string& board, std::span<const std::uint8_t> value);

  std::unique_ptr<mirror::RemotePlane> plane_;  // used only by the thread that writes, once it runs
  std::int64_t wait_ns_;
  std::string title_;
  std::atomic<std::uint64_t> generation_{0};
  std::map<std::string, std::string> silent_;  // variable -> board that was not discovered when it was opened

  mutable std::mutex mutex_;  // protects all members below
  std::condition_variable news_;
  std::uint64_t plane_generation_ = 0;
  std::map<std::string, Known> variables_;
  std::vector<mirror::RemoteBoard> boards_;
  std::vector<std::string> hidden_;
  std::set<std::string> followed_;
  std::set<std::string> arrived_;
  std::set<std::string> forbidden_;
  std::optional<RemoteOrder> order_;
  std::optional<vars::Store> store_;  // the one that is written
  std::optional<vars::Store> view_;   // not returned by attach() yet
  std::uint64_t stores_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace indurop::tools
