// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/layer_images.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <utility>

#include "calibration/files/whole_file.h"
#include "renderer/layers/cryptomatte.h"
#include "renderer/layers/layer_names.h"
#include "renderer/layers/parts_file.h"
#include "renderer/tiles/finished_tile.h"

namespace insitu {
namespace {

constexpr int kGrain = kLightParts + 1, kUncertainty = kGrain + 1, kTileLayers = kUncertainty + 1;

// What is to be added to `sum` for `wanted` to come out, in one step or, where no float does it, in
// two: the first brings the sum to zero.
struct Rest {
  float coarse = 0, fine = 0;
};
Rest RestOf(float sum, float wanted) {
  const float rest = wanted - sum;
  for (const float tried :
       {rest, std::nextafterf(rest, INFINITY), std::nextafterf(rest, -INFINITY)}) {
    if (sum + tried == wanted) return {tried, 0};
  }
  return {-sum, wanted};
}

void SetRanks(const std::map<int, double>& shares, const std::vector<float>& ids, int x, int y,
              std::vector<Raster>* ranks) {
  const std::vector<float> values = CryptomatteRanks(shares, ids);
  for (size_t i = 0; i < ranks->size(); ++i) *(*ranks)[i].At(x, y) = values[i];
}

// Of what the building receives and the site loses or gains, by light and by rays; the site's
// change is proportional to the light at most.
Eigen::Vector3d UncertaintyOf(const LayeredPixel& pixel, const LightErrors& errors) {
  const auto of = [&](LightPart a, LightPart b) -> Eigen::Array3d {
    return (pixel.light[a] + pixel.light[b]).array();
  };
  const Eigen::Array3d variance = (of(kBuildingSun, kSunBlocked) * errors.sun.array()).square() +
                                  (of(kBuildingSky, kSkyBlocked) * errors.sky.array()).square() +
                                  pixel.ray_error.array().square();
  return variance.sqrt();
}

// `sum` becomes what is to be added to it first, what is returned second, for `wanted` to come out.
Raster LeaveRest(const Raster& wanted, Raster* sum) {
  Raster fine(wanted.width, wanted.height);
  for (size_t i = 0; i < wanted.data.size(); ++i) {
    const Rest rest = RestOf(sum->data[i], wanted.data[i]);
    sum->data[i] = rest.coarse;
    fine.data[i] = rest.fine;
  }
  return fine;
}

void AddUp(const Raster& layer, Raster* sum) {
  for (size_t i = 0; i < layer.data.size(); ++i) sum->data[i] += layer.data[i];
}

// The building is one object; its materials and the site's are told apart.
std::vector<std::string> ObjectNames(const LayerThings& things) {
  std::vector<std::string> names = things.polygons;
  names.emplace_back("building");
  return names;
}
std::vector<std::string> MaterialNames(const LayerThings& things) {
  std::vector<std::string> names = things.materials;
  for (const std::string& name : things.polygon_materials) names.push_back("site:" + name);
  return names;
}

// Which layers bytes of a tile are of.
std::string ChoiceText(const std::vector<std::string>& chosen) {
  std::string text;
  for (const std::string& name : chosen) text += name + " ";
  return text + "\n";
}

size_t RowBytes(const Raster& image, const Tile& tile) {
  return static_cast<size_t>(tile.right - tile.left) * static_cast<size_t>(image.channels) *
         sizeof(float);
}

std::vector<float> IdsOf(const std::vector<std::string>& names) {
  std::vector<float> ids;
  for (const std::string& name : names) ids.push_back(CryptomatteId(name));
  return ids;
}

}  // namespace

LayerThings ThingsOf(const MontageScene& scene, const ArtificialEnvironment& building,
                     const LightErrors& errors) {
  LayerThings things;
  for (const Polygon& polygon : scene.natural.scene.polygons) {
    things.polygons.push_back(polygon.name);
    things.polygon_materials.push_back(polygon.material);
  }
  for (const SurfaceMaterial& material : building.materials) {
    things.materials.push_back(material.name);
  }
  things.errors = errors;
  return things;
}

// Of a tile with a computed pixel.
struct LayerImages::TileLayers {
  explicit TileLayers(const Tile& tile)
      : is_computed(static_cast<size_t>(tile.pixels())),
        samples(is_computed.size() * 3 * kTileLayers) {}

  float* At(int layer, size_t pixel) {
    return &samples[(static_cast<size_t>(layer) * is_computed.size() + pixel) * 3];
  }
  void Set(int layer, size_t pixel, const Eigen::Vector3d& rgb) {
    for (int c = 0; c < 3; ++c) At(layer, pixel)[c] = static_cast<float>(rgb[c]);
  }

  std::vector<char> is_computed;
  std::vector<float> samples;
};

LayerImages::LayerImages(const Raster& photo, const Foreground* foreground, LayerThings things,
                         std::vector<std::string> chosen)
    : photo_(photo),
      foreground_(foreground),
      things_(std::move(things)),
      chosen_(std::move(chosen)),
      object_ids_(IdsOf(ObjectNames(things_))),
      material_ids_(IdsOf(MaterialNames(things_))),
      tiles_(static_cast<size_t>(TileCount(photo.width, photo.height))) {
  const Raster grey(photo.width, photo.height, 1);
  if (IsChosen("coverage")) coverage_ = grey;
  if (IsChosen("depth")) distance_ = grey;
  if (IsChosen("normal")) normal_ = Raster(photo.width, photo.height);
  const size_t ranks = 2 * size_t{kCryptomatteRanks};
  if (IsChosen("object")) object_ranks_.assign(ranks, grey);
  if (IsChosen("material")) material_ranks_.assign(ranks, grey);
  for (Raster* image : {&coverage_, &distance_, &normal_}) {
    if (!image->data.empty()) filled_.push_back(image);
  }
  for (auto* all : {&object_ranks_, &material_ranks_}) {
    for (Raster& image : *all) filled_.push_back(&image);
  }
}

LayerImages::~LayerImages() = default;

bool LayerImages::IsChosen(const char* name) const {
  return std::find(chosen_.begin(), chosen_.end(), name) != chosen_.end();
}

void LayerImages::Take(int x, int y, const LayeredPixel& pixel) {
  if (IsChosen("coverage")) *coverage_.At(x, y) = static_cast<float>(pixel.seen * pixel.coverage);
  if (IsChosen("depth")) *distance_.At(x, y) = static_cast<float>(pixel.distance);
  if (IsChosen("normal")) normal_.SetRgb(x, y, pixel.normal);
  std::map<int, double> objects = pixel.polygons, materials = pixel.materials;
  const int site = static_cast<int>(things_.materials.size());
  for (const auto& [polygon, share] : pixel.polygons) materials[site + polygon] = share;
  double building = 0;
  for (const auto& [material, share] : pixel.materials) building += share;
  if (building > 0) objects[static_cast<int>(things_.polygons.size())] = building;
  SetRanks(objects, object_ids_, x, y, &object_ranks_);
  SetRanks(materials, material_ids_, x, y, &material_ranks_);
  if (!pixel.is_computed) return;
  const int across = (photo_.width + kRenderTile - 1) / kRenderTile;
  const int index = y / kRenderTile * across + x / kRenderTile;
  const Tile tile = TileAt(photo_.width, photo_.height, index);
  auto& layers = tiles_[static_cast<size_t>(index)];
  if (!layers) layers = std::make_unique<TileLayers>(tile);
  const size_t at =
      static_cast<size_t>(y - tile.top) * static_cast<size_t>(tile.right - tile.left) +
      static_cast<size_t>(x - tile.left);
  layers->is_computed[at] = 1;
  const Eigen::Vector3d behind = foreground_ ? foreground_->behind.Rgb(x, y) : photo_.Rgb(x, y);
  layers->Set(0, at, photo_.Rgb(x, y) - pixel.seen * pixel.coverage * behind);
  for (int part = 0; part < kLightParts; ++part) {
    layers->Set(part + 1, at, pixel.seen * pixel.light[static_cast<size_t>(part)]);
  }
  layers->Set(kGrain, at, pixel.seen * pixel.grain);
  layers->Set(kUncertainty, at, pixel.seen * UncertaintyOf(pixel, things_.errors));
}

std::string LayerImages::TileBytes(int index) const {
  const Tile tile = TileAt(photo_.width, photo_.height, index);
  std::string bytes = ChoiceText(chosen_);
  const auto append = [&](const void* from, size_t size) {
    bytes.append(static_cast<const char*>(from), size);
  };
  for (const Raster* image : filled_) {
    for (int y = tile.top; y < tile.bottom; ++y) {
      append(image->At(tile.left, y), RowBytes(*image, tile));
    }
  }
  if (const auto& layers = tiles_[static_cast<size_t>(index)]) {
    append(layers->is_computed.data(), layers->is_computed.size());
    append(layers->samples.data(), layers->samples.size() * sizeof(float));
  }
  return bytes;
}

bool LayerImages::TakeTile(int index, const std::string& bytes) {
  const Tile tile = TileAt(photo_.width, photo_.height, index);
  const std::string choice = ChoiceText(chosen_);
  auto layers = std::make_unique<TileLayers>(tile);
  size_t images = choice.size();
  for (const Raster* image : filled_) {
    images += static_cast<size_t>(tile.bottom - tile.top) * RowBytes(*image, tile);
  }
  const size_t samples = layers->samples.size() * sizeof(float);
  const size_t all = images + layers->is_computed.size() + samples;
  if (!bytes.starts_with(choice) || (bytes.size() != images && bytes.size() != all)) return false;
  const char* from = bytes.data() + choice.size();
  const auto take = [&](void* to, size_t size) {
    std::memcpy(to, from, size);
    from += size;
  };
  for (Raster* image : filled_) {
    for (int y = tile.top; y < tile.bottom; ++y) {
      take(image->At(tile.left, y), RowBytes(*image, tile));
    }
  }
  if (bytes.size() == images) return true;
  take(layers->is_computed.data(), layers->is_computed.size());
  take(layers->samples.data(), samples);
  tiles_[static_cast<size_t>(index)] = std::move(layers);
  return true;
}

Raster LayerImages::Layer(int layer, const Raster& montage, const Eigen::Vector3f& gain) const {
  Raster image = layer == 0 ? montage : Raster(montage.width, montage.height);
  for (size_t index = 0; index < tiles_.size(); ++index) {
    if (!tiles_[index]) continue;
    const Tile tile = TileAt(montage.width, montage.height, static_cast<int>(index));
    size_t at = 0;
    for (int y = tile.top; y < tile.bottom; ++y) {
      for (int x = tile.left; x < tile.right; ++x, ++at) {
        if (!tiles_[index]->is_computed[at]) continue;
        for (int c = 0; c < 3; ++c) {
          image.At(x, y)[c] = gain[c] * tiles_[index]->At(layer, at)[c];
        }
      }
    }
  }
  return image;
}

void LayerImages::Write(const std::filesystem::path& file, const Raster& montage,
                        const Eigen::Vector3d& gain, int orientation) const {
  Attributes attributes = {{"insituSum", SumText(chosen_)}};
  if (IsChosen("object")) AddCryptomatte(kObjectMatte, ObjectNames(things_), &attributes);
  if (IsChosen("material")) AddCryptomatte(kMaterialMatte, MaterialNames(things_), &attributes);
  const bool is_turned = orientation >= 5;
  const int width = is_turned ? montage.height : montage.width;
  const int height = is_turned ? montage.width : montage.height;
  const auto write = [&](const std::filesystem::path& temporary) {
    PartsFile out(temporary, width, height, PartsOf(chosen_), attributes);
    const auto append = [&](const std::vector<const Raster*>& images) {
      out.Append(PartSamples(images, orientation));
    };
    Raster sum(montage.width, montage.height), fine;
    for (const std::string& name : chosen_) {
      const auto summed = std::ranges::find(SummedLayers(), name);
      if (summed != SummedLayers().end() || name == "uncertainty") {
        const int layer = static_cast<int>(summed - SummedLayers().begin());
        const Raster image = Layer(layer, montage, gain.cast<float>());
        append({&image});
        if (layer != kUncertainty) AddUp(image, &sum);
      } else if (name == kRestLayer) {
        fine = LeaveRest(montage, &sum);
        append({&sum});
      } else if (name == "object" || name == "material") {
        const auto& ranks = name == "object" ? object_ranks_ : material_ranks_;
        for (size_t i = 0; i < ranks.size(); i += 4) {
          append({&ranks[i], &ranks[i + 1], &ranks[i + 2], &ranks[i + 3]});
        }
      } else {
        append({name == kMontageLayer    ? &montage
                : name == kRestFineLayer ? &fine
                : name == "coverage"     ? &coverage_
                : name == "depth"        ? &distance_
                                         : &normal_});
      }
    }
    out.Close();
  };
  WriteWhole(file, write);
}

}  // namespace insitu
