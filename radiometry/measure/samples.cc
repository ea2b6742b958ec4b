// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/measure/samples.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "calibration/files/json_file.h"
#include "calibration/photo/raster.h"
#include "radiometry/library/material_library.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

// Survey noise leaves polygons that touch (a path on a lawn) centimetres apart: a polygon that
// close before the wanted one's plane does not hide it. [m]
constexpr double kCoplanar = 0.05;
constexpr double kRelativeFloor = 0.01;  // of a sample's sigma: one patch is not the material
constexpr double kAbsoluteFloor = 1e-6;  // for black

struct PolygonHit {
  int polygon = 0;
  Eigen::Vector3d point;  // [m], world
};

// The photographs with the polygons before them.
class PhotographedScene {
 public:
  PhotographedScene(const SceneGeometry& scene, const PhotographSet& photos)
      : scene_(scene), photos_(photos), polygons_(MeshOfPolygons(scene)), rays_(polygons_.mesh) {}

  const SceneGeometry& geometry() const { return scene_; }
  std::shared_ptr<const Photograph> photo(int index) const { return photos_[index]; }

  // The polygon that a pixel sees first.
  std::optional<PolygonHit> First(int photo, const Eigen::Vector2d& pixel) const {
    const PosedCamera& posed = scene_.cameras[photo];
    const Eigen::Vector3d center = Center(posed.cam_from_world);
    const Eigen::Vector3d direction =
        posed.cam_from_world.rotation.conjugate() * posed.camera.Unproject(pixel);
    const auto hit = rays_.Nearest({center - scene_.origin, direction});
    if (!hit) return std::nullopt;
    return PolygonHit{polygons_.polygon_of_triangle[hit->triangle],
                      center + hit->distance * direction};
  }

 private:
  const SceneGeometry& scene_;
  const PhotographSet& photos_;
  PolygonMesh polygons_;
  RayScene rays_;
};

// About a sample, which the page words too.
SaidError Fault(const JsonNode& node, const Sentence& message) {
  return {node.Error(message.text()), {node.path(), node.line()}, message};
}

int FindPhoto(const JsonNode& name, const SceneGeometry& scene) {
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (scene.cameras[i].photo == name.Text()) return static_cast<int>(i);
  }
  throw Fault(name, Sentence("sampleUnknownPhoto",
                             "is the unknown photo \"{photo}\", expected a reconstructed one",
                             {{"photo", name.Text()}}));
}

int FindPolygon(const JsonNode& name, const SceneGeometry& scene) {
  for (size_t i = 0; i < scene.polygons.size(); ++i) {
    if (scene.polygons[i].name == name.Text()) return static_cast<int>(i);
  }
  throw Fault(name, Sentence("sampleUnknownPolygon",
                             "is the unknown polygon \"{polygon}\", expected one of polygons.json",
                             {{"polygon", name.Text()}}));
}

bool IsInside(const Raster& image, int x, int y) {
  return x >= 0 && y >= 0 && x < image.width && y < image.height;
}

// The pixels about the sample that see the same thing first as its centre does.
std::vector<Eigen::Vector2i> Patch(const PhotographedScene& scene, const PixelSample& sample,
                                   int radius) {
  const auto polygon_at = [&](const Eigen::Vector2d& pixel) {
    const auto hit = scene.First(sample.photo, pixel);
    return hit ? std::optional(hit->polygon) : std::nullopt;
  };
  const auto photo = scene.photo(sample.photo);
  const std::optional<int> center_polygon = polygon_at(sample.pixel);
  const Eigen::Vector2i center = sample.pixel.array().round().cast<int>();
  std::vector<Eigen::Vector2i> patch;
  for (int y = center.y() - radius; y <= center.y() + radius; ++y) {
    for (int x = center.x() - radius; x <= center.x() + radius; ++x) {
      if (!IsInside(photo->linear, x, y)) continue;
      if (polygon_at(Eigen::Vector2d(x, y)) == center_polygon) patch.emplace_back(x, y);
    }
  }
  if (patch.empty()) patch.push_back(center);  // a sliver between pixel centres
  return patch;
}

void MeasureColor(const PhotographedScene& scene, const JsonNode& node, int radius,
                  PixelSample* sample) {
  const auto held = scene.photo(sample->photo);
  const Photograph& photo = *held;
  const std::vector<Eigen::Vector2i> patch = Patch(scene, *sample, radius);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector2i& at : patch) {
    if (IsClipped(photo, at.x(), at.y())) {
      throw Fault(node, Sentence("sampleClipped",
                                 "is clipped, expected a pixel below the sensor's brightest code"));
    }
    sum += photo.linear.Rgb(at.x(), at.y());
  }
  const double n = static_cast<double>(patch.size());
  sample->rgb = sum / n;
  Eigen::Array3d squares = Eigen::Array3d::Zero();
  for (const Eigen::Vector2i& at : patch) {
    squares += (photo.linear.Rgb(at.x(), at.y()) - sample->rgb).array().square();
  }
  const Eigen::Array3d variance = squares / std::max(1.0, n - 1);
  if (radius == 0) sample->rgb = Interpolate(photo.linear, sample->pixel);
  if (sample->rgb.sum() > 0) sample->unevenness = variance.sqrt().sum() / sample->rgb.sum();
  const Eigen::Array3d sigma_of_mean = (variance / n).sqrt();
  sample->rgb_sigma =
      sigma_of_mean.max(kRelativeFloor * sample->rgb.array()).max(kAbsoluteFloor).matrix();
}

// What is wrong with samples.json, gathered so that one run tells all of it.
class SampleFaults {
 public:
  // `listed`, if given, takes the faults, and none is thrown.
  explicit SampleFaults(std::vector<Sentence>* listed) : listed_(listed) {}

  bool is_listed() const { return listed_ != nullptr; }

  // Whether `read` went well.
  template <typename Read>
  bool Try(const Read& read) {
    try {
      read();
      return true;
    } catch (const InputError& fault) {
      if (listed_) {
        listed_->push_back(SentenceOf(fault));
      } else {
        if (texts_.empty()) first_ = std::current_exception();
        texts_.emplace_back(fault.what());
      }
      return false;
    }
  }

  void ThrowIfAny(const std::filesystem::path& file) const {
    if (texts_.empty()) return;
    if (texts_.size() == 1) std::rethrow_exception(first_);
    std::string all = std::to_string(texts_.size()) + " faults:";
    for (const std::string& text : texts_) all += "\n" + text;
    throw InputError(file, all);
  }

 private:
  std::vector<Sentence>* listed_;
  std::vector<std::string> texts_;
  std::exception_ptr first_;
};

PixelSample ReadPixel(const JsonNode& node, const PhotographedScene& scene) {
  PixelSample sample;
  sample.photo = FindPhoto(node.At("photo"), scene.geometry());
  sample.pixel = {node.At("x").Number(), node.At("y").Number()};
  sample.point.setZero();
  sample.place = {node.path(), node.line()};
  const auto photo = scene.photo(sample.photo);
  const Raster& image = photo->linear;
  const Eigen::Vector2i rounded = sample.pixel.array().round().cast<int>();
  if (!IsInside(image, rounded.x(), rounded.y())) {
    throw Fault(node,
                Sentence("sampleOutside",
                         "lies outside the photograph, expected a pixel of {width} x {height}",
                         {{"width", image.width}, {"height", image.height}}));
  }
  return sample;
}

void PlaceOnPolygon(const JsonNode& node, const PhotographedScene& scene, PixelSample& sample) {
  sample.polygon = FindPolygon(node.At("polygon"), scene.geometry());
  const PosedCamera& posed = scene.geometry().cameras[sample.photo];
  const Polygon& polygon = scene.geometry().polygons[*sample.polygon];
  const auto point = PointOnPolygon(posed, sample.pixel, polygon);
  if (!point) {
    throw Fault(node, Sentence("sampleMisses",
                               "misses polygon \"{polygon}\", expected a pixel that shows it",
                               {{"polygon", polygon.name}}));
  }
  sample.point = *point;
  sample.distance = (*point - Center(posed.cam_from_world)).norm();
  const auto first = scene.First(sample.photo, sample.pixel);
  if (!first || first->polygon == *sample.polygon) return;
  if (std::abs(polygon.normal.dot(first->point - *point)) > kCoplanar) {
    throw Fault(node, Sentence("sampleHidden",
                               "shows polygon \"{first}\" before polygon \"{polygon}\", expected a "
                               "free sight of it",
                               {{"first", scene.geometry().polygons[first->polygon].name},
                                {"polygon", polygon.name}}));
  }
}

PixelSample ReadSurfaceSample(const JsonNode& node, const PhotographedScene& scene, int radius) {
  PixelSample sample = ReadPixel(node, scene);
  PlaceOnPolygon(node, scene, sample);
  MeasureColor(scene, node, radius, &sample);
  return sample;
}

PixelSample ReadHorizonSample(const JsonNode& node, const PhotographedScene& scene, int radius) {
  PixelSample sample = ReadPixel(node, scene);
  if (const auto first = scene.First(sample.photo, sample.pixel)) {
    throw Fault(
        node, Sentence("sampleNoSky", "lies on polygon \"{polygon}\", expected a pixel of the sky",
                       {{"polygon", scene.geometry().polygons[first->polygon].name}}));
  }
  MeasureColor(scene, node, radius, &sample);
  return sample;
}

using ReadSample = PixelSample(const JsonNode&, const PhotographedScene&, int radius);

// Whether photo and polygon are known, where they are stated; each unknown one is a fault.
bool HasKnownNames(const JsonNode& node, const SceneGeometry& scene, SampleFaults* faults) {
  const bool knows_photo = faults->Try([&] { FindPhoto(node.At("photo"), scene); });
  return faults->Try([&] {
    if (const auto polygon = node.Find("polygon")) FindPolygon(*polygon, scene);
  }) && knows_photo;
}

// The samples of one list, read one by one.
std::vector<PixelSample> ReadList(const JsonNode& list, size_t at_least, ReadSample* read,
                                  const PhotographedScene& scene, int radius,
                                  SampleFaults* faults) {
  std::vector<PixelSample> samples;
  const std::vector<JsonNode> nodes = list.Items();
  if (!faults->is_listed() && nodes.size() < at_least) {
    faults->Try([&] {
      throw list.Error("has " + std::to_string(nodes.size()) + " samples, expected at least " +
                       std::to_string(at_least));
    });
  }
  for (const JsonNode& node : nodes) {
    if (!HasKnownNames(node, scene.geometry(), faults)) continue;
    faults->Try([&] { samples.push_back(read(node, scene, radius)); });
  }
  return samples;
}

// The list of this name; nullopt: it is missing, and may be.
std::optional<JsonNode> FindList(const JsonNode& file, const std::string& name, bool may_miss) {
  return may_miss ? file.Find(name) : std::optional(file.At(name));
}

void CheckDistancesDiffer(const JsonNode& nodes, const std::vector<PixelSample>& samples) {
  if (samples.size() < 2) return;  // the others are at fault
  const auto [nearest, farthest] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const auto& a, const auto& b) { return a.distance < b.distance; });
  if (farthest->distance <= nearest->distance) {
    throw nodes.Error("has samples at one distance only, expected different ones");
  }
}

Eigen::Vector3d ReadReflectance(const JsonNode& node) {
  const Eigen::Vector3d rgb = node.Vector3();
  if (rgb.minCoeff() <= 0 || rgb.maxCoeff() > 1) {
    throw node.Error("is not a reflectance, expected values above 0 and up to 1");
  }
  return rgb;
}

SpectralTable ReadMaterialTable(const MaterialLibrary& library, const JsonNode& name) {
  const LibraryEntry& entry = library.Material(name);
  SpectralTable table = ReflectanceOf(entry);
  RequireVisibleRange(table, name);
  const auto is_dark = [](const Eigen::Vector2d& row) { return row.y() <= 0; };
  if (std::ranges::any_of(table, is_dark)) {
    throw name.Error("reflects nothing at some wavelength, expected values above 0");
  }
  return table;
}

// What the file says of the samples' material and of the light on it.
void ReadSpectra(const SitePaths& site, const JsonNode& file, LightSamples* samples) {
  const auto rgb = file.Find("daylight_reflectance_rgb"), material = file.Find("daylight_material");
  const auto spectrum = file.Find("daylight_spectrum");
  if (rgb && material) {
    throw material->Error("stands beside daylight_reflectance_rgb, expected one of them");
  }
  if (rgb) samples->daylight_reflectance = ReadReflectance(*rgb);
  if (!material && !spectrum) return;
  const MaterialLibrary library(LibraryFolders(site));
  if (material) samples->reflectance_table = ReadMaterialTable(library, *material);
  if (spectrum) samples->daylight_spectrum = SpectrumOfLamp(library, *spectrum);
}

}  // namespace

void SampleOptions::Check() const { INSITU_CHECK(radius >= 0); }

LightSamples ReadSamples(const SitePaths& site, const SceneGeometry& scene,
                         const PhotographSet& photos, const SampleOptions& options,
                         std::vector<Sentence>* faults) {
  options.Check();
  INSITU_CHECK(photos.size() == scene.cameras.size());
  const PhotographedScene photographed(scene, photos);
  const JsonNode file = JsonNode::Load(site.survey() / "samples.json");
  LightSamples samples;
  SampleFaults gathered(faults);
  const auto read = [&](const JsonNode& list, size_t at_least, ReadSample* read_sample) {
    return ReadList(list, at_least, read_sample, photographed, options.radius, &gathered);
  };
  gathered.Try([&] {
    const auto horizon = FindList(file, "horizon", faults);
    if (horizon) samples.horizon = read(*horizon, 1, ReadHorizonSample);
  });
  gathered.Try([&] {
    const auto haze = file.Find("haze");
    if (!haze) return;
    samples.haze = read(*haze, 2, ReadSurfaceSample);
    if (!faults) CheckDistancesDiffer(*haze, samples.haze);
  });
  gathered.Try([&] {
    const auto daylight = FindList(file, "daylight", faults);
    if (daylight) samples.daylight = read(*daylight, 3, ReadSurfaceSample);
  });
  gathered.Try([&] { ReadSpectra(site, file, &samples); });
  gathered.ThrowIfAny(site.survey() / "samples.json");
  return samples;
}

}  // namespace insitu
