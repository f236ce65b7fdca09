// SPDX-License-Identifier: Apache-2.0
// Random jobs against a walk through the trees they were made from, without the parser's steps and formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "job_world.h"

namespace indurop::robot {
namespace {

struct Node {
  std::function<double(std::map<std::string, double>&)> value;
  std::string text;
};
using State = std::map<std::string, double>;
struct Statement {
  std::function<void(State&, std::vector<std::pair<std::string, double>>&)> perform;
  std::string text;
};

class Generator {
 public:
  explicit Generator(unsigned seed) : random_(seed) {}

  Statement block(int depth) {
    std::vector<Statement> parts(1 + below(4));
    std::string text;
    for (Statement& part : parts) {
      part = statement(depth);
      text += part.text;
    }
    return {[parts](State& state, auto& written) {
              for (const Statement& part : parts) {
                part.perform(state, written);
              }
            },
            text};
  }

 private:
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  std::string variable() { return std::string("v") + static_cast<char>('0' + below(4)); }
  std::string shared() { return std::string("S") + static_cast<char>('0' + below(3)); }

  Node expression(int depth) {
    switch (below(depth > 0 ? 9 : 3)) {
      case 0: {
        const auto number = static_cast<double>(below(9));
        return {[number](State&) { return number; }, std::to_string(static_cast<int>(number))};
      }
      case 1: {
        const std::string name = variable();
        return {[name](State& state) { return state[name]; }, name};
      }
      case 2: {
        const std::string name = shared();
        return {[name](State& state) { return state[name]; }, name};
      }
      case 3: {
        const Node inner = expression(depth - 1);
        return {[inner](State& state) { return -inner.value(state); }, "-(" + inner.text + ")"};
      }
      case 4: {
        const Node inner = expression(depth - 1);
        return {[inner](State& state) { return inner.value(state) == 0 ? 1 : 0; }, "(NOT " + inner.text + ")"};
      }
      default:
        return binary(depth);
    }
  }

  Node binary(int depth) {
    struct Kind {
      const char* sign;
      double (*value)(double, double);
    };
    static constexpr Kind kKinds[] = {
        {"+", [](double a, double b) { return a + b; }},
        {"-", [](double a, double b) { return a - b; }},
        {"*", [](double a, double b) { return a * b; }},
        {"<", [](double a, double b) { return a < b ? 1.0 : 0.0; }},
        {">=", [](double a, double b) { return a >= b ? 1.0 : 0.0; }},
        {"=", [](double a, double b) { return a == b ? 1.0 : 0.0; }},
        {"<>", [](double a, double b) { return a != b ? 1.0 : 0.0; }},
        {"AND", [](double a, double b) { return a != 0 && b != 0 ? 1.0 : 0.0; }},
        {"OR", [](double a, double b) { return a != 0 || b != 0 ? 1.0 : 0.0; }},
    };
    const Kind& kind = kKinds[below(std::size(kKinds))];
    const Node left = expression(depth - 1);
    const Node right = expression(depth - 1);
    return {[kind, left, right](State& state) { return kind.value(left.value(state), right.value(state)); },
            "(" + left.text + " " + kind.sign + " " + right.text + ")"};
  }

  // Kept small, so that values stay whole and both sides mean the same by them.
  Node small() {
    const Node inner = expression(2);
    return {[inner](State& state) { return std::fmod(inner.value(state), 100); }, "(" + inner.text + ") MOD 100"};
  }

  Statement statement(int depth) {
    switch (below(depth > 0 ? 6 : 2)) {
      case 0: {
        const std::string name = variable();
        const Node value = small();
        return {[name, value](State& state, auto&) { state[name] = value.value(state); },
                name + " = " + value.text + "\n"};
      }
      case 1: {
        const std::string name = shared();
        const Node value = small();
        return {[name, value](State& state, auto& written) {
                  state[name] = value.value(state);
                  written.emplace_back(name, state[name]);
                },
                "SET " + name + " = " + value.text + "\n"};
      }
      case 2:
        return choice(depth);
      case 3:
        return counted(depth);
      case 4: {
        const Statement body = block(depth - 1);
        const auto times = 1 + below(3);
        return {[body, times](State& state, auto& written) {
                  for (std::size_t i = 0; i < times; ++i) {
                    body.perform(state, written);
                  }
                },
                "LOOP " + std::to_string(times) + "\n" + body.text + "END\n"};
      }
      default:
        return repeated(depth);
    }
  }

  Statement choice(int depth) {
    const Node first = expression(2);
    const Node second = expression(2);
    const Statement a = block(depth - 1);
    const Statement b = block(depth - 1);
    const Statement c = block(depth - 1);
    return {[=](State& state, auto& written) {
              if (first.value(state) != 0) {
                a.perform(state, written);
              } else if (second.value(state) != 0) {
                b.perform(state, written);
              } else {
                c.perform(state, written);
              }
            },
            "IF " + first.text + "\n" + a.text + "ELSEIF " + second.text + "\n" + b.text + "ELSE\n" + c.text + "END\n"};
  }

  // A variable of its own each, which nothing in between changes.
  Statement counted(int depth) {
    const std::string name = "c" + std::to_string(counters_++);
    const auto first = static_cast<int>(below(5)) - 2;
    const auto last = static_cast<int>(below(5)) - 2;
    const int by = below(2) == 0 ? 1 : -2;
    const Statement body = block(depth - 1);
    return {[=](State& state, auto& written) {
              for (int i = first; by > 0 ? i <= last : i >= last; i += by) {
                body.perform(state, written);
              }
            },
            "FOR " + name + " = " + std::to_string(first) + " TO " + std::to_string(last) +
                (by == 1 ? "" : " STEP " + std::to_string(by)) + "\n" + body.text + "END\n"};
  }

  Statement repeated(int depth) {
    const std::string name = "c" + std::to_string(counters_++);
    const auto times = below(4);
    const Statement body = block(depth - 1);
    return {[=](State& state, auto& written) {
              for (std::size_t i = 0; i < times; ++i) {
                body.perform(state, written);
              }
            },
            "VAR " + name + " = " + std::to_string(times) + "\nWHILE " + name + " > 0\n" + body.text + name + " = " +
                name + " - 1\nEND\n"};
  }

  std::mt19937 random_;
  int counters_ = 0;
};

TEST(JobPrograms, Random_ones_write_what_a_walk_through_their_tree_writes) {
  int compared = 0;
  for (unsigned seed = 0; compared < 400; ++seed) {
    Generator generator(seed);
    const Statement program = generator.block(3);
    const auto [book, errors] = parse_jobs({{"a.job", "VAR v0\nVAR v1\nVAR v2\nVAR v3\n" + program.text}});
    if (base::to_text(errors).find("variables; split the job") != std::string::npos) {
      continue;  // too many counters
    }
    ASSERT_TRUE(errors.empty()) << base::to_text(errors) << program.text;
    World world(book.signals);
    ASSERT_EQ(run(book, world, 1'000'000).state, JobState::Ended) << program.text;
    State state;
    std::vector<std::pair<std::string, double>> wanted;
    program.perform(state, wanted);
    ASSERT_EQ(world.written, wanted) << "seed " << seed << "\n" << program.text;
    ++compared;
  }
}

}  // namespace
}  // namespace indurop::robot
