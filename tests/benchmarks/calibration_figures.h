// SPDX-License-Identifier: GPL-3.0-or-later
// What calibration/ reaches on the shared data sets, for a test and for scripts/bench.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <optional>

namespace insitu {

// The folder of the shared data: $INSITU_SHARED, else ../shared beside the repository; nullopt:
// there is none, or it lacks data/calibration.
std::optional<std::filesystem::path> SharedFolder();

// mrcal_figueroa_overpass: RMS of the embedded observations through our reader.
//   {opencv8: {rms_px, points, outliers, worst_px}, splined: {...}}, rms_px with mrcal's weights.
Json::Value FigueroaFigures(const std::filesystem::path& shared, const std::filesystem::path& work);

// A calibration from the pictures of a data set, against the intrinsics that came with it:
//   {rms_px, boards, their_rms_px (of their lens on our corners, poses solved again),
//    difference_rms_px, difference_largest_px (at infinity, whole frame),
//    seen_rms_px, seen_largest_px (where boards were seen), sigma_seen_px (ours, splined)}.
// Why they differ: BoofCV's lens has two radial coefficients and no tangential ones, of which the
// corners know (p2 0.0025); OpenCV's was fitted with square pixels and with the corners of left02,
// misplaced by 1.2 px, which mrcal refuses. The boards cover a third of the frame and know nothing
// of the rest.
Json::Value BoofcvFigures(const std::filesystem::path& shared, const std::filesystem::path& work);
Json::Value OpencvFigures(const std::filesystem::path& shared, const std::filesystem::path& work);

// dbat_camcal_c4040z and jaicov_aicon: how closely mrcal's models follow metric cameras.
//   {dbat_largest_deviation_px, aicon_largest_deviation_px}
Json::Value MetricFigures(const std::filesystem::path& shared);

}  // namespace insitu
