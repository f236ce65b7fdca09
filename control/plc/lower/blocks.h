// SPDX-License-Identifier: Apache-2.0
// Translates boxes: calls of functions and instances of function blocks, EN and ENO.

#pragma once

#include "control/plc/lower/network_code.h"

namespace indurop::plc::lower {

// With EN a box is evaluated only while EN is true, and ENO is EN. Meanwhile outputs of an instance keep their values,
// results of functions are FALSE or 0, and variables connected to them are not written.
class BlockLowering {
 public:
  BlockLowering(NetworkCode& code, const NetworkOptions& options) : code_(code), options_(options) {}

  void block(const Element& element);

 private:
  void code(const Element& element, const std::string& enable);
  void instance(const Element& element, const std::string& enable);
  void function(const Element& element, const std::string& enable);
  [[nodiscard]] bool is_standard(const std::string& function) const;
  [[nodiscard]] std::vector<ast::Argument> arguments(const Element& element, bool named);
  void further_outputs(const Element& element, const Pin* result, std::vector<ast::Argument>& arguments);
  [[nodiscard]] ast::TypeSpec output_type(const Element& element, const Pin& pin) const;
  // Stores outputs with the name of a variable at them.
  void store_outputs(const Element& element, const std::string& enable);
  void add(ast::Statement statement, const std::string& enable);

  NetworkCode& code_;
  const NetworkOptions& options_;
};

}  // namespace indurop::plc::lower
