// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/site_pictures.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/exif.h"
#include "renderer/view/made_pictures.h"
#include "renderer/view/part_picture.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostInMemory = 6;  // decoded pictures

// A channel of what stands beside a montage, a share of each pixel.
struct ShareLayer {
  const char* name;
  const char* ending;
  int channel;
};
constexpr std::array<ShareLayer, 5> kLayers = {{{"photograph", ".layers.exr", 0},
                                                {"computed", ".layers.exr", 1},
                                                {"front", ".layers.exr", 2},
                                                {"sunlit", ".shadows.exr", 0},
                                                {"unseen", ".unseen.exr", 0}}};
constexpr std::array kBeside = {".layers", ".shadows", ".unseen", ".parts"};

struct MontageFile {
  fs::path path;
  std::string variant;  // "": the site's own; "@0915" of another hour, "~fast" of lesser quality
};

bool IsMontageOf(const fs::path& file, const std::string& photo) {
  if (file.extension() != ".exr") return false;
  const std::string stem = file.stem().string();
  if (stem == photo) return true;
  if (!stem.starts_with(photo + "@") && !stem.starts_with(photo + "~")) return false;
  return std::ranges::none_of(kBeside, [&](const char* end) { return stem.ends_with(end); });
}

fs::path Beside(const MontageFile& montage, const std::string& ending) {
  return montage.path.parent_path() / (montage.path.stem().string() + ending);
}

// "tall@0915~fast"
SitePaths PathsOf(const SitePaths& site, const std::string& variant) {
  const size_t quality = std::min(variant.find('~'), variant.size());
  const size_t hour = std::min(variant.find('@'), quality);
  SitePaths paths{site.root, variant.substr(0, hour)};
  if (hour < quality) paths.hour = variant.substr(hour + 1, quality - hour - 1);
  if (quality < variant.size()) paths.beside = variant.substr(quality + 1);
  return paths;
}

void AddMontagesIn(const fs::path& folder, const std::string& variant, const std::string& photo,
                   std::vector<MontageFile>* montages) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (!entry.is_regular_file() || !IsMontageOf(entry.path(), photo)) continue;
    montages->push_back(
        {entry.path(), variant + entry.path().stem().string().substr(photo.size())});
  }
}

std::vector<MontageFile> MontagesOf(const SitePaths& site, const std::string& photo) {
  std::vector<MontageFile> montages;
  AddMontagesIn(site.montages(), "", photo, &montages);
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(site.montages(), none)) {
    if (!entry.is_directory()) continue;
    AddMontagesIn(entry.path(), entry.path().filename().string(), photo, &montages);
  }
  std::sort(montages.begin(), montages.end(),
            [](const MontageFile& a, const MontageFile& b) { return a.variant < b.variant; });
  return montages;
}

}  // namespace

SitePictures::SitePictures(const SitePaths& site, const RunningRenders& renders)
    : site_(site), renders_(renders), photographs_(ListPhotographs(site)) {}

int SitePictures::Known(const std::string& key, const std::function<Entry()>& make) {
  const auto found = ids_.find(key);
  if (found != ids_.end()) return found->second;
  entries_.push_back(make());
  const int id = static_cast<int>(entries_.size()) - 1;
  ids_[key] = id;
  return id;
}

Json::Value SitePictures::Described(int id, const std::string& kind,
                                    const std::string& name) const {
  Json::Value json;
  json["id"] = id;
  json["kind"] = kind;
  json["name"] = name;
  try {
    const PyramidSize size = entries_[id].picture->Size();
    json["width"] = size.width;
    json["height"] = size.height;
    json["levels"] = size.levels;
    json["version"] = entries_[id].picture->Version();
  } catch (const InputError& error) {
    json["fault"] = error.what();
  }
  return json;
}

// As insitu-render noted it.
std::string SitePictures::FrameOf(const std::string& photo, const std::string& variant) const {
  const fs::path record = PathsOf(site_, variant).render_record(photo);
  if (!fs::exists(record)) return "photo";
  try {
    return ReadJson(record)["frame"].asString();
  } catch (const std::exception&) {
    return "photo";
  }
}

Json::Value SitePictures::PicturesOf(const fs::path& photograph) {
  const std::string photo = photograph.stem().string();
  Json::Value pictures(Json::arrayValue);
  const auto add_file = [&](const PictureFile& file, const std::string& kind,
                            const std::string& name) {
    const int id = Known(file.path.string(), [&] {
      return Entry{std::make_shared<FilePicture>(file), file};
    });
    Json::Value described = Described(id, kind, name);
    described["frame"] = kind == "montage" ? FrameOf(photo, name)
                         : kind == "input" ? "pinhole"
                                           : "photo";
    pictures.append(described);
  };
  const int orientation = ReadOrientation(photograph);
  add_file({photograph, orientation}, "photo", "");
  if (fs::exists(site_.input_image(photo))) {
    add_file({site_.input_image(photo), orientation}, "input", "");
  }
  const std::vector<MontageFile> montages = MontagesOf(site_, photo);
  for (const MontageFile& montage : montages) {
    add_file({montage.path}, "montage", montage.variant);
  }
  for (const MontageFile& montage : montages) {
    const std::string frame = FrameOf(photo, montage.variant);
    const auto add = [&](const fs::path& file, const std::string& kind, const std::string& name,
                         const std::function<std::shared_ptr<Picture>()>& make) {
      const int id = Known(file.string() + "#" + name, [&] { return Entry{make(), std::nullopt}; });
      Json::Value described = Described(id, kind, name);
      described["of"] = montage.variant;
      described["frame"] = frame;
      pictures.append(described);
    };
    for (const ShareLayer& layer : kLayers) {
      const fs::path file = Beside(montage, layer.ending);
      if (!fs::exists(file)) continue;
      add(file, "layer", layer.name,
          [&] { return std::make_shared<LayerPicture>(file, layer.channel); });
    }
    const fs::path parts = Beside(montage, ".parts.exr");
    for (const std::string& part : PartNames(parts)) {
      add(parts, "part", part, [&] { return std::make_shared<PartPicture>(parts, part); });
    }
  }
  if (const auto unfinished = renders_.Of(photo)) {
    const int id = Known("unfinished " + photo, [&] { return Entry{unfinished, std::nullopt}; });
    entries_[id].picture = unfinished;
    Json::Value described = Described(id, "unfinished", "");
    described["frame"] = renders_.StateOf(photo)["frame"];
    pictures.append(described);
  }
  return pictures;
}

Json::Value SitePictures::List() {
  const std::lock_guard lock(mutex_);
  Json::Value photos(Json::arrayValue);
  for (const fs::path& photograph : photographs_) {
    Json::Value photo;
    photo["name"] = photograph.stem().string();
    try {
      photo["pictures"] = PicturesOf(photograph);
    } catch (const InputError& error) {
      photo["pictures"] = Json::Value(Json::arrayValue);
      photo["fault"] = error.what();
    }
    photo["render"] = renders_.StateOf(photograph.stem().string());
    photos.append(photo);
  }
  return photos;
}

std::shared_ptr<Picture> SitePictures::Of(int id) {
  const std::lock_guard lock(mutex_);
  if (id < 0 || id >= static_cast<int>(entries_.size())) {
    throw InputError("picture " + std::to_string(id), "there is no such picture");
  }
  std::erase(used_, id);
  used_.push_front(id);
  while (used_.size() > kMostInMemory) {
    entries_[used_.back()].picture->Forget();
    used_.pop_back();
  }
  return entries_[id].picture;
}

Json::Value SitePictures::Difference(int before, int after) {
  Of(before), Of(after);  // both must be there
  std::shared_ptr<DifferencePicture> difference;
  int id = 0;
  {
    const std::lock_guard lock(mutex_);
    const auto a = entries_[before].file, b = entries_[after].file;
    if (!a || !b)
      throw InputError("difference", "of what is no file, expected photographs or montages");
    id = Known("difference " + std::to_string(before) + " " + std::to_string(after), [&] {
      return Entry{std::make_shared<DifferencePicture>(*a, *b), std::nullopt};
    });
    difference = std::dynamic_pointer_cast<DifferencePicture>(entries_[id].picture);
  }
  const Json::Value summary = difference->Summary();
  const std::lock_guard lock(mutex_);
  Json::Value described = Described(id, "difference", "");
  described["summary"] = summary;
  return described;
}

std::string SitePictures::Version() const {
  std::string version;
  for (const fs::path& photograph : photographs_) {
    const std::string photo = photograph.stem().string();
    for (const MontageFile& montage : MontagesOf(site_, photo)) {
      version += montage.path.string() + FileVersion(montage.path);
      for (const char* beside : kBeside) {
        version += " " + FileVersion(Beside(montage, std::string(beside) + ".exr"));
      }
      version += "\n";
    }
  }
  return version;
}

}  // namespace insitu
