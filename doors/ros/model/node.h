// SPDX-License-Identifier: Apache-2.0
// A node of this machine and its variables, through the C interface. A handle is for one thread.

#pragma once

#include <indurop/c.h>
#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "doors/ros/model/layout.h"

namespace indurop::ros {

class Node {
 public:
  // An empty name: that of $INDUROP_NODE, "local" or the only one. Errors: there is no such node, it has ended, no
  // right to it.
  static Result<Node, base::Problem> open(const std::string& name, bool write);

  [[nodiscard]] irp_node* handle() const noexcept { return handle_.get(); }
  [[nodiscard]] std::string name() const { return irp_node_name(handle_.get()); }
  [[nodiscard]] std::vector<std::string> variables() const;
  // The node runs, with the variables that it had when it was opened.
  [[nodiscard]] bool runs() const noexcept { return irp_running(handle_.get()) == IRP_OK; }

 private:
  struct Close {
    void operator()(irp_node* node) const noexcept { irp_close(node); }
  };
  explicit Node(irp_node* node) : handle_(node) {}

  std::unique_ptr<irp_node, Close> handle_;
};

// A variable, or a part of one, and a copy of its value. The node has to outlive it.
class Variable {
 public:
  // Errors: there is none of this name, or the node has other variables now.
  static Result<Variable, base::Problem> find(const Node& node, const std::string& name);

  // Copies the value. False: the copy is unchanged.
  bool read();
  // Sets the value to the copy. Returns why it was not set; empty: it was.
  std::string write(const char* reason);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const Layout& layout() const noexcept { return layout_; }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept { return bytes_; }
  [[nodiscard]] bool has(std::string_view part) const { return find_spot(layout_, part).has_value(); }
  // The number at "[3].dTo[0]" in the copy; 0 if there is none.
  [[nodiscard]] double number(std::string_view part) const;
  // Changes it in the copy; no effect if there is none.
  void set(std::string_view part, double number);

 private:
  Variable(const Node& node, std::uint32_t id, std::string name, Layout layout)
      : node_(node.handle()), id_(id), name_(std::move(name)), layout_(std::move(layout)), bytes_(layout_.size()) {}

  irp_node* node_;
  std::uint32_t id_;
  std::string name_;
  Layout layout_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace indurop::ros
