// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/pavilion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

// The quad a, b, c, d, counter-clockwise from outside.
Panel Quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
           Material material) {
  return {{a, b, c, d}, material};
}

void AddBox(std::vector<Panel>& panels, const Vector3d& low, const Vector3d& high,
            Material material) {
  const auto at = [&](int x, int y, int z) {
    return Vector3d((x ? high : low).x(), (y ? high : low).y(), (z ? high : low).z());
  };
  const auto wall = [&](int x0, int y0, int x1, int y1) {
    panels.push_back(Quad(at(x0, y0, 0), at(x1, y1, 0), at(x1, y1, 1), at(x0, y0, 1), material));
  };
  wall(0, 0, 1, 0);
  wall(1, 0, 1, 1);
  wall(1, 1, 0, 1);
  wall(0, 1, 0, 0);
  panels.push_back(Quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1), material));
  panels.push_back(Quad(at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0), material));
}

// A pane 3 cm before the wall in a frame 10 cm deep, with one transom.
std::vector<Panel> WindowBlock(double width, double height) {
  const double bar = 0.09, depth = 0.10, transom = 0.72 * height;
  std::vector<Panel> window;
  const auto beam = [&](double x0, double z0, double x1, double z1) {
    AddBox(window, {x0, -0.01, z0}, {x1, depth, z1}, Material::kTimber);
  };
  beam(0, 0, width, bar);
  beam(0, height - bar, width, height);
  beam(0, bar, bar, height - bar);
  beam(width - bar, bar, width, height - bar);
  beam(bar, transom, width - bar, transom + 0.06);
  const double y = 0.03;
  window.push_back(Quad({width - bar, y, bar}, {bar, y, bar}, {bar, y, height - bar},
                        {width - bar, y, height - bar}, Material::kGlass));
  return window;
}

// A faceted stone: an octahedron refined to 128 triangles.
Polyhedron Ball(const Vector3d& center, double radius, Material material) {
  Polyhedron ball;
  ball.material = material;
  ball.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  ball.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  std::map<std::pair<int, int>, int> halves;
  const auto half = [&](int a, int b) {
    const auto [found, added] =
        halves.try_emplace(std::minmax(a, b), static_cast<int>(ball.vertices.size()));
    if (added) ball.vertices.push_back((ball.vertices[a] + ball.vertices[b]).normalized());
    return found->second;
  };
  for (int level = 0; level < 2; ++level) {
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& t : ball.triangles) {
      const int a = half(t[0], t[1]), b = half(t[1], t[2]), c = half(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    ball.triangles = finer;
  }
  for (Vector3d& vertex : ball.vertices) vertex = center + radius * vertex;
  return ball;
}

RoundMesh Mast(const Vector3d& foot, double height, double radius, Material material) {
  RoundMesh mast{6, 24, {}, material};
  for (int row = 0; row < mast.rows; ++row) {
    const double t = static_cast<double>(row) / (mast.rows - 1);
    for (int column = 0; column < mast.columns; ++column) {
      const double turn = 2 * std::numbers::pi * column / mast.columns;
      const double r = std::lerp(radius, 0.03, t);
      mast.vertices.push_back(foot + Vector3d(r * std::cos(turn), r * std::sin(turn), t * height));
    }
  }
  return mast;
}

// Plan coordinates of the pavilion: behind the gallery's left half.
Pavilion Drawn() {
  constexpr double kLeft = -13.2, kRight = -3.6, kFront = 11.2, kBack = 17.4, kEaves = 5.9;
  constexpr double kRightAngle = std::numbers::pi / 2;
  constexpr double kWidth = 1.7, kHeight = 2.1;
  Pavilion pavilion;
  AddBox(pavilion.panels, {kLeft, kFront, -0.3}, {kRight, kBack, kEaves}, Material::kPlaster);
  AddBox(pavilion.panels, {kLeft - 0.7, kFront - 0.7, kEaves}, {kRight + 0.7, kBack + 0.7, 6.25},
         Material::kSlate);
  pavilion.window = WindowBlock(kWidth, kHeight);
  for (const double sill : {0.55, 3.3}) {
    for (int i = 0; i < 4; ++i) {  // the block's y axis points out of the wall: turned by 180
      pavilion.windows.push_back(
          {{kLeft + 0.6 + kWidth + 2.25 * i, kFront, sill}, 2 * kRightAngle});
    }
    for (int i = 0; i < 2; ++i) {
      pavilion.windows.push_back({{kLeft, kFront + 0.95 + 2.65 * i, sill}, kRightAngle});
      pavilion.windows.push_back({{kRight, kBack - 0.95 - 2.65 * i, sill}, -kRightAngle});
    }
  }
  pavilion.ball = Ball({2.4, -2.9, 0.95}, 1.05, Material::kSandstone);
  pavilion.mast = Mast({-4.4, 5.3, -0.2}, 8.2, 0.55, Material::kRedPaint);
  return pavilion;
}

// The face of a panel after a placement.
Face PlacedFace(const Panel& panel, const Placement& placement) {
  const Eigen::AngleAxisd turn(placement.turn, Vector3d::UnitZ());
  Face face;
  face.material = panel.material;
  for (const Vector3d& corner : panel.corners) {
    face.vertices.push_back(turn * corner + placement.position);
  }
  return face;
}

void AddPlaced(std::vector<Face>& faces, const std::vector<Panel>& panels,
               const Placement& placement) {
  for (const Panel& panel : panels) faces.push_back(PlacedFace(panel, placement));
}

std::vector<Panel> MastPanels(const RoundMesh& mast) {
  std::vector<Panel> panels;
  const auto at = [&](int row, int column) {
    return mast.vertices[row * mast.columns + column % mast.columns];
  };
  for (int row = 0; row + 1 < mast.rows; ++row) {
    for (int c = 0; c < mast.columns; ++c) {
      panels.push_back(
          Quad(at(row, c), at(row, c + 1), at(row + 1, c + 1), at(row + 1, c), mast.material));
    }
  }
  return panels;
}

std::vector<Panel> BallPanels(const Polyhedron& ball) {
  std::vector<Panel> panels;
  for (const Eigen::Vector3i& t : ball.triangles) {
    panels.push_back(
        {{ball.vertices[t[0]], ball.vertices[t[1]], ball.vertices[t[2]]}, ball.material});
  }
  return panels;
}

}  // namespace

Pavilion MakePavilion(double azimuth) {
  const Eigen::AngleAxisd turn(azimuth, Vector3d::UnitZ());
  Pavilion pavilion = Drawn();
  for (Panel& panel : pavilion.panels) {
    for (Vector3d& corner : panel.corners) corner = turn * corner;
  }
  for (Placement& placement : pavilion.windows) {
    placement = {turn * placement.position, placement.turn + azimuth};
  }
  for (Vector3d& vertex : pavilion.ball.vertices) vertex = turn * vertex;
  for (Vector3d& vertex : pavilion.mast.vertices) vertex = turn * vertex;
  return pavilion;
}

Scene PavilionScene(const Pavilion& pavilion) {
  const Placement as_drawn{Vector3d::Zero(), 0};
  std::vector<Face> faces;
  AddPlaced(faces, pavilion.panels, as_drawn);
  for (const Placement& placement : pavilion.windows) {
    AddPlaced(faces, pavilion.window, placement);
  }
  AddPlaced(faces, BallPanels(pavilion.ball), as_drawn);
  AddPlaced(faces, MastPanels(pavilion.mast), as_drawn);
  return MakeScene(faces);
}

}  // namespace insitu::demo
