// SPDX-License-Identifier: GPL-3.0-or-later
// Position, orientation and scale of a network that its observations leave free.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reconstruction/network/network.h"
#include "reconstruction/network/network_system.h"
#include "reconstruction/network/statistics.h"

namespace insitu {

// The free motions at the network's present values: those that no surveyed coordinate, distance or
// height holds, nothing fixed, nothing observed against a fixed direction. Marks, planes and
// adjusted directions are taken not to see them. `rows` are
// those of the Jacobian.
Datum FindDatum(const Network& network, const NetworkColumns& columns,
                const std::vector<ObservationRow>& rows, const Jacobian& jacobian);

// From the same rows, and what is fixed as if known to a tenth of a millimetre.
DatumWorth FindDatumWorth(const Network& network, const NetworkColumns& columns,
                          const std::vector<ObservationRow>& rows, const Jacobian& jacobian);

// As many columns of photos as motions, whose values would fix the datum well. Photos, since some
// points may be far away and hardly determined.
std::vector<int> DatumPins(const Network& network, const NetworkColumns& columns,
                           const Datum& datum);

// B of the inner constraints B^T x = 0 over all points. [Meissl 1965; Granshaw 1980]
Eigen::MatrixXd InnerConstraints(const NetworkColumns& columns, const Datum& datum);

// Moves the whole network along the datum's motions so that its points lie as near as possible to
// `start_points` (as network->points, local).
void MoveToStart(const NetworkColumns& columns, const std::vector<Eigen::Vector3d>& start_points,
                 Network* network, Datum* datum);

}  // namespace insitu
