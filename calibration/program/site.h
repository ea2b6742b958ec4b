// SPDX-License-Identifier: GPL-3.0-or-later
// The layout of a site folder: where each stage finds its input and leaves its results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace insitu {

struct SitePaths {
  std::filesystem::path root;
  // The design that is put into the photographs: a folder of variants/; "": that in building/.
  std::string variant = {};
  // The light of another hour: a folder of work/hours/; "": that of the photographs.
  std::string hour = {};
  // Results of lesser quality that stand beside the others are named by it; "": they do not.
  std::string beside = {};

  std::filesystem::path photos() const { return root / "photos"; }
  std::filesystem::path boards() const { return root / "calibration"; }
  std::filesystem::path brought_camera() const { return root / "calibration/camera.cameramodel"; }
  std::filesystem::path survey() const { return root / "survey"; }
  std::filesystem::path variants() const { return root / "variants"; }
  std::filesystem::path building() const {
    return variant.empty() ? root / "building" : variants() / variant;
  }
  std::filesystem::path montages() const {
    return variant.empty() ? root / "montages" : root / "montages" / variant;
  }
  // What is made of this design and of nothing else: its description, renders at work.
  std::filesystem::path design() const {
    return variant.empty() ? root / "work" : root / "work/variants" / variant;
  }

  std::filesystem::path description() const { return root / "site.json"; }

  // What results and renders at work are named by, "IMG_1@1630~draft".
  std::string result_name(const std::string& photo) const {
    return photo + (hour.empty() ? "" : "@" + hour) + (beside.empty() ? "" : "~" + beside);
  }
  // Without ending.
  std::filesystem::path montage(const std::string& photo) const {
    return montages() / result_name(photo);
  }
  std::filesystem::path hours() const { return root / "work/hours"; }
  // The photograph as it would be at the hour, in its own frame and without its lens's distortion.
  std::filesystem::path relit_photo(const std::string& photo) const {
    return hours() / hour / "photos" / (photo + ".exr");
  }
  std::filesystem::path relit_input_image(const std::string& photo) const {
    return hours() / hour / "input_images" / (photo + ".exr");
  }

  // `camera` is a camera's name, as CamerasOfPhotos gives it; "" is the only camera of a site.
  std::filesystem::path camera(const std::string& camera = "") const {
    return root / "work/calibration" / camera / "camera.cameramodel";
  }
  std::filesystem::path calibration_report(const std::string& camera = "") const {
    return root / "work/calibration" / camera / "report.json";
  }
  std::filesystem::path calibration_page(const std::string& camera = "") const {
    return root / "work/calibration" / camera / "report.html";
  }
  std::filesystem::path input_image(const std::string& photo) const {
    return root / "work/input_images" / (photo + ".exr");
  }
  std::filesystem::path pinhole_camera(const std::string& camera = "") const {
    return root / "work/input_images" /
           ((camera.empty() ? "pinhole" : "pinhole_" + camera) + ".cameramodel");
  }
  std::filesystem::path tie_points() const { return root / "work/tie_points/tie_points.json"; }
  std::filesystem::path posed_camera(const std::string& photo) const {
    return root / "work/reconstruction" / (photo + ".cameramodel");
  }
  // The lens that a self-calibrating adjustment found; goes before camera() where it is.
  std::filesystem::path adjusted_camera(const std::string& camera = "") const {
    return root / "work/reconstruction/lenses" /
           ((camera.empty() ? "camera" : camera) + ".cameramodel");
  }
  std::filesystem::path scene() const { return root / "work/reconstruction/scene.json"; }
  std::filesystem::path residual_report() const { return root / "work/reconstruction/report.json"; }
  std::filesystem::path residual_page() const { return root / "work/reconstruction/report.html"; }
  std::filesystem::path observations_csv() const {
    return root / "work/reconstruction/observations.csv";
  }
  std::filesystem::path points_csv() const { return root / "work/reconstruction/points.csv"; }
  std::filesystem::path lock() const { return root / "work/.lock"; }
  // What insitu-montage keeps of its stages; of those that make the building, by design.
  std::filesystem::path stages() const { return design() / "stages"; }
  std::filesystem::path environment() const {
    return (hour.empty() ? root / "work" : hours() / hour) / "environment.json";
  }
  std::filesystem::path artificial() const { return design() / "building.json"; }
  std::filesystem::path render_record(const std::string& photo) const {
    return design() / "render" / (result_name(photo) + ".json");
  }
  std::filesystem::path partial_render(const std::string& photo) const {
    return design() / "render" / (result_name(photo) + ".partial");
  }
  // Light among surfaces, kept for the next render.
  std::filesystem::path light_cache() const {
    return design() / "render" / (result_name("light") + ".cache");
  }
};

// Throws InputError, naming those there are: the site has no such variant, or its name is no
// folder's.
void RequireVariant(const SitePaths& site);

// The same of an hour.
void RequireHour(const SitePaths& site);

// Whether a name ends as the photographs do that we read, in any case: JPEG, PNG, TIFF, EXR and
// raw.
bool HasPhotographEnding(const std::filesystem::path& name);

// Whether a path is a file that ends so and is not hidden.
bool IsPhotograph(const std::filesystem::path& path);

// Throws InputError naming the program to run first, if a stage's result is not there.
void RequireResult(const std::filesystem::path& result, const std::string& program);

// The site's photographs, sorted by name (their stem is the photo's name everywhere). Of a raw and
// another file of one name the other file.
// Throws InputError: no photos folder, no photographs in it, two with one name.
std::vector<std::filesystem::path> ListPhotographs(const SitePaths& site);

}  // namespace insitu
