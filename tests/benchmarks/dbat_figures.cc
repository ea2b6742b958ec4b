// SPDX-License-Identifier: GPL-3.0-or-later
// Beside DBAT, the Damped Bundle Adjustment Toolbox.
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "calibration/files/error.h"
#include "reconstruction/exchange/import_dbat.h"
#include "tests/benchmarks/figure_parts.h"
#include "tests/benchmarks/reconstruction_figures.h"

namespace insitu {
namespace {
namespace fs = std::filesystem;

// ---- self-calibration ----------------------------------------------------------------------

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

// ---- control that is fixed or weighted, the lens held -------------------------------------

struct PrintedStation {
  Eigen::Vector3d center, sigma;  // [m]
};

// Xc, Yc, Zc of every photo of a report, in its order.
std::vector<PrintedStation> ReadStations(const fs::path& report) {
  std::vector<PrintedStation> stations;
  std::ifstream file(report);
  int axis = -1;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    double value = 0;
    words >> word;
    if (word == "Photo" && line.find(".JPG") != std::string::npos) stations.emplace_back();
    if (word.ends_with(":") && word != "Value:" && word != "Deviation:") {
      axis = word == "Xc:" ? 0 : word == "Yc:" ? 1 : word == "Zc:" ? 2 : -1;
    }
    if (stations.empty() || axis < 0 || !(words >> value)) continue;
    if (word == "Value:") stations.back().center[axis] = value;
    if (word == "Deviation:") stations.back().sigma[axis] = value;
  }
  return stations;
}

// The lens of PhotoModeler's export, which DBAT held: c xp yp, format, K1 K2 K3 P1 P2, in mm.
void HoldPhotomodelersLens(const fs::path& project, Network* network) {
  std::ifstream file(project);
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(file, line);
  std::istringstream words(line);
  double c, xp, yp, width, height, k1, k2, k3, p1, p2;
  if (!(words >> c >> xp >> yp >> width >> height >> k1 >> k2 >> k3 >> p1 >> p2)) {
    throw InputError(project, 4, "is no camera of PhotoModeler");
  }
  NetworkCamera& camera = network->cameras[0];
  MetricCamera& lens = std::get<MetricCamera>(camera.lens);
  lens.pixel_mm = {width / lens.width, height / lens.height};
  lens.parameters = {c, xp, -yp, k1, k2, k3, p1, p2, 0, 0};
  camera.is_free.clear();
}

// The reports' coordinates count from the middle of the sheet, taken from PhotoModeler's adjusted
// control: 2.5 um off in x where control is weighted.
const Eigen::Vector3d kMiddleOfTheSheet(0.5, 0.5, 0);

Json::Value Variant(const fs::path& folder, const std::string& name, double control_sigma) {
  Network network = ReadDbatProject(folder / "script/camcaldemo.xml").network;
  HoldPhotomodelersLens(folder / "photomodeler" / (name + "-no-orient-pmexport.txt"), &network);
  for (size_t i = 0; i < network.points.size(); ++i) {
    NetworkPoint& point = network.points[i];
    if (!point.is_fixed || control_sigma == 0) continue;
    point.is_fixed = false;
    network.control.push_back(
        {static_cast<int>(i), point.position, Eigen::Vector3d::Constant(control_sigma)});
  }
  const NetworkSolution solution = SolveNetwork(&network);
  Json::Value json;
  AddSummary(solution, network.marks[0].sigma_px, &json);
  const auto printed = ReadStations(folder / "dbat" / (name + "-no-orient-dbatreport.txt"));
  INSITU_CHECK(printed.size() == network.photos.size());
  double center = 0, sigma = 0;
  for (size_t i = 0; i < printed.size(); ++i) {
    const int column = *solution.columns.center[i];
    const Eigen::Vector3d own =
        Covariance(network, solution, column, 3, column, 3).diagonal().cwiseSqrt();
    const Eigen::Vector3d moved = network.photos[i].center - kMiddleOfTheSheet - printed[i].center;
    center = std::max(center, moved.cwiseAbs().maxCoeff());
    sigma = std::max(sigma, (own.cwiseQuotient(printed[i].sigma).array() - 1).abs().maxCoeff());
  }
  json["max_center_difference_mm"] = 1000 * center;
  json["max_relative_center_sigma_difference"] = sigma;
  return json;
}

}  // namespace

Json::Value DbatCamcalFigures(const fs::path& data) {
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
  const fs::path folder = data / "calibration/dbat_camcal_c4040z";
  json["fixed_control"] = Variant(folder, "fixed", 0);
  json["weighted_control"] = Variant(folder, "weighted", 0.001);
  return json;
}

Json::Value SxbFigures(const fs::path& data) {
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

}  // namespace insitu
