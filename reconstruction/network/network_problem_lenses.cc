// SPDX-License-Identifier: GPL-3.0-or-later
// The lenses of a NetworkProblem: as unknowns, and as their calibration observed them.
#include <algorithm>

#include "calibration/files/error.h"
#include "reconstruction/network/network_problem.h"
#include "reconstruction/network/observation_costs.h"

namespace insitu {

void NetworkProblem::AddCameras() {
  columns_.camera.resize(network_.cameras.size());
  for (int i = 0; i < static_cast<int>(network_.cameras.size()); ++i) {
    const NetworkCamera& camera = network_.cameras[i];
    const bool is_adjusted =
        std::find(camera.is_free.begin(), camera.is_free.end(), true) != camera.is_free.end();
    if (!is_adjusted) continue;
    const int size = static_cast<int>(lens_parameters_[i].size());
    INSITU_CHECK(static_cast<int>(camera.is_free.size()) == size);
    std::vector<int> held;
    for (int k = 0; k < size; ++k) {
      if (!camera.is_free[k]) held.push_back(k);
    }
    ceres::Manifold* manifold = nullptr;
    if (!held.empty()) manifold = &lens_manifolds_.emplace_back(size, held);
    columns_.camera[i] =
        AddBlock(lens_parameters_[i].data(), size, manifold, {Unknown::Kind::kCamera, i});
  }
}

void NetworkProblem::AddLenses() {
  for (int i = 0; i < static_cast<int>(network_.lenses.size()); ++i) {
    const LensObservation& lens = network_.lenses[i];
    if (!columns_.camera[lens.camera]) continue;
    ceres::CostFunction* cost = LensCost(lens, network_.cameras[lens.camera].is_free);
    AddResidual(ObservationKind::kLens, i, cost, {lens_parameters_[lens.camera].data()},
                std::vector<double>(static_cast<size_t>(cost->num_residuals()), 1.0));
  }
}

}  // namespace insitu
