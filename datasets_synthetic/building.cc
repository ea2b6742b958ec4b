// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/building.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace insitu::demo {
namespace {

using Eigen::Vector3d;

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

std::vector<Panel> MeshPanels(const RoundMesh& mesh) {
  std::vector<Panel> panels;
  const auto at = [&](int row, int column) {
    return mesh.vertices[row % mesh.rows * mesh.columns + column % mesh.columns];
  };
  for (int row = 0; row + (mesh.is_ring ? 0 : 1) < mesh.rows; ++row) {
    for (int c = 0; c < mesh.columns; ++c) {
      panels.push_back(
          Quad(at(row, c), at(row, c + 1), at(row + 1, c + 1), at(row + 1, c), mesh.material));
    }
  }
  return panels;
}

std::vector<Panel> BodyPanels(const Polyhedron& body) {
  std::vector<Panel> panels;
  for (const Eigen::Vector3i& t : body.triangles) {
    panels.push_back(
        {{body.vertices[t[0]], body.vertices[t[1]], body.vertices[t[2]]}, body.material});
  }
  return panels;
}

}  // namespace

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

Polyhedron Ball(const Vector3d& center, double radius, int levels, Material material) {
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
  for (int level = 0; level < levels; ++level) {
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

RoundMesh Cone(const Vector3d& foot, double height, double radius, int rows, int columns,
               Material material) {
  RoundMesh cone{rows, columns, {}, material};
  for (int row = 0; row < cone.rows; ++row) {
    const double t = static_cast<double>(row) / (cone.rows - 1);
    for (int column = 0; column < cone.columns; ++column) {
      const double turn = 2 * std::numbers::pi * column / cone.columns;
      const double r = std::lerp(radius, 0.03, t);
      cone.vertices.push_back(foot + Vector3d(r * std::cos(turn), r * std::sin(turn), t * height));
    }
  }
  return cone;
}

RoundMesh Torus(const Vector3d& center, double radius, double tube, Material material) {
  constexpr int kRound = 48, kTube = 24;
  RoundMesh torus{kTube, kRound, {}, material, true};
  for (int row = 0; row < kTube; ++row) {
    const double rise = 2 * std::numbers::pi * row / kTube;
    for (int column = 0; column < kRound; ++column) {
      const double turn = 2 * std::numbers::pi * column / kRound;
      const double r = radius + tube * std::cos(rise);
      torus.vertices.push_back(
          center + Vector3d(r * std::cos(turn), r * std::sin(turn), tube * std::sin(rise)));
    }
  }
  return torus;
}

Building Turned(Building building, double azimuth) {
  const Eigen::AngleAxisd turn(azimuth, Vector3d::UnitZ());
  for (Panel& panel : building.panels) {
    for (Vector3d& corner : panel.corners) corner = turn * corner;
  }
  for (Placement& placement : building.windows) {
    placement = {turn * placement.position, placement.turn + azimuth};
  }
  for (Polyhedron& body : building.bodies) {
    for (Vector3d& vertex : body.vertices) vertex = turn * vertex;
  }
  for (RoundMesh& mesh : building.meshes) {
    for (Vector3d& vertex : mesh.vertices) vertex = turn * vertex;
  }
  return building;
}

Scene BuildingScene(const Building& building) {
  const Placement as_drawn{Vector3d::Zero(), 0};
  std::vector<Face> faces;
  AddPlaced(faces, building.panels, as_drawn);
  for (const Placement& placement : building.windows) {
    AddPlaced(faces, building.window, placement);
  }
  for (const Polyhedron& body : building.bodies) AddPlaced(faces, BodyPanels(body), as_drawn);
  for (const RoundMesh& mesh : building.meshes) AddPlaced(faces, MeshPanels(mesh), as_drawn);
  return MakeScene(faces);
}

}  // namespace insitu::demo
