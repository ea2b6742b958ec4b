// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the statistics of many adjusted networks are what theory says.
#pragma once

namespace insitu {

// Shares, over random networks and their coordinates.
struct IntervalCoverage {  // of true values within the reported 95 % intervals
  double pose = 0, vertex = 0, plane = 0, sun = 0, zenith = 0;
};
struct NetworkStatistics {
  IntervalCoverage coverage_95;
  double mean_sigma0 = 0;
  double false_alarm_share = 0;    // |w| over the critical value of 5 %, without blunders
  double found_blunder_share = 0;  // of twice the detectable bias, one a network, by the 0.1 % test
  double global_test_share = 0;    // rejected at 5 %
};

// Seeds 1 to `networks`.
NetworkStatistics SampleNetworkStatistics(int networks);

}  // namespace insitu
