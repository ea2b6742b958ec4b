// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/figure_parts.h"

#include <cmath>

#include "calibration/lens/lens_residual.h"

namespace insitu {

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

void AddSummary(const NetworkSolution& solution, double mark_sigma_px, Json::Value* json) {
  (*json)["sigma0"] = solution.sigma0;
  (*json)["sigma0_px"] = solution.sigma0 * mark_sigma_px;
  (*json)["observations"] = solution.observations;
  (*json)["unknowns"] = solution.unknowns;
  (*json)["redundancy"] = solution.redundancy;
  (*json)["iterations"] = solution.iterations;
}

}  // namespace insitu
