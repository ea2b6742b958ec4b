// SPDX-License-Identifier: GPL-3.0-or-later
// The planned building as a wireframe over the photographs: the message `building` to the page.
#pragma once

#include <json/value.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/geometry/scene_geometry.h"
#include "renderer/building/artificial_environment.h"

namespace insitu {

// What is drawn of a building, however large it is.
struct BuildingWireframe {
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>
      edges;                             // creases and open edges [m], world
  std::vector<Eigen::Vector3d> corners;  // some of the edges' ends
  std::vector<EnvironmentSphere> spheres = {};
};

// Of work/building.json. Throws InputError: its files cannot be read.
BuildingWireframe ReadBuildingWireframe(const SitePaths& site);

// {images: {PHOTO: [[[x, y]...]...]}, corners: {PHOTO: [{x, y, major, minor, angle}]}}: the edges
// through the lens, hidden ones too, and the corners with the 95 % ellipses that the orientations
// give them [px], angle [rad] from +x towards +y.
Json::Value LiveBuilding(const BuildingWireframe& building, const SceneGeometry& scene);

}  // namespace insitu
