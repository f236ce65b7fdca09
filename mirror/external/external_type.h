// SPDX-License-Identifier: Apache-2.0
// Variables and their IDL types as glb2idl and idlc name them. No DDS here; descriptors are opaque.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "schema/schema.h"

namespace indurop::mirror {

// "cell::Encoder" of a variable that is one struct, "cell::torque_" of every other variable cell::torque.
std::string idl_type_name(const schema::Variable& variable);
// The symbol of the type's descriptor in a types library: "cell_Encoder_desc".
std::string descriptor_symbol(const schema::Variable& variable);
// The way back: of a struct with the one member `value`, as it stands for a variable that is no single struct, the
// member.
schema::Type unwrapped(const schema::Type& type, const std::string& variable);
// Empty if a dds::TypeDescriptor describes the variable as this node knows it; else what differs.
std::string descriptor_problem(const void* descriptor, const schema::Variable& variable);

// "cell::encoder" has the topic "cell/encoder".
std::string external_topic(const std::string& variable);

// Empty if all enums and bools inside a value have values of their types; else the first that has not: "mode: 7".
std::string strange_value(const schema::Type& type, std::span<const std::uint8_t> value);

bool holds_text(const schema::Type& type) noexcept;
// Ends every text inside a value at the latest in its last byte and clears what is behind the end.
void tidy_texts(const schema::Type& type, std::span<std::uint8_t> value) noexcept;

}  // namespace indurop::mirror
