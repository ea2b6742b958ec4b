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
//    seen_rms_px, seen_largest_px (where boards were seen), sigma_seen_px (ours, splined),
//    same_kind_seen_rms_px (BoofCV's and one of its kind on our corners)}.
// Why they differ: BoofCV's lens has two radial coefficients and no tangential ones, of which the
// corners know (p2 0.0025): a lens of its kind on our corners is theirs to a quarter of a sigma.
// OpenCV's corners are worse than ours, 0.39 px to 0.16, and its sigma is larger in that measure.
// The boards cover a third of the frame and know nothing of the rest.
Json::Value BoofcvFigures(const std::filesystem::path& shared, const std::filesystem::path& work);
Json::Value OpencvFigures(const std::filesystem::path& shared, const std::filesystem::path& work);

// dbat_camcal_c4040z and jaicov_aicon: how closely mrcal's models follow metric cameras.
//   {dbat_largest_deviation_px, aicon_largest_deviation_px}
Json::Value MetricFigures(const std::filesystem::path& shared);

}  // namespace insitu
