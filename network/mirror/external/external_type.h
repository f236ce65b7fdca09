// SPDX-License-Identifier: Apache-2.0
// The names of variables and their IDL types as glb2idl and idlc generate them. Without DDS; descriptors are opaque.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/schema/schema.h"

namespace indurop::mirror {

// Returns "cell::Encoder" for a variable that is one struct, "cell::torque_" for any other variable cell::torque.
std::string idl_type_name(const schema::Variable& variable);
// Returns the symbol of the type's descriptor in a types library: "cell_Encoder_desc".
std::string descriptor_symbol(const schema::Variable& variable);
// The reverse: a struct with the single member `value`, which represents a variable that is no single struct, is
// replaced by that member.
schema::Type unwrapped(const schema::Type& type, const std::string& variable);
// Returns an empty text if a dds::TypeDescriptor describes the variable as this node knows it, else the difference.
std::string descriptor_problem(const void* descriptor, const schema::Variable& variable);

// Returns the topic of a variable: "cell/encoder" for "cell::encoder".
std::string external_topic(const std::string& variable);

// Returns an empty text if all enums and bools in a value are valid, else the first that is not: "mode: 7".
std::string strange_value(const schema::Type& type, std::span<const std::uint8_t> value);

bool holds_text(const schema::Type& type) noexcept;
// Terminates every text in a value, at the latest in its last byte, and clears the bytes after the terminator.
void tidy_texts(const schema::Type& type, std::span<std::uint8_t> value) noexcept;

}  // namespace indurop::mirror
