// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures of several data sets say in the same way.
#pragma once

#include <json/value.h>

#include "reconstruction/network/solve_network.h"

namespace insitu {

// parameters: {NAME: {value, sigma}}, of the adjusted ones of the first camera.
void AddParameters(const Network& network, const NetworkSolution& solution, Json::Value* json);

// sigma0, sigma0_px, observations, unknowns, redundancy, iterations.
void AddSummary(const NetworkSolution& solution, double mark_sigma_px, Json::Value* json);

}  // namespace insitu
