// SPDX-License-Identifier: Apache-2.0
// Variables of boards anywhere in the network as a store like that of a node here: a thread fills a private one with
// what the boards show (mirror/remote/remote_plane.h), so that verbs read both alike. Leaves nothing behind in
// /dev/shm.

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

#include "mirror/remote/remote_plane.h"
#include "tools/values/value_source.h"

namespace indurop::tools {

// A value on its way to a board.
struct RemoteOrder {
  std::string variable;
  std::vector<std::uint8_t> value;
  bool sent = false;
  int repeats = 0;
  std::int64_t next_ns = 0;  // to be sent then
  bool shown = false;        // the board has said something since
  bool forbidden = false;    // by the keys that were given
  std::vector<std::uint8_t> answer;
};

class RemoteSource final : public ValueSource {
 public:
  // Joins the network and looks who shows what, at most so long; less if all boards were heard, or, should boards be
  // silent, once `names` are known. `notes` are for people: boards that were not heard.
  static Result<std::unique_ptr<RemoteSource>, Failure> open(const dds::NetworkSettings& network, std::int64_t wait_ns,
                                                             const std::vector<std::string>& names,
                                                             std::vector<std::string>& notes);
  ~RemoteSource() override;

  Result<vars::Store> attach() override;
  [[nodiscard]] std::uint64_t generation() const override { return generation_.load(); }
  std::string absence(const vars::Store* store) override;  // "not heard: control", empty if all boards are
  [[nodiscard]] bool here() const override { return false; }
  [[nodiscard]] std::string title() const override { return title_; }  // "plant cell", "DDS domain 0"
  [[nodiscard]] std::string whose() const override { return title_; }
  [[nodiscard]] std::string gone(const std::string& absence) const override { return title_ + ": " + absence; }
  [[nodiscard]] std::string back() const override { return title_ + ": all boards are heard again"; }
  // Boards take whole variables. Waits until the board shows what it has then.
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
    std::map<std::string, bool> boards;  // that show it, and whether they let it be set
    std::string owner;
    bool chosen = false;  // the owner, by the user
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

  std::unique_ptr<mirror::RemotePlane> plane_;  // the feeding thread's once it runs
  std::int64_t wait_ns_;
  std::string title_;
  std::atomic<std::uint64_t> generation_{0};
  std::map<std::string, std::string> silent_;  // variable -> board that was not heard when it was opened

  mutable std::mutex mutex_;  // all below
  std::condition_variable news_;
  std::uint64_t plane_generation_ = 0;
  std::map<std::string, Known> variables_;
  std::vector<mirror::RemoteBoard> boards_;
  std::vector<std::string> hidden_;
  std::set<std::string> followed_;
  std::set<std::string> arrived_;
  std::set<std::string> forbidden_;
  std::optional<RemoteOrder> order_;
  std::optional<vars::Store> store_;  // filled
  std::optional<vars::Store> view_;   // not handed out yet
  std::uint64_t stores_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace indurop::tools
