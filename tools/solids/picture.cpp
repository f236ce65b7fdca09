// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "core/base/svg.h"
#include "core/base/svg_style.h"
#include "tools/solids/beyond.h"
#include "tools/solids/planar.h"

namespace indurop::solids {

namespace {

constexpr int kView = 260;  // pixels; size of a view with its margin
constexpr int kMargin = 20;
constexpr int kTitle = 40;
constexpr const char* kSolidStyle =
    ".mesh{fill:#55636f}.solid{fill:#0b78c2;fill-opacity:.10;stroke:#0b78c2;stroke-width:1.2}";

// The axes that point right and up.
struct View {
  const char* name;
  int right, up;
};
constexpr View kViews[] = {{"x right, z up", 0, 2}, {"y right, z up", 1, 2}, {"x right, y up", 0, 1}};

// Returns points spread evenly over the area; the same ones each time.
std::vector<Vec3> dots_of(const Surface& surface) {
  std::vector<double> areas;
  for (const Triangle& triangle : surface) {
    areas.push_back((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm() + 1e-12);
  }
  constexpr int kDots = 1500;
  std::mt19937 chance(1);  // NOLINT(cert-msc51-cpp): a picture does not change from time to time
  std::discrete_distribution<std::size_t> which(areas.begin(), areas.end());
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Vec3> dots;
  for (int i = 0; i < kDots; ++i) {
    const Triangle& triangle = surface[which(chance)];
    const double root = std::sqrt(part(chance));
    const double side = part(chance);
    dots.emplace_back((1 - root) * triangle[0] + root * (1 - side) * triangle[1] + root * side * triangle[2]);
  }
  return dots;
}

// Converts metres to pixels: one scale for all views of a mesh.
struct Scale {
  Vec3 middle = Vec3::Zero();
  double pixels = 1;  // per metre

  [[nodiscard]] Vec2 at(const Vec3& point, const View& view) const {
    const Vec3 from = (point - middle) * pixels;
    return {kView / 2.0 + from[view.right], kTitle + kView / 2.0 - from[view.up]};
  }
};

Scale scale_of(const std::vector<std::vector<Vec3>>& skins) {
  Eigen::AlignedBox3d extent;
  for (const auto& skin : skins) {
    for (const Vec3& point : skin) {
      extent.extend(point);
    }
  }
  return {extent.center(), (kView - 2 * kMargin) / std::max(extent.sizes().maxCoeff(), 1e-6)};
}

void draw_view(base::SvgPart& out, const std::vector<Vec3>& dots, const std::vector<std::vector<Vec3>>& skins,
               const Scale& scale, const View& view) {
  base::svg_text(out, kView / 2.0, kTitle + kView - 4, "middle", "label", view.name);
  std::string commands;
  for (const Vec3& dot : dots) {
    const Vec2 at = scale.at(dot, view);
    commands += "M" + base::svg_number(at.x()) + " " + base::svg_number(at.y()) + "h1v1h-1z";
  }
  out.path(commands, base::svg_class("mesh"));
  for (const auto& skin : skins) {
    std::vector<Vec2> flat;
    for (const Vec3& point : skin) {
      flat.push_back(scale.at(point, view));
    }
    std::string outline;
    for (const Vec2& corner : hull_of(std::move(flat))) {
      outline += (outline.empty() ? "M" : "L") + base::svg_number(corner.x()) + " " + base::svg_number(corner.y());
    }
    out.path(outline + "z", base::svg_class("solid"));
  }
}

base::SvgPart draw_mesh(const DrawnMesh& mesh) {
  std::vector<std::vector<Vec3>> skins;
  for (const robot::Solid& solid : mesh.solids) {
    skins.push_back(skin_of(solid));
  }
  const Scale scale = scale_of(skins);
  const std::vector<Vec3> dots = dots_of(mesh.surface);
  base::SvgPart row;
  row.text(kMargin, kTitle - 12.0, mesh.title, base::svg_class("head"));
  int x = 0;
  for (const View& view : kViews) {
    base::SvgPart part;
    draw_view(part, dots, skins, scale, view);
    row.part(x, 0, part);
    x += kView;
  }
  return row;
}

}  // namespace

std::string draw(const std::vector<DrawnMesh>& meshes) {
  base::SvgPart content;
  int y = 0;
  for (const DrawnMesh& mesh : meshes) {
    content.part(0, y, draw_mesh(mesh));
    y += kTitle + kView;
  }
  return base::svg_document(static_cast<int>(std::size(kViews)) * kView, y + kMargin, content,
                            std::string(base::kSvgStyle) + kSolidStyle);
}

}  // namespace indurop::solids
