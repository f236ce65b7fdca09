// SPDX-License-Identifier: Apache-2.0
#include "config/check/io_mapping.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.h"

namespace indurop::config {

namespace {

using io::ethercat::WantedObject;

bool is_same(const IoObject& object, const WantedObject& wanted) {
  return object.index == wanted.index && object.subindex == wanted.subindex;
}

bool has_identity(const io::esi::Device& device, const IoSlave& slave) {
  const auto& identity = device.sii.identity;
  return slave.vendor.value_or(identity.vendor) == identity.vendor &&
         slave.product.value_or(identity.product) == identity.product;
}

// The device with the revision of the file, else the newest.
const io::esi::Device* find_slave(const io::esi::EsiFile& description, const IoSlave& slave) {
  const io::esi::Device* found = nullptr;
  for (const io::esi::Device& device : description.devices) {
    if (!has_identity(device, slave)) {
      continue;
    }
    const std::uint32_t revision = device.sii.identity.revision;
    if (slave.revision == revision) {
      return &device;
    }
    found = found == nullptr || revision > found->sii.identity.revision ? &device : found;
  }
  return found;
}

}  // namespace

std::vector<WantedObject> wanted_objects(std::span<const IoPoint> points) {
  std::vector<WantedObject> objects;
  for (const IoPoint& point : points) {
    const IoObject& object = point.object;
    // CoE numbers signed types of 1, 2 and 4 bytes from 2 on, unsigned ones from 5 on.
    const unsigned type = (object.is_signed ? 2U : 5U) + object.bytes / 2U;
    objects.push_back(
        {object.index, object.subindex, static_cast<std::uint8_t>(8U * object.bytes), static_cast<std::uint8_t>(type)});
  }
  return objects;
}

Result<io::esi::Device, std::vector<base::Diagnostic>> described_slave(const IoDevice& device,
                                                                       const std::filesystem::path& file) {
  const IoSlave& slave = device.slave;
  io::esi::EsiFile description = io::esi::read_esi(slave.description);
  if (!description.ok()) {
    return std::move(description.diagnostics);
  }
  const io::esi::Device* const found = find_slave(description, slave);
  const bool is_one = slave.product.has_value() || description.devices.size() == 1;
  if (found != nullptr && is_one) {
    return *found;
  }
  return std::vector<base::Diagnostic>{
      {base::Diagnostic::Severity::Error, file.string(), slave.description_place,
       fmt::format("description: {} has {}; `indurop io import {}` lists its devices",
                   base::in_quotes(slave.description_as_written),
                   is_one ? "no device with this vendor and product"
                          : fmt::format("{} devices; give vendor and product", description.devices.size()),
                   slave.description_as_written)}};
}

void check_mapping(const BoundDevice& device, const std::filesystem::path& file,
                   std::vector<base::Diagnostic>& diagnostics) {
  const auto described = described_slave(device.device, file);
  if (!described) {
    diagnostics.insert(diagnostics.end(), described.error().begin(), described.error().end());
    return;
  }
  for (const bool output : {true, false}) {
    std::vector<IoPoint> points;
    for (const BoundPoint& bound : device.points) {
      if (bound.point.output == output) {
        points.push_back(bound.point);
      }
    }
    while (true) {
      const auto wanted = wanted_objects(points);
      const std::vector<WantedObject> none;
      const auto mapped = io::ethercat::map_objects(described->sii, output ? wanted : none, output ? none : wanted);
      if (mapped) {
        break;
      }
      const auto wrong = std::find_if(points.begin(), points.end(), [&mapped](const IoPoint& point) {
        return is_same(point.object, mapped.error().object);
      });
      diagnostics.push_back({base::Diagnostic::Severity::Error, file.string(), wrong->at_place,
                             fmt::format("device {}: {} cannot exchange {} {}: {}", device.device.name, described->type,
                                         output ? "output" : "input", wrong->at, mapped.error().reason)});
      points.erase(wrong);
    }
  }
}

}  // namespace indurop::config
