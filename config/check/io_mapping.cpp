// SPDX-License-Identifier: Apache-2.0
#include "config/check/io_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "core/base/text.h"

namespace indurop::config {

namespace {

using io::ethercat::Sii;
using io::ethercat::WantedObject;

constexpr const char* kNotInOnePdo = "no PDO of the slave has it, from its first object to its last one";

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

IoBlock block_of_point(const IoPoint& point) {
  return {IoBlock::Kind::Object, point.at, point.object, {}, point.at_place};
}

WantedObject wanted_object(const IoObject& object) {
  // CoE numbers signed types of 1, 2 and 4 bytes from 2 on, unsigned ones from 5 on.
  const unsigned type = (object.is_signed ? 2U : 5U) + object.bytes / 2U;
  return {object.index, object.subindex, static_cast<std::uint8_t>(8U * object.bytes), static_cast<std::uint8_t>(type)};
}

// One direction of what a slave exchanges, as a master maps it.
struct WantedData {
  std::vector<WantedObject> objects;
  std::vector<std::uint16_t> pdos;           // of the other blocks
  std::vector<std::uint16_t> named_by;       // of each block, the index of its object or its PDO
  std::optional<std::size_t> unknown_block;  // that no PDO has
};

WantedData wanted_of(std::span<const IoBlock> blocks, const std::vector<io::ethercat::Pdo>& pdos) {
  WantedData wanted;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const bool is_object = blocks[i].kind == IoBlock::Kind::Object;
    const auto* const pdo = is_object ? nullptr : io::ethercat::pdo_with(pdos, block_of(blocks[i]));
    if (is_object) {
      wanted.objects.push_back(wanted_object(blocks[i].first));
    } else if (pdo == nullptr) {
      wanted.unknown_block = wanted.unknown_block.value_or(i);
    } else {
      wanted.pdos.push_back(pdo->index);
    }
    wanted.named_by.push_back(pdo != nullptr ? pdo->index : blocks[i].first.index);
  }
  return wanted;
}

// The block for which the master wanted this object or PDO.
std::size_t block_with(const WantedData& wanted, std::span<const IoBlock> blocks, const WantedObject& object) {
  std::size_t found = 0;
  while (found + 1 < blocks.size() &&
         (wanted.named_by[found] != object.index ||
          (blocks[found].kind == IoBlock::Kind::Object && blocks[found].first.subindex != object.subindex))) {
    ++found;
  }
  return found;
}

// A block whose outputs one before it writes, too.
std::optional<Unexchangeable> doubled(std::span<const IoBlock> blocks, const std::vector<io::ethercat::Pdo>& pdos) {
  std::vector<io::ethercat::BlockPlace> places;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    places.push_back(io::ethercat::find_block(pdos, block_of(blocks[i])).value_or(io::ethercat::BlockPlace{}));
    for (std::size_t k = 0; k < i; ++k) {
      if (overlap(places[k], places[i])) {
        return Unexchangeable{true, i, fmt::format("{} writes the same outputs", blocks[k].at)};
      }
    }
  }
  return std::nullopt;
}

std::string size_text(std::size_t bits) {
  const bool are_bytes = bits % 8 == 0;
  const std::size_t count = are_bytes ? bits / 8 : bits;
  return fmt::format("{} {}{}", count, are_bytes ? "byte" : "bit", count == 1 ? "" : "s");
}

// Maps what is described of one device; blocks that its slave cannot exchange are errors, and left out.
std::optional<Sii> map_described(const BoundDevice& device, const std::filesystem::path& file,
                                 std::vector<base::Diagnostic>& diagnostics) {
  const auto described = described_slave(device.device, file);
  if (!described) {
    diagnostics.insert(diagnostics.end(), described.error().begin(), described.error().end());
    return std::nullopt;
  }
  std::vector<IoPoint> outputs;
  std::vector<IoPoint> inputs;
  for (const BoundPoint& bound : device.points) {
    (bound.point.output ? outputs : inputs).push_back(bound.point);
  }
  auto output_blocks = wanted_outputs(outputs, device.device.slave);
  auto input_blocks = wanted_inputs(inputs, device.device.slave);
  while (true) {
    auto mapped = map_blocks(described->sii, output_blocks, input_blocks);
    if (mapped) {
      return std::move(mapped).value();
    }
    auto& blocks = mapped.error().output ? output_blocks : input_blocks;
    const auto wrong = blocks.begin() + static_cast<std::ptrdiff_t>(mapped.error().block);
    diagnostics.push_back({base::Diagnostic::Severity::Error, file.string(), wrong->place,
                           fmt::format("device {}: {} cannot exchange {} {}: {}", device.device.name, described->type,
                                       mapped.error().output ? "output" : "input", wrong->at, mapped.error().reason)});
    blocks.erase(wrong);
  }
}

}  // namespace

std::vector<IoBlock> wanted_outputs(std::span<const IoPoint> points, const IoSlave& slave) {
  std::vector<IoBlock> blocks;
  std::transform(points.begin(), points.end(), std::back_inserter(blocks), block_of_point);
  for (const IoCopy& copy : slave.copies) {
    blocks.push_back(copy.target);
  }
  return blocks;
}

std::vector<IoBlock> wanted_inputs(std::span<const IoPoint> points, const IoSlave& slave) {
  std::vector<IoBlock> blocks;
  std::transform(points.begin(), points.end(), std::back_inserter(blocks), block_of_point);
  blocks.insert(blocks.end(), slave.copied.begin(), slave.copied.end());
  return blocks;
}

io::ethercat::Block block_of(const IoBlock& block) noexcept {
  return {block.first.index, block.first.subindex, block.last.index, block.last.subindex};
}

Result<Sii, Unexchangeable> map_blocks(Sii sii, std::span<const IoBlock> outputs, std::span<const IoBlock> inputs) {
  const WantedData out = wanted_of(outputs, sii.outputs);
  const WantedData in = wanted_of(inputs, sii.inputs);
  if (out.unknown_block || in.unknown_block) {
    const bool output = out.unknown_block.has_value();
    return Unexchangeable{output, output ? *out.unknown_block : *in.unknown_block, kNotInOnePdo};
  }
  std::vector<std::uint16_t> pdos = out.pdos;
  pdos.insert(pdos.end(), in.pdos.begin(), in.pdos.end());
  auto mapped = io::ethercat::map_objects(std::move(sii), out.objects, in.objects, pdos);
  if (!mapped) {
    const auto& error = mapped.error();
    return Unexchangeable{error.output,
                          error.output ? block_with(out, outputs, error.object) : block_with(in, inputs, error.object),
                          error.reason};
  }
  if (auto twice = doubled(outputs, mapped->outputs)) {
    return std::move(*twice);
  }
  return std::move(mapped).value();
}

std::string problem_of_copy(const IoCopy& copy, const Sii& source, const Sii& target) {
  const auto from = io::ethercat::find_block(source.inputs, block_of(copy.source));
  const auto to = io::ethercat::find_block(target.outputs, block_of(copy.target));
  if (!from || !to || (from->bits == to->bits && from->bits > 0)) {
    return {};
  }
  return fmt::format("{} of {} has {}, and {} has {}; copy what has one size, and more than none", copy.source.at,
                     copy.from, size_text(from->bits), copy.target.at, size_text(to->bits));
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

void check_mappings(std::span<const BoundDevice* const> devices, const std::filesystem::path& file,
                    std::vector<base::Diagnostic>& diagnostics) {
  std::map<std::string, Sii> mapped;
  for (const BoundDevice* const device : devices) {
    if (auto sii = map_described(*device, file, diagnostics)) {
      mapped[device->device.name] = std::move(*sii);
    }
  }
  for (const BoundDevice* const device : devices) {
    const auto target = mapped.find(device->device.name);
    for (const IoCopy& copy : device->device.slave.copies) {
      const auto source = mapped.find(copy.from);
      if (source == mapped.end() || target == mapped.end()) {
        continue;
      }
      if (std::string wrong = problem_of_copy(copy, source->second, target->second); !wrong.empty()) {
        diagnostics.push_back({base::Diagnostic::Severity::Error, file.string(), copy.place, std::move(wrong)});
      }
    }
  }
}

}  // namespace indurop::config
