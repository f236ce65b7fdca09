// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/svg_picture.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "control/plc/draw/svg_symbols.h"

namespace indurop::plc::draw {
namespace {

constexpr int kPageMargin = 24;
constexpr int kSheetLeft = 64;  // numbers of networks are left of the sheet
constexpr int kHeading = 40;
constexpr int kRemark = 18;
constexpr int kGap = 26;

// Returns the points where at least three pieces of a net meet.
std::vector<std::pair<int, int>> joints_of(const Picture& picture) {
  std::map<std::tuple<int, int, int>, unsigned> arms;  // net, x, y
  for (const Line& line : picture.lines) {
    if (line.y1 == line.y2) {
      arms[{line.net, line.x1, line.y1}] |= 1U;
      arms[{line.net, line.x2, line.y1}] |= 2U;
    }
  }
  for (const Line& line : picture.lines) {
    if (line.x1 != line.x2) {
      continue;
    }
    for (auto& [key, found] : arms) {
      const auto& [net, x, y] = key;
      if (net == line.net && x == line.x1 && y >= line.y1 && y <= line.y2) {
        found |= (y > line.y1 ? 4U : 0U) | (y < line.y2 ? 8U : 0U);
      }
    }
  }
  std::vector<std::pair<int, int>> joints;
  for (const auto& [key, found] : arms) {
    const unsigned count = (found & 1U) + (found >> 1U & 1U) + (found >> 2U & 1U) + (found >> 3U & 1U);
    if (count >= 3) {
      joints.emplace_back(std::get<1>(key), std::get<2>(key));
    }
  }
  return joints;
}

base::SvgPart drawn(const Picture& picture) {
  base::SvgPart out;
  for (const Line& each : picture.lines) {
    out.line(half_x(each.x1), half_y(each.y1), half_x(each.x2), half_y(each.y2),
             "stroke=\"#1F2D3D\" stroke-width=\"1.6\" stroke-linecap=\"square\"");
  }
  for (const auto& [x, y] : joints_of(picture)) {
    out.circle(half_x(x), half_y(y), 2.6, R"(fill="#1F2D3D")");
  }
  if (picture.rails) {
    for (const int x : {1, 2 * picture.width - 1}) {
      out.line(half_x(x), 0, half_x(x), picture.height * kCellHeight, "stroke=\"#16324F\" stroke-width=\"4\"");
    }
  }
  for (const Symbol& symbol : picture.symbols) {
    svg_symbol(symbol, out);
  }
  return out;
}

class Sheets {
 public:
  std::string run(const std::vector<SvgSheet>& sheets) {
    int width = 0;
    for (const SvgSheet& sheet : sheets) {
      width = std::max({width, kSheetLeft + 9 * text_width(sheet.heading), kSheetLeft + sheet.chart.width});
      for (const SvgNetwork& network : sheet.networks) {
        width = std::max(width, kSheetLeft + network.picture.width * kCellWidth);
        for (const std::string& remark : network.remarks) {
          width = std::max(width, kSheetLeft + 7 * text_width(remark));
        }
      }
    }
    for (const SvgSheet& sheet : sheets) {
      y_ += kHeading;
      out_.text(kPageMargin, y_ - 12, sheet.heading, "font-size=\"17\" font-weight=\"bold\" fill=\"#16324F\"");
      out_.line(kPageMargin, y_ - 2, width, y_ - 2, "stroke=\"#C9D3DF\" stroke-width=\"1\"");
      y_ += kGap / 2;
      if (!sheet.chart.elements.empty()) {
        part(sheet.chart.elements, sheet.chart.height);
      }
      for (const SvgNetwork& network : sheet.networks) {
        draw(network);
      }
    }
    return base::svg_document(width + kPageMargin, y_ + kPageMargin, out_);
  }

 private:
  void draw(const SvgNetwork& network) {
    out_.rect(kPageMargin - 6, y_ - 1, 30, 20, R"(rx="10" fill="#E6EDF5")");
    out_.text(kPageMargin + 9, y_ + 13, std::to_string(network.number),
              "text-anchor=\"middle\" font-weight=\"bold\" fill=\"#2B4C7E\"");
    for (const std::string& remark : network.remarks) {
      out_.text(kSheetLeft, y_ + 13, remark, "fill=\"#5B6B7B\" font-style=\"italic\"");
      y_ += kRemark;
    }
    for (const std::string& label : network.labels) {
      out_.text(kSheetLeft, y_ + 13, label + ":", "font-weight=\"bold\" fill=\"#8A4B08\"");
      y_ += kRemark;
    }
    y_ += network.remarks.empty() && network.labels.empty() ? 0 : kRemark / 3;
    part(drawn(network.picture), network.picture.height * kCellHeight);
  }

  void part(const base::SvgPart& elements, int height) {
    out_.part(kSheetLeft, y_, elements);
    y_ += height + kGap;
  }

  base::SvgPart out_;
  int y_ = 0;
};

}  // namespace

SvgPart draw_network(const Picture& picture) {
  return {drawn(picture), picture.width * kCellWidth, picture.height * kCellHeight};
}

std::string draw_svg(const std::vector<SvgSheet>& sheets) {
  return Sheets().run(sheets);
}

}  // namespace indurop::plc::draw
