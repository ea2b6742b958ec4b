// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/residual_report.h"

#include <cmath>

#include "calibration/program/finding.h"
#include "reconstruction/report/large_report.h"
#include "reconstruction/report/report_lens_residuals.h"
#include "reconstruction/report/report_montage.h"
#include "reconstruction/report/report_observations.h"
#include "reconstruction/report/report_orientations.h"
#include "reconstruction/report/report_points.h"
#include "reconstruction/report/report_polygons.h"
#include "reconstruction/report/report_summary.h"
#include "reconstruction/verdict/image_marks.h"
#include "reconstruction/verdict/verdict.h"

namespace insitu {
namespace {

// JSON has no NaN and no infinity: what is not finite is not known.
void DropNonFinite(Json::Value* value) {
  if (value->isDouble() && !std::isfinite(value->asDouble())) *value = Json::Value();
  if (!value->isArray() && !value->isObject()) return;
  for (Json::Value& member : *value) DropNonFinite(&member);
}

Json::Value Conventions() {
  Json::Value json;
  json["units"] =
      "metres, pixels and radians unless a name says otherwise; sigma and standard "
      "ellipses: one standard deviation";
  json["pixels"] = "(0, 0) is the centre of the top-left pixel; x right, y down";
  json["camera_axes"] = "x right, y down, z forward; x_cam = rotation (x_world - center)";
  json["angles"] =
      "azimuth clockwise from +y, elevation above the xy plane, roll clockwise of the "
      "picture about its line of sight";
  json["residual"] = "adjusted - observed";
  json["w"] =
      "residual over its own standard deviation, standard normal without a gross error "
      "and with the lens as calibrated";
  json["covariance"] =
      "a posteriori, scaled by sigma0^2; of a pose: left rotation increment [rad] "
      "about the camera's axes, then centre [m]";
  return json;
}

}  // namespace

Json::Value ResidualReport(const Adjustment& adjustment, const Survey& survey,
                           const ReportContext& context) {
  const std::vector<ImageMark> marks = ImageMarks(adjustment);
  const ReportExtent extent = ExtentOf(adjustment);
  Json::Value report;
  report["format"] = "insitu residual report 2";
  report["verdict"] = VerdictReport(Judge(adjustment, context.cameras));
  report["identity"] = IdentitySection(adjustment, context);
  report["conventions"] = Conventions();
  report["summary"] = SummarySection(adjustment, marks);
  report["groups"] = GroupsSection(adjustment);
  report["correlations"] = CorrelationsSection(adjustment);
  report["cameras"] = CamerasSection(adjustment, context);
  report["photos"] = PhotosSection(adjustment, marks, context, extent);
  report["control"] = ComparisonSection(adjustment.control);
  report["check"] = ComparisonSection(adjustment.check);
  report["left_out"] = ComparisonSection(adjustment.left_out);
  report["points"] = PointsSection(adjustment, marks, extent.points);
  report["tie_points"] = TiePointsSection(adjustment);
  report["polygons"] = PolygonsSection(adjustment, survey);
  report["plane_effect"] = PlaneEffectSection(adjustment.plane_effect);
  report["adjoining_polygons"] = AdjoiningSection(adjustment, survey);
  report["directions"] = DirectionsSection(adjustment, survey);
  report["observations"] = ObservationsSection(adjustment);
  report["histogram"] = HistogramSection(adjustment);
  report["lens_residuals"] = LensResidualsSection(adjustment, marks);
  report["montage"] = MontageSection(adjustment, context.montage);
  CondenseReport(adjustment, extent, &report);
  DropNonFinite(&report);
  return report;
}

}  // namespace insitu
