// SPDX-License-Identifier: GPL-3.0-or-later
// Light that surfaces send each other, all bounces, before and after the building stands: a
// radiosity solution (Goral et al., ACM SIGGRAPH 1984) on cells that grow with their distance from
// the building, gathered at each point by rays. All surfaces count as
// diffuse and send nothing from their backs, air as clear.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <unordered_map>
#include <vector>

#include "datasets_synthetic/place.h"

namespace insitu::demo {

struct BouncedLightOptions {
  double smallest = 0.5;  // side of a cell near the building [m]
  double growth = 0.15;   // of the side with distance
  int strata = 8;         // squared: directions gathered at a cell
  // Quarters of long faces are strips across them, so that a quay has no needles for cells. Not in
  // the demo, whose bytes are fixed.
  bool keep_cells_wide = false;
};

// What a surface receives but for the sun's own light.
struct Incoming {
  BeforeAfter sky;         // cosine-weighted share of the visible sky, 0..1; 1 on open ground
  Spectrum before, after;  // of all that is not sky: radiance, meaned over the same hemisphere
};

class BouncedLight {
 public:
  // `place` must outlive it.
  explicit BouncedLight(const Place& place, const BouncedLightOptions& options = {});

  // From `strata` x `strata` directions, jittered by `seed`. Thread-safe.
  Incoming Gather(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, int strata,
                  uint64_t seed) const;

  const Place& place() const { return place_; }
  int cells() const { return static_cast<int>(cells_.size()); }

 private:
  static constexpr int kDark = -1, kSky = -2;

  struct Cell {
    Eigen::Vector3d point, normal;
    Spectrum albedo;
    BeforeAfter sun;         // visible share of the disc
    Spectrum before, after;  // radiance
  };
  // A rectangle of a face: a cell, or four quarters.
  struct Quad {
    int cell = -1;
    int quarters = -1;  // the first of four nodes
  };
  struct Tree {
    Eigen::AlignedBox2d box;  // in the face's own coordinates
    int root = -1;
  };
  struct Meeting {
    int before = kDark, after = kDark;
  };

  void AddFaces(const Scene& scene);
  void Split(const Face& face, const Eigen::AlignedBox2d& box, int node);
  Cell MakeCell(const Face& face, const Eigen::AlignedBox2d& box) const;
  int CellAt(const Spot& spot) const;
  Meeting Meet(const Ray& ray) const;
  void Solve();
  double Sweep(const std::vector<std::vector<Meeting>>& meetings);
  Incoming Sum(const std::vector<Meeting>& meetings) const;

  const Place& place_;
  BouncedLightOptions options_;
  Eigen::AlignedBox3d focus_;
  std::vector<Cell> cells_;
  std::vector<Quad> quads_;
  std::unordered_map<const Face*, Tree> trees_;
};

}  // namespace insitu::demo
