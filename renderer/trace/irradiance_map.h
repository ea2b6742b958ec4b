// SPDX-License-Identifier: GPL-3.0-or-later
// Light of sky and surroundings on every face, gathered at corners of triangles that are halved
// until what lies between follows from them. A function of the place alone: the same from every
// photograph, with any number of threads, and computed only where it is asked for.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "radiometry/transport/interreflection.h"

namespace insitu {

struct IrradianceMapOptions {
  double tolerance = 0.01;  // of interpolated irradiance, relative
  double smallest = 0.02;   // edge of a triangle that is not halved any more [m]
  double calm = 0.5;        // edge of one that may be interpolated anywhere [m]
  double reach = 0.004;     // relative change of irradiance that is none
  // Triangles longer than `calm` and than their distance to it are halved in any case: corners far
  // from what stands between them do not tell of it. Empty: nothing stands there. [m], local
  Eigen::AlignedBox3d building = {};

  void Check() const;  // throws CheckError that names the field that is wrong
};

// A point of a triangle, or of a sphere above its facet, on the side of its normal or at its back.
struct FacePlace {
  int triangle = 0;
  Eigen::Vector2d uv;  // barycentric weights of the second and third corner
  bool is_back = false;
};

// Irradiance at a place, the sun's and the lamps' left out.
struct SmoothLight {
  Spectrum before = Spectrum::Zero();  // as if the planned building did not stand
  Spectrum change = Spectrum::Zero();
  bool matters = false;  // the change is beyond the map's reach
};

// What was gathered at a point, known by the cells that its position and its normal lie in.
struct KeptPoint {
  std::array<int, 6> cells{};
  Spectrum before = Spectrum::Zero(), change = Spectrum::Zero();
  double calm = 0;  // edge that is short against what is around [m]
  bool is_open = true;
};

class IrradianceMap {
 public:
  // `light` must be solved; it and the meshes must outlive the map. `normals` of each triangle.
  // `kept` by another map of the same light, mesh and options: these points are not gathered again.
  IrradianceMap(const Interreflection& light, const TriangleMesh& mesh,
                std::vector<Eigen::Vector3d> normals, const IrradianceMapOptions& options,
                std::span<const KeptPoint> kept = {});
  ~IrradianceMap();
  IrradianceMap(const IrradianceMap&) = delete;
  IrradianceMap& operator=(const IrradianceMap&) = delete;

  // From any thread.
  SmoothLight At(const FacePlace& place) const;
  // What that is made of, gathered at the same points once it is asked for, never kept.
  GatheredParts PartsAt(const FacePlace& place) const;

  long points() const;                  // gathered so far, or kept
  std::vector<KeptPoint> Kept() const;  // by cells

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace insitu
