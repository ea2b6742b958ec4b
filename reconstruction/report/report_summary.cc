// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/report_summary.h"

#include <ceres/version.h>

#include <cmath>
#include <map>

#include "calibration/files/json_file.h"
#include "reconstruction/verdict/advice.h"

namespace insitu {
namespace {

std::string EigenVersion() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

Json::Value Options(const AdjustmentOptions& options, int start_estimates) {
  Json::Value json;
  json["plane_sigma_m"] = options.plane_sigma;
  json["hard_planes"] = options.has_hard_planes;
  json["zenith_sigma_m"] = options.zenith_sigma;
  json["sun_sigma_m"] = options.sun_sigma;
  json["self_calibration"] = options.is_self_calibrating;
  json["significance"] = options.significance;
  json["start_estimates"] = start_estimates;
  return json;
}

Json::Value TestReport(const Adjustment& adjustment) {
  Json::Value json;
  if (adjustment.redundancy == 0) return json;
  json["statistic"] = adjustment.global_test.statistic;
  json["low"] = adjustment.global_test.low;
  json["high"] = adjustment.global_test.high;
  json["alpha"] = adjustment.global_test.alpha;
  json["p"] = adjustment.chi_square_p;
  json["is_met"] = adjustment.chi_square_p >= adjustment.global_test.alpha;
  return json;
}

// Standard deviations of what holds the datum; null: nothing holds it.
Json::Value WorthReport(const Adjustment& adjustment) {
  const DatumWorth& worth = adjustment.datum_worth;
  const auto value = [](const std::optional<double>& sigma) {
    return sigma ? Json::Value(*sigma) : Json::Value();
  };
  Json::Value json;
  json["plan_m"] = value(worth.plan);
  json["height_m"] = value(worth.height);
  json["tilt_rad"] = value(worth.tilt);
  json["heading_rad"] = value(worth.heading);
  json["scale"] = value(worth.scale);
  return json;
}

// The root mean square a priori sigma of the image coordinates [px]; 0 without any.
double ImageSigma(const Adjustment& adjustment) {
  double squares = 0;
  int rows = 0;
  for (const ObservationResidual& row : adjustment.residuals) {
    if (row.kind != ObservationKind::kImage) continue;
    squares += row.sigma * row.sigma;
    ++rows;
  }
  return rows > 0 ? std::sqrt(squares / rows) : 0;
}

}  // namespace

Json::Value IdentitySection(const Adjustment& adjustment, const ReportContext& context) {
  Json::Value json;
  json["command"] = context.command;
  json["options"] = Options(context.options, context.start_estimates);
  json["inputs"] = Json::Value(Json::arrayValue);
  for (const InputFile& input : context.inputs) {
    Json::Value file;
    file["file"] = input.name;
    file["sha256"] = input.sha256;
    json["inputs"].append(file);
  }
  json["software"]["insitu"] = INSITU_VERSION;
  json["software"]["Ceres"] = CERES_VERSION_STRING;
  json["software"]["Eigen"] = EigenVersion();
  json["software"]["mrcal"] = INSITU_MRCAL_VERSION;
  for (const auto& [name, version] : context.programs) json["software"][name] = version;
  json["origin_shift_m"] = ToJson(Eigen::VectorXd(adjustment.scene.origin));
  json["coordinate_system"] = "the survey's own; computed about origin_shift_m";
  json["robust_loss"] = "none: statistics are of plain least squares";
  json["random_seed"] = Json::Value();  // nothing is random
  return json;
}

Json::Value SummarySection(const Adjustment& adjustment, const std::vector<ImageMark>& marks) {
  double squares = 0;
  for (const ImageMark& mark : marks) squares += mark.residual.squaredNorm();
  Json::Value json;
  json["observations"] = adjustment.observations;
  json["unknowns"] = adjustment.unknowns;
  json["unknowns_of"] = Json::Value(Json::objectValue);
  for (const auto& [what, count] : adjustment.unknowns_of) json["unknowns_of"][what] = count;
  json["datum"] = adjustment.datum;
  json["datum_defect"] = adjustment.datum_defect;
  json["datum_worth"] = WorthReport(adjustment);
  json["unit"] = adjustment.has_scale ? "m" : "arbitrary";
  json["redundancy"] = adjustment.redundancy;
  json["iterations"] = adjustment.iterations;
  json["termination"] = adjustment.is_converged ? "converged" : "stopped before it converged";
  json["sigma0_a_priori"] = 1;
  json["sigma0"] = adjustment.sigma0;
  json["sigma0_px"] = adjustment.sigma0 * ImageSigma(adjustment);
  json["marks"] = static_cast<Json::UInt64>(marks.size());
  json["image_rms_px"] = marks.empty()
                             ? Json::Value()
                             : Json::Value(std::sqrt(squares / static_cast<double>(marks.size())));
  json["global_test"] = TestReport(adjustment);
  json["vertex_sigma_m"] = adjustment.scene.vertex_sigma;
  return json;
}

// Per group the count, the share of the redundancy, and sigma0 from its residuals alone.
Json::Value GroupsSection(const Adjustment& adjustment) {
  struct Sums {
    int count = 0;
    double redundancy = 0, squares = 0;
  };
  std::map<std::string, Sums> groups;
  for (const ObservationResidual& row : adjustment.residuals) {
    Sums& sums = groups[Group(row) + (row.is_tie_point ? ", tie points" : "")];
    sums.count += 1;
    sums.redundancy += row.redundancy;
    sums.squares += std::pow(row.residual / row.sigma, 2);
  }
  Json::Value json(Json::arrayValue);
  for (const auto& [name, sums] : groups) {
    Json::Value group;
    group["group"] = name;
    group["count"] = sums.count;
    group["redundancy"] = sums.redundancy;
    group["sigma0"] = sums.redundancy > 1e-6
                          ? Json::Value(std::sqrt(sums.squares / sums.redundancy))
                          : Json::Value();
    json.append(group);
  }
  return json;
}

Json::Value CorrelationsSection(const Adjustment& adjustment) {
  Json::Value json(Json::arrayValue);
  for (const Correlation& correlation : adjustment.correlations) {
    Json::Value pair;
    pair["first"] = correlation.first;
    pair["second"] = correlation.second;
    pair["value"] = correlation.value;
    json.append(pair);
  }
  return json;
}

}  // namespace insitu
