// SPDX-License-Identifier: GPL-3.0-or-later
// The satellite positions that the photographs state, as surveyed camera positions.
#pragma once

#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "reconstruction/site_photos.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

struct GpsPositions {
  std::vector<CameraPosition> positions;  // weighted; x east, y north in `system`, z as stated [m]
  std::string system;                     // "WGS 84 / UTM zone 32N"
  std::string remark;                     // what was taken, for the user; empty: nothing
};

// Of a survey without control points and without camera positions of its own, from EXIF and XMP, in
// the UTM zone of the first; else, and where none states its place, nothing. site.json may tell the
// antenna's place in the camera's axes: "gps_lever_arm_m": [right, down, forward]. Throws
// InputError: that is no vector.
GpsPositions FindGpsPositions(const SitePaths& site, const SitePhotos& photos,
                              const Survey& survey);

}  // namespace insitu
