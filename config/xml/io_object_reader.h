// SPDX-License-Identifier: Apache-2.0
// Objects of EtherCAT slaves in ioconfig.xml.

#pragma once

#include <string>

#include "config/model/io_config.h"
#include "config/xml/attributes.h"
#include "core/base/diagnostics.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Reads an index and a subindex of an object, as manuals write them: 6064, 7000:1. False: it is none.
bool read_io_object(const std::string& text, IoObject& object);
// The same, or the name that such an object of a drive has: position.
bool read_io_object_name(const std::string& text, bool output, IoObject& object);
// Reads `type` of a point, which says how long the object is.
void read_io_type(Attributes& attributes, IoObject& object);

// Reads a <set> of an EtherCAT device, adds it to the device, and reports all its errors.
void read_io_value(const base::Element& element, IoDevice& device, base::Diagnostics& report);
// The same for its <sync>.
void read_io_sync(const base::Element& element, IoDevice& device, base::Diagnostics& report);

// A slave has one device, and the tick follows one bus. `config`: the devices before it.
void check_io_slave(const IoDevice& device, const IoConfig& config, base::Diagnostics& report);

}  // namespace indurop::config
