// SPDX-License-Identifier: GPL-3.0-or-later
// The sections of the residual report, one function each, in the report's order. Internal to
// residual_report.cc; the keys of their JSON are the report's format.
#pragma once

#include <json/value.h>

#include <cmath>

#include "reconstruction/report/image_marks.h"
#include "reconstruction/report/residual_report.h"

namespace insitu {

inline constexpr double kDegree = M_PI / 180;

// report_summary.cc
Json::Value IdentitySection(const Adjustment& adjustment, const ReportContext& context);
Json::Value SummarySection(const Adjustment& adjustment, const std::vector<ImageMark>& marks);
Json::Value GroupsSection(const Adjustment& adjustment);
Json::Value CorrelationsSection(const Adjustment& adjustment);

// report_orientations.cc
Json::Value CamerasSection(const Adjustment& adjustment, const ReportContext& context);
Json::Value PhotosSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks,
                          const ReportContext& context);

// report_points.cc
Json::Value PointsSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks);
Json::Value TiePointsSection(const Adjustment& adjustment);
Json::Value ComparisonSection(const std::vector<PointComparison>& comparisons);

// report_polygons.cc
Json::Value PolygonsSection(const Adjustment& adjustment, const Survey& survey);
Json::Value AdjoiningSection(const Adjustment& adjustment, const Survey& survey);
Json::Value PlaneEffectSection(const PlaneEffect& effect);
Json::Value DirectionsSection(const Adjustment& adjustment, const Survey& survey);

// report_observations.cc
Json::Value ObservationsSection(const Adjustment& adjustment);
Json::Value HistogramSection(const Adjustment& adjustment);

// report_lens_residuals.cc: what of the residuals repeats in every photo of a camera.
Json::Value LensResidualsSection(const Adjustment& adjustment, const std::vector<ImageMark>& marks);
// Mean residual vectors of cells of about a `cells`th of the longer side.
Json::Value ResidualGrid(const std::vector<ImageMark>& marks, int width, int height, int cells);

// report_montage.cc
Json::Value MontageSection(const Adjustment& adjustment, const std::vector<MontagePoint>& points);

}  // namespace insitu
