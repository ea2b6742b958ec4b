// SPDX-License-Identifier: GPL-3.0-or-later
// What the page asks of the newest adjustment: answers that change nothing.
#pragma once

#include <json/value.h>

#include "calibration/program/site.h"
#include "renderer/live/live_worker.h"

namespace insitu {

// Each takes and answers as the page's protocol has it (prepare_server.h) and throws InputError:
// something is missing in the question, or not known.

// {photo, x, y, sigma, other} -> {curve: [[x, y]...], band: [[dx, dy]...]}: its longest piece, and
// for each place how far the 95 % band reaches on either side; empty: not determined.
Json::Value EpipolarAnswer(const LiveState& live, const Json::Value& question);

// {points: [a, b]} -> {distance_m, sigma_m, height_m, height_sigma_m}; [a, b, c] -> {angle_deg,
// sigma_deg} at b.
Json::Value MeasureAnswer(const LiveState& live, const Json::Value& question);

// {vertices: [names]} -> {photos: [{photo, score, angle_deg, mm_per_px}]}, best first.
Json::Value BestPhotoAnswer(const LiveState& live, const Json::Value& question);

// {photo, x, y} -> {polygon}: the polygon that the pixel sees first, null if none; of those that
// touch there (a path on a lawn) the smallest.
Json::Value PolygonAtAnswer(const LiveState& live, const Json::Value& question);

// {text} -> {rows: [of control_points], format, remarks}: a pasted table, by the readers of
// insitu-import-survey.
Json::Value ImportAnswer(const SitePaths& site, const Json::Value& question);

}  // namespace insitu
