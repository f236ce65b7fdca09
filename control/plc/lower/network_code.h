// SPDX-License-Identifier: Apache-2.0
// The state of the translation of networks: the statements so far, values at outputs of elements, hidden variables.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "control/plc/lower/derived_power.h"
#include "control/plc/lower/networks.h"

namespace indurop::plc::lower {

// A value, and the BOOL that guards it: after a function with EN it is used only if that is TRUE. Empty: always.
struct Value {
  ast::Expression expression;
  std::string guard;
};

// Returns the key in the names of an element's variables: its number and its text, "5_start".
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
  // Parses Structured Text written at an element.
  [[nodiscard]] std::optional<ast::Expression> parse(std::string_view text, const Place& at);

  // Returns the value at a pin: that of its source, or of any of them where branches meet; negated, or its edge, as the
  // pin requires.
  [[nodiscard]] ast::Expression input(const Element& element, const Pin& pin);
  // Returns the value with the guard of a function's result, to be stored.
  [[nodiscard]] Value input_value(const Element& element, const Pin& pin, bool guarded = true);

  // Returns the value at an output of an element that was evaluated.
  [[nodiscard]] Value output_value(const Element& element, const Pin& pin);

  // Stores the value at an output.
  void define(const Element& element, const Pin* pin, ast::Expression value, std::string guard = {});
  // Stores the result of a function: as an expression if it is used once, else in a variable of the scan.
  void defer(const Element& element, const Pin& pin, ast::Expression value, std::string guard);

  // Stores `value` in the variable of the power after the element, which is reported unless a view can derive it.
  [[nodiscard]] ast::Expression power(const Element& element, ast::Expression value);
  // Returns an expression that is true in the scan in which `value` has this edge. `key` distinguishes the places of a
  // body.
  [[nodiscard]] ast::Expression edge(ast::Expression value, ast::Edge edge, const std::string& key);
  void store(ast::Expression target, Value value, Storage storage, bool negated);

  // Declares a variable that lives for one scan. The same name is declared once.
  std::string temporary(std::string_view letter, const std::string& key, ast::TypeSpec type);

  // Ends a network before the next one begins.
  void end_network();
  // Adds a point for a running view.
  void show(FlowPoint::Kind kind, const Source& source, ast::Expression value, Elementary type = Elementary::Bool);

  [[nodiscard]] const Sheet& sheet() const noexcept { return sheet_; }
  [[nodiscard]] Diagnostics& diagnostics() noexcept { return diagnostics_; }
  [[nodiscard]] LoweredNetworks finish();

 private:
  using Key = std::pair<const Element*, const Pin*>;
  struct Output {
    Value value;
    bool deferred = false;
    std::size_t written = 0;  // number of statements so far
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
  std::unordered_set<std::string> names_;       // names of declared variables
  std::unordered_set<const Element*> derived_;  // a view can derive the power after these
};

}  // namespace indurop::plc::lower
