// SPDX-License-Identifier: GPL-3.0-or-later
// The planned building as a wireframe over the photographs: the message `building` to the page.
#pragma once

#include <json/value.h>

#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {

// {images: {PHOTO: [[[x, y]...]...]}, corners: {PHOTO: [{x, y, major, minor, angle}]}} of the
// building of work/building.json: its creases and open edges through the lens, hidden ones too, and
// the corners with the 95 % ellipses that the orientations give them. Null where insitu-convert has
// not run. Throws InputError: its files cannot be read.
Json::Value LiveBuilding(const SitePaths& site, const SceneGeometry& scene);

}  // namespace insitu
