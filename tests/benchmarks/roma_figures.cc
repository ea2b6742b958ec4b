// SPDX-License-Identifier: GPL-3.0-or-later
// Beside DBAT's results and COLMAP's time.
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>

#include "calibration/files/error.h"
#include "reconstruction/colmap/colmap_model.h"
#include "reconstruction/colmap/colmap_text.h"
#include "reconstruction/colmap_export.h"
#include "reconstruction/exchange/import_dbat.h"
#include "tests/benchmarks/figure_parts.h"
#include "tests/benchmarks/reconstruction_figures.h"

namespace insitu {
namespace {
namespace fs = std::filesystem;

double SecondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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

// COLMAP's own adjustment of the same start values with the lens held, on as many threads as it
// likes: its time, and how many iterations it made. It gives no covariances.
void TimeColmap(const Network& network, Json::Value* json) {
  const fs::path folder = fs::temp_directory_path() / "insitu_roma_colmap";
  fs::remove_all(folder);
  fs::create_directories(folder / "out");
  WriteColmapText(folder / "in", ColmapFromNetwork(network));
  const std::string command =
      "cd '" + folder.string() +
      "' && colmap bundle_adjuster --input_path in --output_path out "
      "--BundleAdjustment.refine_focal_length 0 --BundleAdjustment.refine_extra_params 0 >log 2>&1";
  (*json)["seconds_colmap"] = SecondsOf([&] {
    if (std::system(command.c_str()) != 0) throw InputError(folder / "log", "COLMAP failed");
  });
  std::ifstream log(folder / "log");
  for (std::string line; std::getline(log, line);) {
    std::istringstream words(line.substr(std::min(line.size(), line.find(':') + 1)));
    int count = 0;
    if (line.find("Iterations :") != std::string::npos && words >> count) {
      (*json)["iterations_colmap"] = count;
    }
  }
}

Network RomaStart(const fs::path& data) {
  return ReadDbatProject(data / "adjustment/roma_arch/script/romabundledemo.xml").network;
}

// As DBAT's report of a fixed camera states it: with an aspect.
Network WithFixedCamera(Network network) {
  network.cameras[0].is_free.clear();
  std::get<MetricCamera>(network.cameras[0].lens).parameters[8] = 0.000998889;
  return network;
}

}  // namespace

Json::Value RomaAccuracy(const fs::path& data) {
  Json::Value json;
  Network network = RomaStart(data);
  NetworkSolution solution = SolveNetwork(&network);
  json["sigma0_px_self_calibration"] = solution.sigma0;
  json["redundancy"] = solution.redundancy;
  AddParameters(network, solution, &json);
  network = WithFixedCamera(RomaStart(data));
  solution = SolveNetwork(&network);
  json["sigma0_px_fixed"] = solution.sigma0;
  json["redundancy_fixed"] = solution.redundancy;
  json["iterations_fixed"] = solution.iterations;
  return json;
}

Json::Value RomaFigures(const fs::path& data) {
  Json::Value json = RomaAccuracy(data);
  const Network start = WithFixedCamera(RomaStart(data));
  json["seconds"] = SecondsOf([&] {
    Network network = start;
    const NetworkSolution solution = SolveNetwork(&network);
    json["sum_of_variances"] = SumOfVariances(network, solution);
  });
  TimeColmap(start, &json);
  json["time_ratio_to_colmap"] = json["seconds"].asDouble() / json["seconds_colmap"].asDouble();
  // Had COLMAP stopped after as many iterations as ours took.
  json["time_ratio_per_iteration"] = json["time_ratio_to_colmap"].asDouble() *
                                     json["iterations_colmap"].asDouble() /
                                     json["iterations_fixed"].asDouble();
  return json;
}

}  // namespace insitu
