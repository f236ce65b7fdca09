// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/shape.h"

#include <algorithm>

#include "core/base/utf8.h"

namespace indurop::plc::draw {
namespace {

using Kind = Element::Kind;

constexpr int kPinPitch = 2;  // lines from pin to pin of a block

const Pin* pin_at(const Element& block, bool left, std::size_t i) noexcept {
  const auto& own = left ? block.inputs : block.outputs;
  return i < own.size() ? &own[i] : i - own.size() < block.in_outs.size() ? &block.in_outs[i - own.size()] : nullptr;
}

Shape block_shape(const Element& block) {
  Shape shape;
  const std::size_t left = block.inputs.size() + block.in_outs.size();
  const std::size_t right = block.outputs.size() + block.in_outs.size();
  const int border = border_line(block);
  int inside = text_width(block.type) + 2;
  for (std::size_t i = 0; i < std::max(left, right); ++i) {
    const Pin* in = pin_at(block, true, i);
    const Pin* out = pin_at(block, false, i);
    inside = std::max(inside, (in == nullptr ? 0 : text_width(in->name)) +
                                  (out == nullptr ? 0 : text_width(out->name)) + kSymbolWidth);
  }
  const int line = border + 1;
  for (std::size_t i = 0; i < left; ++i) {
    shape.inputs.push_back(line + kPinPitch * static_cast<int>(i));
  }
  for (std::size_t i = 0; i < right; ++i) {
    shape.outputs.push_back(line + kPinPitch * static_cast<int>(i));
  }
  shape.width = std::max(inside + 2, text_width(block.instance));
  shape.height = line + std::max(1, kPinPitch * static_cast<int>(std::max(left, right)) - 1) + 1;
  return shape;
}

}  // namespace

int text_width(std::string_view text) noexcept {
  return static_cast<int>(text.size()) -
         static_cast<int>(std::count_if(text.begin(), text.end(), base::continues_utf8));
}

const char* mark_of(const Element& element) noexcept {
  if (element.storage != Storage::None) {
    return element.storage == Storage::Set ? "S" : "R";
  }
  if (element.edge != ast::Edge::None) {
    return element.edge == ast::Edge::Rising ? "P" : "N";
  }
  return element.negated ? "/" : " ";
}

int border_line(const Element& block) noexcept {
  return block.instance.empty() ? 0 : 1;
}

std::string shown_text(const Element& element) {
  switch (element.kind) {
    case Kind::InVariable:
    case Kind::OutVariable:
    case Kind::InOutVariable:
      break;
    default:
      return element.text;
  }
  const char* behind = element.storage == Storage::None ? "" : element.storage == Storage::Set ? " (S)" : " (R)";
  return (element.negated ? "NOT " : "") + element.text + behind;
}

Shape shape_of(const Element& element) {
  const int text = text_width(shown_text(element));
  switch (element.kind) {
    case Kind::Contact:
    case Kind::Coil:
      return {std::max(kSymbolWidth, text) + 2, 2, {1}, {1}};
    case Kind::Block:
      return block_shape(element);
    case Kind::InVariable:
    case Kind::Continuation:
      return {text + (element.kind == Kind::InVariable ? 1 : 2), 1, {}, {0}};
    case Kind::OutVariable:
    case Kind::Connector:
      return {text + 2, 1, {0}, {}};
    case Kind::InOutVariable:
      return {text + 4, 1, {0}, {0}};
    case Kind::Jump:
      return {text + 3, 1, {0}, {}};
    case Kind::Return:
      return {8, 1, {0}, {}};
    default:
      return {};
  }
}

}  // namespace indurop::plc::draw
