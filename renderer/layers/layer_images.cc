// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/layer_images.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/montage_files.h"
#include "renderer/layers/cryptomatte.h"
#include "renderer/tiles/finished_tile.h"

namespace insitu {
namespace {

constexpr char kMontage[] = "montage", kRest[] = "rest", kRestFine[] = "rest_fine";
constexpr char kObjects[] = "CryptoObject", kMaterials[] = "CryptoMaterial";

// First the photograph, then the light as LightPart has it, then grain.
const std::vector<std::string> kSummed = {
    "photo",
    "building_sun",
    "building_sky",
    "building_surroundings",
    "building_lamps",
    "building_reflection",
    "building_transmission",
    "building_haze",
    "sun_blocked",
    "sky_blocked",
    "surroundings_blocked",
    "bounced_light",
    "change_lamps",
    "change_reflection",
    "grain",
};
constexpr int kGrain = kLightParts + 1, kUncertainty = kGrain + 1, kTileLayers = kUncertainty + 1;
const std::vector<std::string> kOthers = {"coverage", "depth",    "normal",
                                          "object",   "material", "uncertainty"};

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

// A part of the file: channels of its own, named.
struct Part {
  std::string name;
  std::vector<std::string> channels;
};

// Channels of `images`, of one or three each, side by side, upright.
std::vector<float> Samples(const std::vector<const Raster*>& images, int orientation) {
  if (images.size() == 1 && images[0]->channels == 3) {
    CodedPhotograph picture;
    picture.width = images[0]->width;
    picture.height = images[0]->height;
    picture.samples = images[0]->data;
    return std::get<std::vector<float>>(Upright(std::move(picture), orientation).samples);
  }
  std::vector<float> samples(images.size() * images[0]->data.size());
  for (size_t c = 0; c < images.size(); ++c) {
    Raster grey(images[c]->width, images[c]->height);
    for (size_t i = 0; i < grey.data.size(); ++i) grey.data[i] = images[c]->data[i / 3];
    const std::vector<float> turned = Samples({&grey}, orientation);
    for (size_t i = 0; i < images[c]->data.size(); ++i) {
      samples[i * images.size() + c] = turned[3 * i];
    }
  }
  return samples;
}

// Two ranks a part, as the specification has them.
std::string RanksName(const char* matte, size_t first) {
  return std::string(matte) + "0" + std::to_string(first / 4);
}

// A part's channels bear its name: readers that do not know of parts (Blender 3.4) tell them apart
// by it. Those of the montage are plain, so that others show it.
std::vector<std::string> ChannelsOf(const std::string& part, const char* letters) {
  std::vector<std::string> channels;
  for (; *letters; ++letters) {
    channels.push_back(part == kMontage ? std::string(1, *letters) : part + "." + *letters);
  }
  return channels;
}

std::vector<Part> PartsOf(const std::vector<std::string>& chosen) {
  std::vector<Part> parts;
  for (const std::string& name : chosen) {
    if (name == "object" || name == "material") {
      for (size_t first = 0; first < 2 * size_t{kCryptomatteRanks}; first += 4) {
        const std::string own = RanksName(name == "object" ? kObjects : kMaterials, first);
        parts.push_back({own, ChannelsOf(own, "RGBA")});
      }
    } else {
      const char* letters = name == "coverage" ? "Y" : name == "depth" ? "Z" : "RGB";
      parts.push_back({name, ChannelsOf(name, name == "normal" ? "XYZ" : letters)});
    }
  }
  return parts;
}

using Attributes = std::map<std::string, std::string>;

void AddCryptomatte(const char* matte, const std::vector<std::string>& names,
                    Attributes* attributes) {
  const std::string key = "cryptomatte/" + CryptomatteKey(matte) + "/";
  (*attributes)[key + "name"] = matte;
  (*attributes)[key + "hash"] = "MurmurHash3_32";
  (*attributes)[key + "conversion"] = "uint32_to_float32";
  (*attributes)[key + "manifest"] = CryptomatteManifest(names);
}

// An EXR of many parts, written one after the other.
class PartsFile {
 public:
  // `attributes` go into every part: some readers look into the first alone.
  PartsFile(const std::filesystem::path& file, int width, int height,
            const std::vector<Part>& parts, const Attributes& attributes)
      : file_(file.string()), out_(OIIO::ImageOutput::create(file_)) {
    for (const Part& part : parts) {
      OIIO::ImageSpec spec(width, height, static_cast<int>(part.channels.size()), OIIO::TypeFloat);
      spec.channelnames = part.channels;
      spec.attribute("oiio:subimagename", part.name);
      spec.attribute("compression", "zip");
      for (const auto& [key, value] : attributes) spec.attribute(key, value);
      specs_.push_back(std::move(spec));
    }
    Require(out_ && out_->open(file_, static_cast<int>(specs_.size()), specs_.data()));
  }

  void Append(const std::vector<float>& samples) {
    if (next_ > 0) {
      Require(out_->open(file_, specs_.at(next_), OIIO::ImageOutput::AppendSubimage));
    }
    Require(out_->write_image(OIIO::TypeFloat, samples.data()));
    ++next_;
  }

  void Close() { Require(out_->close()); }

 private:
  void Require(bool is_good) const {
    if (is_good) return;
    throw std::runtime_error(
        file_ + ": cannot be written: " + (out_ ? out_->geterror() : OIIO::geterror()));
  }

  const std::string file_;
  const std::unique_ptr<OIIO::ImageOutput> out_;
  std::vector<OIIO::ImageSpec> specs_;
  size_t next_ = 0;
};

// Of `chosen`, those that are added up, in words.
std::string SumText(const std::vector<std::string>& chosen) {
  std::string text;
  for (const std::string& name : chosen) {
    const bool is_summed = name == kRest || name == kRestFine ||
                           std::find(kSummed.begin(), kSummed.end(), name) != kSummed.end();
    if (!is_summed) continue;
    text += text.empty() ? std::string(kMontage) + " = " : " + ";
    text += name;
  }
  return text;
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

std::vector<float> IdsOf(const std::vector<std::string>& names) {
  std::vector<float> ids;
  for (const std::string& name : names) ids.push_back(CryptomatteId(name));
  return ids;
}

}  // namespace

const std::vector<std::string>& LayerNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {kMontage};
    all.insert(all.end(), kSummed.begin(), kSummed.end());
    all.insert(all.end(), {kRest, kRestFine});
    all.insert(all.end(), kOthers.begin(), kOthers.end());
    return all;
  }();
  return names;
}

std::vector<std::string> ChosenLayers(const std::string& text) {
  if (text == "all") return LayerNames();
  std::set<std::string> wanted;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    wanted.insert(text.substr(at, end - at));
    at = end + 1;
  }
  if (std::ranges::any_of(kSummed, [&](const auto& name) { return wanted.contains(name); })) {
    wanted.insert({kRest, kRestFine});
  }
  std::string known;
  std::vector<std::string> chosen;
  for (const std::string& name : LayerNames()) {
    known += ", " + name;
    if (wanted.erase(name) > 0) chosen.push_back(name);
  }
  if (wanted.empty()) return chosen;
  throw InputError("--layers",
                   "there is no layer \"" + *wanted.begin() + "\", expected all" + known);
}

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
  if (IsChosen("object")) AddCryptomatte(kObjects, ObjectNames(things_), &attributes);
  if (IsChosen("material")) AddCryptomatte(kMaterials, MaterialNames(things_), &attributes);
  const bool is_turned = orientation >= 5;
  const int width = is_turned ? montage.height : montage.width;
  const int height = is_turned ? montage.width : montage.height;
  const auto write = [&](const std::filesystem::path& temporary) {
    PartsFile out(temporary, width, height, PartsOf(chosen_), attributes);
    const auto append = [&](const std::vector<const Raster*>& images) {
      out.Append(Samples(images, orientation));
    };
    Raster sum(montage.width, montage.height), fine;
    for (const std::string& name : chosen_) {
      const auto summed = std::find(kSummed.begin(), kSummed.end(), name);
      if (summed != kSummed.end() || name == "uncertainty") {
        const int layer = static_cast<int>(summed - kSummed.begin());
        const Raster image = Layer(layer, montage, gain.cast<float>());
        append({&image});
        if (layer != kUncertainty) AddUp(image, &sum);
      } else if (name == kRest) {
        fine = LeaveRest(montage, &sum);
        append({&sum});
      } else if (name == "object" || name == "material") {
        const auto& ranks = name == "object" ? object_ranks_ : material_ranks_;
        for (size_t i = 0; i < ranks.size(); i += 4) {
          append({&ranks[i], &ranks[i + 1], &ranks[i + 2], &ranks[i + 3]});
        }
      } else {
        append({name == kMontage     ? &montage
                : name == kRestFine  ? &fine
                : name == "coverage" ? &coverage_
                : name == "depth"    ? &distance_
                                     : &normal_});
      }
    }
    out.Close();
  };
  WriteWhole(file, write);
}

}  // namespace insitu
