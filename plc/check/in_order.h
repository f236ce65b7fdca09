// SPDX-License-Identifier: Apache-2.0
// Goes through declarations, each after those it needs. No recursion: thousands of them may need each other.

#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace indurop::plc {

template <class T>
class InOrder {
 public:
  // One that waits for those it needs.
  struct Open {
    T* one = nullptr;
    std::vector<T*> needed;
    std::size_t next = 0;
  };

  // `needs(one)` are those before `one`, `circle(one)` is called for one that is needed by itself, which goes on
  // without it, and `done(one, needed)` when all before it are done.
  template <class All, class Needs, class Circle, class Done>
  void run(All& all, const Needs& needs, const Circle& circle, const Done& done) {
    for (T& first : all) {
      begin(first, needs);
      while (!open_.empty()) {
        if (Open& top = open_.back(); top.next == top.needed.size()) {
          done(*top.one, top.needed);
          end();
        } else if (T& next = *top.needed[top.next++]; waiting_.contains(&next)) {
          circle(next);
        } else {
          begin(next, needs);
        }
      }
    }
  }

  // Each is needed by the one before it.
  [[nodiscard]] const std::vector<Open>& open() const noexcept { return open_; }
  // For `circle`: the innermost is done, or is begun again when it is needed.
  void end() {
    waiting_.erase(open_.back().one);
    open_.pop_back();
  }
  void put_off() {
    known_.erase(open_.back().one);
    end();
  }

 private:
  template <class Needs>
  void begin(T& one, const Needs& needs) {
    if (known_.insert(&one).second) {
      waiting_.insert(&one);
      open_.push_back({&one, needs(one), 0});
    }
  }

  std::vector<Open> open_;
  std::set<const T*> waiting_;  // those in `open_`
  std::set<const T*> known_;    // done, or open
};

}  // namespace indurop::plc
