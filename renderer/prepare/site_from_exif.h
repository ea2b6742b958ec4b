// SPDX-License-Identifier: GPL-3.0-or-later
// What the photographs' metadata offer to begin with.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <vector>

#include "calibration/program/site.h"

namespace insitu {

// calibration/camera.cameramodel: a pinhole of the focal length that EXIF states, its centre in the
// middle, without distortion. For a first look only: errors of several pixels, at the frame's edge
// of tens. Throws InputError: a camera is there, the photographs are of different sizes or focal
// lengths, or state none.
void WriteCameraFromExif(const SitePaths& site, const std::vector<std::filesystem::path>& photos);

// Members of site.json: latitude, longitude, altitude_m, local_time, of the first photograph that
// states each. Throws InputError: none states any.
Json::Value SiteFromExif(const std::vector<std::filesystem::path>& photos);

}  // namespace insitu
