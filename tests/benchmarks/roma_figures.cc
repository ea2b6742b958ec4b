// SPDX-License-Identifier: GPL-3.0-or-later
// Beside DBAT's results and COLMAP's time.
#include <chrono>
#include <functional>

#include "calibration/external_program.h"
#include "reconstruction/colmap_export.h"
#include "reconstruction/colmap_model.h"
#include "reconstruction/import_project.h"
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

}  // namespace

Json::Value RomaFigures(const fs::path& data) {
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

}  // namespace insitu
