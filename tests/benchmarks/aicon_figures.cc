// SPDX-License-Identifier: GPL-3.0-or-later
// Beside AICON 3D Studio.
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "reconstruction/exchange/import_aicon.h"
#include "tests/benchmarks/figure_parts.h"
#include "tests/benchmarks/reconstruction_figures.h"

namespace insitu {
namespace {
namespace fs = std::filesystem;

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
    if (at.kind != ObservationRow::Kind::kMark) continue;
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

struct PrintedParameter {
  double value, sigma;
};

// As example.htm prints them; its principal distance is negative.
const std::map<std::string, PrintedParameter> kLens = {
    {"c", {28.78507, 2.513178e-4}},      {"xh", {1.734892e-2, 3.441658e-4}},
    {"yh", {5.668731e-2, 3.262600e-4}},  {"A1", {-1.096069e-4, 2.978787e-8}},
    {"A2", {1.495660e-7, 7.655524e-11}}, {"B1", {5.798428e-6, 1.190972e-7}},
    {"B2", {-8.644540e-6, 1.043919e-7}}};

// Of the parameters that AddParameters listed.
void CompareLens(Json::Value* json) {
  double value = 0, sigma = 0;
  for (const auto& [name, printed] : kLens) {
    const Json::Value& own = (*json)["parameters"][name];
    value = std::max(value, std::abs(own["value"].asDouble() - printed.value) / printed.sigma);
    sigma = std::max(sigma, std::abs(own["sigma"].asDouble() / printed.sigma - 1));
  }
  (*json)["max_lens_difference_in_sigma"] = value;
  (*json)["max_relative_lens_sigma_difference"] = sigma;
}

}  // namespace

Json::Value AiconFigures(const fs::path& data) {
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
  CompareLens(&json);
  return json;
}

}  // namespace insitu
