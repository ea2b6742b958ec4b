// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/part_picture.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace {

constexpr std::string_view kMatte = "Crypto";
constexpr std::string_view kFurtherRanks = "01";

std::string NameOfPart(const OIIO::ImageSpec& spec) {
  return std::string(spec.get_string_attribute("oiio:subimagename"));
}

// At the part; null: there is none of that name, or the file cannot be read.
std::unique_ptr<OIIO::ImageInput> OpenPart(const std::filesystem::path& file,
                                           const std::string& part) {
  auto in = OIIO::ImageInput::open(file.string());
  for (int i = 0; in && in->seek_subimage(i, 0); ++i) {
    if (NameOfPart(in->spec()) == part) return in;
  }
  OIIO::geterror();  // else it is told when the program ends
  return nullptr;
}

std::unique_ptr<OIIO::ImageInput> RequirePart(const std::filesystem::path& file,
                                              const std::string& part) {
  auto in = OpenPart(file, part);
  if (!in) throw InputError(file.string(), "has no part " + part + " that can be read");
  return in;
}

// Of all mattes: {"name": "8 hexadecimal digits"}, as Cryptomatte has it.
std::map<float, std::string> ThingsOf(const OIIO::ImageSpec& spec, const std::string& file) {
  std::map<float, std::string> things;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    const std::string_view name(attribute.name().c_str());
    if (!name.starts_with("cryptomatte/") || !name.ends_with("/manifest")) continue;
    const Json::Value manifest = ParseJson(file, std::string(attribute.get_string()));
    for (const std::string& thing : manifest.getMemberNames()) {
      const auto id = static_cast<uint32_t>(std::strtoul(manifest[thing].asCString(), nullptr, 16));
      things[std::bit_cast<float>(id)] = thing;
    }
  }
  return things;
}

uint8_t Byte(double share) {
  return static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

// Of a thing, by its number.
std::array<double, 3> ColorOfThing(float id) {
  const uint32_t bits = std::bit_cast<uint32_t>(id) * 0x9e3779b1U;
  std::array<double, 3> color{};
  for (size_t c = 0; c < 3; ++c) color[c] = 0.2 + 0.8 * (bits >> 8 * c & 255U) / 255.0;
  return color;
}

// Blue first. `nearest` of a depth.
cv::Vec3b Shown(const float* samples, const std::vector<std::string>& channels, float nearest) {
  std::array<double, 3> rgb{};
  if (channels.size() == 4) {
    for (size_t rank = 0; rank < 4; rank += 2) {
      const auto color = ColorOfThing(samples[rank]);
      for (size_t c = 0; c < 3; ++c) rgb[c] += samples[rank + 1] * color[c];
    }
  } else if (channels[0] == "Z") {
    rgb.fill(samples[0] > 0 ? nearest / samples[0] : 0);
  } else if (channels.size() < 3) {
    rgb.fill(samples[0]);
  } else {
    const bool is_normal = channels[0] == "X";
    const bool is_there = samples[0] != 0 || samples[1] != 0 || samples[2] != 0;
    for (size_t c = 0; c < 3; ++c) {
      rgb[c] = is_normal ? is_there * (1 + samples[c]) / 2 : SrgbFromLinear(std::abs(samples[c]));
    }
  }
  return {Byte(rgb[2]), Byte(rgb[1]), Byte(rgb[0])};
}

float NearestOf(const std::vector<float>& depths) {
  float nearest = INFINITY;
  for (const float depth : depths) {
    if (depth > 0) nearest = std::min(nearest, depth);
  }
  return nearest;
}

}  // namespace

std::vector<std::string> PartNames(const std::filesystem::path& file) {
  std::vector<std::string> names;
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return names;
  const auto in = OIIO::ImageInput::open(file.string());
  for (int i = 0; in && in->seek_subimage(i, 0); ++i) {
    const std::string name = NameOfPart(in->spec());
    if (!name.starts_with(kMatte) || !name.ends_with(kFurtherRanks)) names.push_back(name);
  }
  OIIO::geterror();
  return names;
}

PyramidSize PartPicture::Size() {
  const auto in = RequirePart(file_, part_);
  return PyramidSizeOf(in->spec().width, in->spec().height);
}

cv::Mat PartPicture::Make() {
  const auto in = RequirePart(file_, part_);
  const OIIO::ImageSpec spec = in->spec();
  width_ = spec.width;
  height_ = spec.height;
  channels_.clear();
  for (const std::string& channel : spec.channelnames) {
    channels_.push_back(channel.substr(channel.rfind('.') + 1));
  }
  things_ = ThingsOf(spec, file_.string());
  const size_t count = channels_.size();
  std::vector<float> samples(count * static_cast<size_t>(width_) * static_cast<size_t>(height_));
  if (!in->read_image(in->current_subimage(), 0, 0, spec.nchannels, OIIO::TypeFloat,
                      samples.data())) {
    throw InputError(file_.string(), "part " + part_ + " cannot be read: " + in->geterror());
  }
  samples_ = std::move(samples);
  const float nearest = channels_[0] == "Z" ? NearestOf(samples_) : 0;
  cv::Mat shown(height_, width_, CV_8UC3);
  const float* at = samples_.data();
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x, at += count) {
      shown.at<cv::Vec3b>(y, x) = Shown(at, channels_, nearest);
    }
  }
  return shown;
}

void PartPicture::AddValue(int x, int y, Json::Value* value) {
  const std::lock_guard lock(mutex_);
  if (samples_.empty()) return;  // forgotten meanwhile
  const size_t count = channels_.size();
  const float* at = &samples_[count * (static_cast<size_t>(y) * static_cast<size_t>(width_) +
                                       static_cast<size_t>(x))];
  Json::Value values(Json::arrayValue);
  for (size_t c = 0; c < count; ++c) values.append(at[c]);
  if (count < 4) {
    (*value)[channels_[0] == "R" ? "linear" : "values"] = values;
    return;
  }
  Json::Value& things = (*value)["things"] = Json::Value(Json::arrayValue);
  for (size_t rank = 0; rank < 4; rank += 2) {
    if (at[rank + 1] <= 0) continue;
    const auto known = things_.find(at[rank]);
    Json::Value thing;
    thing["name"] = known == things_.end() ? "?" : known->second;
    thing["share"] = at[rank + 1];
    things.append(thing);
  }
}

void PartPicture::Forget() {
  const std::lock_guard lock(mutex_);
  MadePicture::Forget();
  samples_ = {};
}

}  // namespace insitu
