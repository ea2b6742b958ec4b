// SPDX-License-Identifier: GPL-3.0-or-later
// Where each point is to be looked for on each photograph.
#pragma once

#include <json/value.h>

#include <string>
#include <vector>

#include "calibration/lens/camera.h"
#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/survey/survey.h"

namespace insitu {

// {NAME: {xyz, sigma, rays, images: {PHOTO: {x, y, major, minor, angle}}}} of all adjusted points
// but tie points, and of surveyed points that are not adjusted, at their coordinates. The ellipses
// hold 95 %; semi-axes [px], angle [rad] from +x towards +y. `cameras` are the network's photos.
Json::Value PredictedPoints(const Survey& survey, const SolvedSurvey& solved,
                            const std::vector<PosedCamera>& cameras);

// Adds those that a single mark shows on a polygon of `part`, what `solved` is of: "plane" has the
// polygon's name. `plane_sigma` [m] as of the adjustment.
void AddPointsOnPlanes(const Survey& survey, const Survey& part, const SolvedSurvey& solved,
                       const std::vector<PosedCamera>& cameras, double plane_sigma,
                       Json::Value* points);

}  // namespace insitu
