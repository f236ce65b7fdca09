// SPDX-License-Identifier: Apache-2.0
// Variables of boards anywhere in the network as a store like that of a node here: a thread fills a private one with
// what the boards show (mirror/far_plane.h), so that verbs read both alike. Leaves nothing behind in /dev/shm.

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

#include "mirror/far_plane.h"
#include "tools/verb.h"
#include "vars/store.h"

namespace indurop::tools {

// A value on its way to a board.
struct FarOrder {
  std::string variable;
  std::vector<std::uint8_t> value;
  bool sent = false;
  int repeats = 0;
  std::int64_t next_ns = 0;  // to be sent then
  bool shown = false;        // the board has said something since
  std::vector<std::uint8_t> answer;
};

class FarValues {
 public:
  // Joins the network and looks who shows what, as long as `context.far` says. Null after an error message; `code` is
  // then the exit code. Boards that were not heard are named on stderr.
  static std::shared_ptr<FarValues> open(Context& context, int& code);
  FarValues(const FarValues&) = delete;
  FarValues& operator=(const FarValues&) = delete;
  ~FarValues();

  // The store of the present generation; another generation has other variables.
  Result<vars::Store> attach();
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_.load(); }
  [[nodiscard]] const std::string& title() const noexcept { return title_; }  // "plant cell", "DDS domain 0"
  // "not heard: control", empty if all boards are.
  [[nodiscard]] std::string absence() const;

  // Of variables that several boards show, those whose names match are this board's. Else why that cannot be.
  std::string prefer(const std::string& pattern, const std::string& board);
  [[nodiscard]] std::string owner(const std::string& variable) const;  // board, empty: of a program that is none
  // Reads these from now on and waits until each has a value, at most so long as it may. Returns those without.
  std::vector<std::string> follow(const std::set<std::string>& variables);
  // Sets a variable on its board and waits until the board shows what it has then. Empty: that value. Else what went
  // wrong; `timed_out`: the board did not answer.
  std::string set(const std::string& variable, std::span<const std::uint8_t> value, bool& timed_out);

 private:
  struct Known {
    schema::Variable declared;
    std::map<std::string, bool> boards;  // that show it, and whether they let it be set
    std::string owner;
    bool chosen = false;  // the owner, by the user
  };
  FarValues(std::unique_ptr<mirror::FarPlane> plane, std::int64_t wait_ns)
      : plane_(std::move(plane)), wait_ns_(wait_ns) {}
  bool gather(Context& context);
  void feed();
  void update();
  void rebuild(const std::vector<mirror::FarVariable>& variables);
  Status renew_store();
  void value_came(const std::string& variable, const std::string& board, std::span<const std::uint8_t> value);

  std::unique_ptr<mirror::FarPlane> plane_;  // the feeding thread's once it runs
  std::int64_t wait_ns_;
  std::string title_;
  std::atomic<std::uint64_t> generation_{0};

  mutable std::mutex mutex_;  // all below
  std::condition_variable news_;
  std::uint64_t plane_generation_ = 0;
  std::map<std::string, Known> variables_;
  std::vector<mirror::FarBoard> boards_;
  std::vector<std::string> hidden_;
  std::set<std::string> followed_;
  std::set<std::string> arrived_;
  std::optional<FarOrder> order_;
  std::optional<vars::Store> store_;  // filled
  std::optional<vars::Store> view_;   // not handed out yet
  std::uint64_t stores_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace indurop::tools
