// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/model/node.h"

#include <utility>

namespace indurop::ros {

Result<Node, base::Problem> Node::open(const std::string& name, bool write) {
  irp_node* node = nullptr;
  if (irp_open(name.c_str(), write ? IRP_WRITE : IRP_READ, &node) != IRP_OK) {
    return base::Problem{irp_error()};
  }
  Node opened(node);
  return opened.runs() ? Result<Node, base::Problem>(std::move(opened)) : base::Problem{"the node has ended"};
}

std::vector<std::string> Node::variables() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < irp_count(handle_.get()); ++i) {
    names.emplace_back(irp_name(handle_.get(), i));
  }
  return names;
}

Result<Variable, base::Problem> Variable::find(const Node& node, const std::string& name) {
  std::uint32_t id = 0;
  irp_variable described = IRP_VARIABLE_INIT;
  if (irp_find(node.handle(), name.c_str(), &id) != IRP_OK || irp_describe(node.handle(), id, &described) != IRP_OK) {
    return base::Problem{irp_error()};
  }
  auto layout = read_layout(described.layout);
  if (!layout || layout->size() != described.size) {
    return base::Problem{name + " has a layout of another release; use programs of one release"};
  }
  return Variable(node, id, described.name, std::move(*layout));
}

bool Variable::read() {
  return irp_read(node_, id_, bytes_.data(), bytes_.size()) == IRP_OK;
}

std::string Variable::write(const char* reason) {
  return irp_write(node_, id_, bytes_.data(), bytes_.size(), reason) == IRP_OK ? std::string() : irp_error();
}

double Variable::number(std::string_view part) const {
  const auto spot = find_spot(layout_, part);
  return spot ? number_in(bytes().subspan(spot->offset), spot->base) : 0;
}

void Variable::set(std::string_view part, double number) {
  if (const auto spot = find_spot(layout_, part)) {
    put_number(std::span(bytes_).subspan(spot->offset), spot->base, number);
  }
}

}  // namespace indurop::ros
