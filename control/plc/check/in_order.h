// SPDX-License-Identifier: Apache-2.0
// Visits declarations, each after those it needs. Not recursive: thousands of them may depend on each other.

#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace indurop::plc {

template <class T>
class InOrder {
 public:
  // A declaration that waits for those it needs.
  struct Open {
    T* one = nullptr;
    std::vector<T*> needed;
    std::size_t next = 0;
  };

  // `needs(one)` returns those that come before `one`; `circle(one)` is called for one that needs itself, and `one`
  // continues without that dependency; `done(one, needed)` is called when all before it are done.
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

  // The chain of waiting declarations: each is needed by the previous one.
  [[nodiscard]] const std::vector<Open>& open() const noexcept { return open_; }
  // For `circle`: ends the innermost; it is started again when it is needed.
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
  std::set<const T*> waiting_;  // the elements of `open_`
  std::set<const T*> known_;    // done or open
};

}  // namespace indurop::plc
