// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of the survey folder. All throw InputError at the row concerned: a cell that is no
// finite number, sigma <= 0, an unknown role or photo, a name or mark twice. Names of points are
// resolved later, when all files are read.
#pragma once

#include <filesystem>

#include "reconstruction/survey/survey.h"

namespace insitu {

std::vector<ControlPoint> ReadControlPoints(const std::filesystem::path& path);

std::vector<ImageObservation> ReadObservations(const std::filesystem::path& path,
                                               const std::vector<std::string>& photos);

// One position a photo at most.
std::vector<CameraPosition> ReadCameraPositions(const std::filesystem::path& path,
                                                const std::vector<std::string>& photos);

// An edge may be marked many times, but joins two distinct points.
std::vector<EdgeMark> ReadEdges(const std::filesystem::path& path,
                                const std::vector<std::string>& photos);

}  // namespace insitu
