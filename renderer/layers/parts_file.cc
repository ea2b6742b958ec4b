// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/layers/parts_file.h"

#include <stdexcept>
#include <utility>
#include <variant>

#include "calibration/photo/montage_files.h"
#include "renderer/layers/cryptomatte.h"
#include "renderer/layers/layer_names.h"

namespace insitu {
namespace {

// Two ranks a part, as the specification has them.
std::string RanksName(const char* matte, size_t first) {
  return std::string(matte) + "0" + std::to_string(first / 4);
}

// A part's channels bear its name: readers that do not know of parts (Blender 3.4) tell them apart
// by it. Those of the montage are plain, so that others show it.
std::vector<std::string> ChannelsOf(const std::string& part, const char* letters) {
  std::vector<std::string> channels;
  for (; *letters; ++letters) {
    channels.push_back(part == kMontageLayer ? std::string(1, *letters) : part + "." + *letters);
  }
  return channels;
}

}  // namespace

std::vector<Part> PartsOf(const std::vector<std::string>& chosen) {
  std::vector<Part> parts;
  for (const std::string& name : chosen) {
    if (name == "object" || name == "material") {
      for (size_t first = 0; first < 2 * size_t{kCryptomatteRanks}; first += 4) {
        const std::string own = RanksName(name == "object" ? kObjectMatte : kMaterialMatte, first);
        parts.push_back({own, ChannelsOf(own, "RGBA")});
      }
    } else {
      const char* letters = name == "coverage" ? "Y" : name == "depth" ? "Z" : "RGB";
      parts.push_back({name, ChannelsOf(name, name == "normal" ? "XYZ" : letters)});
    }
  }
  return parts;
}

std::vector<float> PartSamples(const std::vector<const Raster*>& images, int orientation) {
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
    const std::vector<float> turned = PartSamples({&grey}, orientation);
    for (size_t i = 0; i < images[c]->data.size(); ++i) {
      samples[i * images.size() + c] = turned[3 * i];
    }
  }
  return samples;
}

void AddCryptomatte(const char* matte, const std::vector<std::string>& names,
                    Attributes* attributes) {
  const std::string key = "cryptomatte/" + CryptomatteKey(matte) + "/";
  (*attributes)[key + "name"] = matte;
  (*attributes)[key + "hash"] = "MurmurHash3_32";
  (*attributes)[key + "conversion"] = "uint32_to_float32";
  (*attributes)[key + "manifest"] = CryptomatteManifest(names);
}

PartsFile::PartsFile(const std::filesystem::path& file, int width, int height,
                     const std::vector<Part>& parts, const Attributes& attributes)
    : file_(file.string()), out_(OIIO::ImageOutput::create(file_)) {
  for (const Part& part : parts) {
    OIIO::ImageSpec spec(width, height, static_cast<int>(part.channels.size()), OIIO::TypeFloat);
    spec.channelnames = part.channels;
    spec.attribute("oiio:subimagename", part.name);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // of writing, or its bytes would change
    for (const auto& [key, value] : attributes) spec.attribute(key, value);
    specs_.push_back(std::move(spec));
  }
  Require(out_ && out_->open(file_, static_cast<int>(specs_.size()), specs_.data()));
}

void PartsFile::Append(const std::vector<float>& samples) {
  if (next_ > 0) {
    Require(out_->open(file_, specs_.at(next_), OIIO::ImageOutput::AppendSubimage));
  }
  Require(out_->write_image(OIIO::TypeFloat, samples.data()));
  ++next_;
}

void PartsFile::Close() { Require(out_->close()); }

void PartsFile::Require(bool is_good) const {
  if (is_good) return;
  throw std::runtime_error(file_ +
                           ": cannot be written: " + (out_ ? out_->geterror() : OIIO::geterror()));
}

}  // namespace insitu
