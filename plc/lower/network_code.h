// SPDX-License-Identifier: Apache-2.0
// What the translation of networks has at hand: the statements so far, values at outputs of elements, hidden variables.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "plc/lower/derived_power.h"
#include "plc/lower/networks.h"

namespace indurop::plc::lower {

// A value, and the BOOL without which it is not taken: behind a function with EN. Empty: always.
struct Value {
  ast::Expression expression;
  std::string guard;
};

// What the variables of an element are called after it: its number and what is written in it, "5_start".
[[nodiscard]] std::string key_of(const Element& element);

class NetworkCode {
 public:
  NetworkCode(const Sheet& sheet, const NetworkOptions& options, Diagnostics& diagnostics)
      : sheet_(sheet), options_(options), diagnostics_(diagnostics) {
    if (options.flow) {
      derived_ = derived_power(sheet);
    }
  }

  void add(ast::Statement statement) { lowered_.body.push_back(std::move(statement)); }
  // Structured Text written at an element.
  [[nodiscard]] std::optional<ast::Expression> parse(std::string_view text, const Place& at);

  // What comes into a pin: the value of its source, or of any of them where branches meet; negated, or its edge, as
  // the pin says.
  [[nodiscard]] ast::Expression input(const Element& element, const Pin& pin);
  // With the guard of a function's result, to be stored.
  [[nodiscard]] Value input_value(const Element& element, const Pin& pin, bool guarded = true);

  // What is at an output of an element that was evaluated.
  [[nodiscard]] Value output_value(const Element& element, const Pin& pin);

  // Remembers what is at an output.
  void define(const Element& element, const Pin* pin, ast::Expression value, std::string guard = {});
  // A function's result: written where it is used once, else kept in a variable of the scan.
  void defer(const Element& element, const Pin& pin, ast::Expression value, std::string guard);

  // Keeps `value` in the variable of the power behind the element, which is told unless a view can derive it.
  [[nodiscard]] ast::Expression power(const Element& element, ast::Expression value);
  // True in the scan in which `value` changes so. `key` distinguishes the places of a body.
  [[nodiscard]] ast::Expression edge(ast::Expression value, ast::Edge edge, const std::string& key);
  void store(ast::Expression target, Value value, Storage storage, bool negated);

  // A variable that lives for one scan. The same name is declared once.
  std::string temporary(std::string_view letter, const std::string& key, ast::TypeSpec type);

  // Between two networks.
  void end_network();
  // What a running view shows.
  void show(FlowPoint::Kind kind, const Source& source, ast::Expression value, Elementary type = Elementary::Bool);

  [[nodiscard]] const Sheet& sheet() const noexcept { return sheet_; }
  [[nodiscard]] Diagnostics& diagnostics() noexcept { return diagnostics_; }
  [[nodiscard]] LoweredNetworks finish();

 private:
  using Key = std::pair<const Element*, const Pin*>;
  struct Output {
    Value value;
    bool deferred = false;
    std::size_t written = 0;  // how many statements there were
  };

  [[nodiscard]] Value value_of(const Connection& connection, bool guarded);
  [[nodiscard]] Value read(const Source& source, const Place& at, bool guarded);
  [[nodiscard]] Value kept(const Source& source, const Place& at);
  void keep(const Key& key, Output& output);
  [[nodiscard]] int uses(const Key& key);
  std::string declare(ast::Section section, std::string name, ast::TypeSpec type);

  const Sheet& sheet_;
  const NetworkOptions& options_;
  Diagnostics& diagnostics_;
  LoweredNetworks lowered_;
  std::map<Key, Output> outputs_;
  std::map<Key, int> uses_;
  std::unordered_set<std::string> names_;       // of variables declared
  std::unordered_set<const Element*> derived_;  // behind which a view knows the power
};

}  // namespace indurop::plc::lower
