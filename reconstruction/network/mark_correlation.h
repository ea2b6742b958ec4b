// SPDX-License-Identifier: GPL-3.0-or-later
// How alike the errors of neighbouring tie marks are: a thousand points of one wall, matched under
// one light from one place, are no thousand independent observations.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reconstruction/network/network.h"
#include "reconstruction/network/network_system.h"

namespace insitu {

// By how much the variance of a mean of a photo's tie marks exceeds that of as many independent
// ones, 1 or more [Kish, Survey Sampling, 1965, ch. 5: the design effect of clusters]. Products of
// neighbours' residuals over parts of a 16th to a quarter of the marked frame give a Gaussian
// correlation's share and length, and these the whole; what the photos' orientations have taken up
// of it is added. 1 with too few marks to tell. `residuals` over sigma, by row of `rows`.
double TieMarkInflation(const Network& network, const std::vector<ObservationRow>& rows,
                        const Eigen::VectorXd& residuals);

}  // namespace insitu
