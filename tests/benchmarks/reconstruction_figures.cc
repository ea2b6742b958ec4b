// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/reconstruction_figures.h"

#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>

#include "calibration/external_program.h"
#include "reconstruction/colmap_export.h"
#include "reconstruction/colmap_model.h"
#include "reconstruction/import_project.h"
#include "reconstruction/lens_residual.h"
#include "reconstruction/solve_network.h"
#include "tests/reconstruction/network_statistics.h"

namespace insitu {
namespace {
namespace fs = std::filesystem;

double SecondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// ---- AICON 3D Studio -----------------------------------------------------------------------

struct PrintedMark {
  double sigma_mm;
  Eigen::Vector2d redundancy, test_value;
};

struct AiconReport {
  std::map<std::pair<std::string, std::string>, PrintedMark> marks;           // photo, point
  std::map<std::string, std::pair<Eigen::Vector3d, Eigen::Vector3d>> points;  // mm: place, sigma
};

AiconReport ReadAiconReport(const fs::path& path) {
  AiconReport report;
  std::ifstream file(path);
  bool is_in_points = false, is_in_marks = false;
  for (std::string line; std::getline(file, line);) {
    line = std::regex_replace(line, std::regex("<[^>]*>"), "");
    if (line.find("*** ") != std::string::npos) {
      is_in_points = line.find("Objektpunkte") != std::string::npos;
      is_in_marks = line.find("Bildkoordinaten") != std::string::npos;
    }
    std::istringstream words(line);
    std::string point, photo;
    if (is_in_points) {
      Eigen::Vector3d place, sigma;
      if (words >> point >> place.x() >> place.y() >> place.z() >> sigma.x() >> sigma.y() >>
          sigma.z()) {
        report.points[point] = {place, sigma};
      }
    } else if (is_in_marks) {
      double x, y, vx, vy, sy;
      PrintedMark mark;
      if (words >> point >> photo >> x >> y >> vx >> vy >> mark.sigma_mm >> sy >>
          mark.redundancy.x() >> mark.redundancy.y() >> mark.test_value.x() >>
          mark.test_value.y()) {
        report.marks[{photo, point}] = mark;
      }
    }
  }
  return report;
}

// AICON's search for outliers gave four marks ten times the sigma; the .phc file does not tell.
int TakeSigmas(const AiconReport& report, double a_priori_mm, Network* network) {
  int changed = 0;
  for (MarkObservation& mark : network->marks) {
    const auto printed =
        report.marks.find({network->photos[mark.photo].name, network->points[mark.point].name});
    if (printed == report.marks.end() || printed->second.sigma_mm == a_priori_mm) continue;
    mark.sigma_px *= printed->second.sigma_mm / a_priori_mm;
    ++changed;
  }
  return changed;
}

// Compares every printed mark; the printed digits are rounded to 0.01.
void CompareMarks(const Network& network, const NetworkSolution& solution,
                  const AiconReport& report, Json::Value* json) {
  double redundancy = 0, test = 0;
  int compared = 0;
  for (int row = 0; row < static_cast<int>(solution.rows.size()); ++row) {
    const ObservationRow& at = solution.rows[row];
    if (at.kind != ObservationKind::kMark) continue;
    const MarkObservation& mark = network.marks[at.index];
    const auto printed =
        report.marks.find({network.photos[mark.photo].name, network.points[mark.point].name});
    if (printed == report.marks.end()) continue;
    const double r = solution.redundancy_numbers[row];
    const double w =
        std::abs(solution.residuals[row]) / (solution.sigma0 * solution.sigmas[row] * std::sqrt(r));
    redundancy = std::max(redundancy, std::abs(r - printed->second.redundancy[at.component]));
    test = std::max(test, std::abs(w - printed->second.test_value[at.component]));
    ++compared;
  }
  (*json)["compared_observations"] = compared;
  (*json)["max_redundancy_number_difference"] = redundancy;
  (*json)["max_w_test_difference"] = test;
}

void ComparePoints(const Network& network, const NetworkSolution& solution,
                   const AiconReport& report, Json::Value* json) {
  double place = 0, sigma = 0;
  for (size_t i = 0; i < network.points.size(); ++i) {
    const auto printed = report.points.find(network.points[i].name);
    if (printed == report.points.end()) continue;
    const int column = *solution.columns.point[i];
    const Eigen::Vector3d own_mm = 1000 * (network.points[i].position + network.origin);
    const Eigen::Vector3d own_sigma =
        1000 * Covariance(network, solution, column, 3, column, 3).diagonal().cwiseSqrt();
    place = std::max(place, (own_mm - printed->second.first).cwiseAbs().maxCoeff());
    sigma = std::max(sigma, (own_sigma - printed->second.second).cwiseAbs().maxCoeff());
  }
  (*json)["max_point_difference_mm"] = place;
  (*json)["max_point_sigma_difference_mm"] = sigma;
}

void AddParameters(const Network& network, const NetworkSolution& solution, Json::Value* json) {
  const NetworkCamera& camera = network.cameras[0];
  const std::vector<double> values = LensParameters(camera.lens);
  const std::vector<std::string> names = LensParameterNames(camera.lens);
  int column = *solution.columns.camera[0];
  for (size_t i = 0; i < values.size(); ++i) {
    if (!camera.is_free[i]) continue;
    Json::Value& parameter = (*json)["parameters"][names[i]];
    parameter["value"] = values[i];
    parameter["sigma"] = std::sqrt(Covariance(network, solution, column, 1, column, 1)(0, 0));
    ++column;
  }
}

Json::Value JaicovAicon(const fs::path& data) {
  const fs::path folder = data / "adjustment/jaicov_aicon";
  AiconOptions options;
  Network network = ReadAiconProject(folder, options).network;
  const AiconReport report = ReadAiconReport(folder / "example.htm");
  Json::Value json;
  json["marks_of_other_sigma"] = TakeSigmas(report, options.mark_sigma_mm, &network);
  const NetworkSolution solution = SolveNetwork(&network);
  json["s0_mm"] = solution.sigma0 * options.mark_sigma_mm;
  json["observations"] = solution.observations;
  json["unknowns"] = solution.unknowns;
  json["redundancy"] = solution.redundancy;
  json["datum_defect"] = solution.datum.defect();
  CompareMarks(network, solution, report, &json);
  ComparePoints(network, solution, report, &json);
  AddParameters(network, solution, &json);
  return json;
}

// ---- DBAT ----------------------------------------------------------------------------------

void AddSummary(const NetworkSolution& solution, double mark_sigma_px, Json::Value* json) {
  (*json)["sigma0"] = solution.sigma0;
  (*json)["sigma0_px"] = solution.sigma0 * mark_sigma_px;
  (*json)["observations"] = solution.observations;
  (*json)["unknowns"] = solution.unknowns;
  (*json)["redundancy"] = solution.redundancy;
  (*json)["iterations"] = solution.iterations;
}

struct PrintedParameter {
  double value, sigma;
};

// As DBAT's report.txt prints them. Its principal point counts from the frame's corner, y down.
const std::map<std::string, PrintedParameter> kCamcalReport = {
    {"c", {7.457, 0.00105}},           {"xp", {3.61546, 0.00082}},
    {"yp", {-2.61329, 0.00098}},       {"K1", {0.00458861, 2.21e-5}},
    {"K2", {-4.51351e-5, 2.65e-6}},    {"K3", {-2.05253e-6, 1.01e-7}},
    {"P1", {-6.12803e-5, 3.52e-6}},    {"P2", {-4.41171e-5, 3.94e-6}},
    {"aspect", {0.000389598, 2.08e-5}}};

Json::Value DbatCamcal(const fs::path& data) {
  Network network =
      ReadDbatProject(data / "calibration/dbat_camcal_c4040z/script/camcaldemo.xml").network;
  const NetworkSolution solution = SolveNetwork(&network);
  Json::Value json;
  AddSummary(solution, network.marks[0].sigma_px, &json);
  AddParameters(network, solution, &json);
  double largest = 0, largest_sigma = 0;
  for (const auto& [name, printed] : kCamcalReport) {
    Json::Value& parameter = json["parameters"][name];
    const double difference = (parameter["value"].asDouble() - printed.value) / printed.sigma;
    parameter["difference_in_sigma"] = difference;
    largest = std::max(largest, std::abs(difference));
    largest_sigma =
        std::max(largest_sigma, std::abs(parameter["sigma"].asDouble() / printed.sigma - 1));
  }
  json["max_parameter_difference_in_sigma"] = largest;
  json["max_relative_sigma_difference"] = largest_sigma;
  return json;
}

Json::Value SxbAerial(const fs::path& data) {
  ImportedProject project = ReadDbatProject(data / "adjustment/sxb_aerial/script/sxb.xml");
  Network& network = project.network;
  const NetworkSolution solution = SolveNetwork(&network);
  Json::Value json;
  AddSummary(solution, 0.5, &json);  // DBAT's unit: the first table's sigma
  const auto rms = [](double squares, size_t count) { return std::sqrt(squares / count); };
  double squares = 0;
  for (const ImportedCheckPoint& check : project.check_points) {
    squares += (network.points[check.point].position - check.position).squaredNorm();
  }
  json["check_points"] = static_cast<int>(project.check_points.size());
  json["check_rms_m"] = rms(squares, project.check_points.size());
  squares = 0;
  for (const ControlObservation& control : network.control) {
    squares += (network.points[control.point].position - control.position).squaredNorm();
  }
  json["control_rms_m"] = rms(squares, network.control.size());
  return json;
}

// Every point's and photo's block, so that the time counts them.
double SumOfVariances(const Network& network, const NetworkSolution& solution) {
  double sum = 0;
  for (const auto& column : solution.columns.point) {
    sum += Covariance(network, solution, *column, 3, *column, 3).trace();
  }
  for (const auto& column : solution.columns.rotation) {
    sum += Covariance(network, solution, *column, 6, *column, 6).trace();
  }
  return sum;
}

// COLMAP's own adjustment of the same start values with the lens held.
double SecondsOfColmap(const Network& network) {
  const fs::path folder = fs::temp_directory_path() / "insitu_roma_colmap";
  fs::remove_all(folder);
  fs::create_directories(folder / "out");
  WriteColmapText(folder / "in", ColmapFromNetwork(network));
  return SecondsOf([&] {
    RunExternal(
        {{"colmap", "bundle_adjuster", "--input_path", (folder / "in").string(), "--output_path",
          (folder / "out").string(), "--BundleAdjustment.refine_focal_length", "0",
          "--BundleAdjustment.refine_extra_params", "0"},
         "colmap",
         folder,
         folder / "log",
         folder / "log"});
  });
}

Json::Value RomaArch(const fs::path& data) {
  const Network start =
      ReadDbatProject(data / "adjustment/roma_arch/script/romabundledemo.xml").network;
  Json::Value json;
  Network network = start;
  NetworkSolution solution = SolveNetwork(&network);
  json["sigma0_px_self_calibration"] = solution.sigma0;
  json["redundancy"] = solution.redundancy;
  AddParameters(network, solution, &json);
  Network fixed = start;  // as DBAT's report of a fixed camera states it: with an aspect
  fixed.cameras[0].is_free.clear();
  std::get<MetricCamera>(fixed.cameras[0].lens).parameters[8] = 0.000998889;
  double variances = 0;
  network = fixed;
  json["seconds"] = SecondsOf([&] {
    solution = SolveNetwork(&network);
    variances = SumOfVariances(network, solution);
  });
  json["sigma0_px_fixed"] = solution.sigma0;
  json["redundancy_fixed"] = solution.redundancy;
  json["iterations_fixed"] = solution.iterations;
  json["sum_of_variances"] = variances;
  json["seconds_colmap"] = SecondsOfColmap(fixed);
  json["time_ratio_to_colmap"] = json["seconds"].asDouble() / json["seconds_colmap"].asDouble();
  return json;
}

// ---- synthetic -----------------------------------------------------------------------------

Json::Value Coverage(const fs::path&) {
  const NetworkStatistics statistics = SampleNetworkStatistics(500);
  Json::Value json;
  json["pose"] = statistics.coverage_95.pose;
  json["vertex"] = statistics.coverage_95.vertex;
  json["plane"] = statistics.coverage_95.plane;
  json["sun"] = statistics.coverage_95.sun;
  json["zenith"] = statistics.coverage_95.zenith;
  json["mean_sigma0"] = statistics.mean_sigma0;
  json["w_false_alarms_at_5_percent"] = statistics.false_alarm_share;
  json["global_test_rejected_at_5_percent"] = statistics.global_test_share;
  json["blunders_of_twice_the_detectable_bias_found"] = statistics.found_blunder_share;
  return json;
}

}  // namespace

const std::vector<ReconstructionFigure>& ReconstructionFigures() {
  static const std::vector<ReconstructionFigure> kFigures = {
      {"coverage_95", "", Coverage},
      {"jaicov_aicon", "adjustment/jaicov_aicon", JaicovAicon},
      {"dbat_camcal", "calibration/dbat_camcal_c4040z", DbatCamcal},
      {"sxb_aerial", "adjustment/sxb_aerial", SxbAerial},
      {"roma_arch", "adjustment/roma_arch", RomaArch},
  };
  return kFigures;
}

}  // namespace insitu
