// SPDX-License-Identifier: GPL-3.0-or-later
// An EXR of many parts, 32-bit float.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "calibration/photo/raster.h"

namespace insitu {

inline constexpr char kObjectMatte[] = "CryptoObject", kMaterialMatte[] = "CryptoMaterial";

// A part of the file: channels of its own, named.
struct Part {
  std::string name;
  std::vector<std::string> channels;
};

// Of the layers `chosen`, in their order; cryptomattes have several, two ranks each.
std::vector<Part> PartsOf(const std::vector<std::string>& chosen);

// Channels of `images`, of one or three each, side by side, upright.
std::vector<float> PartSamples(const std::vector<const Raster*>& images, int orientation);

using Attributes = std::map<std::string, std::string>;

// `names`: of what the matte tells apart.
void AddCryptomatte(const char* matte, const std::vector<std::string>& names,
                    Attributes* attributes);

// An EXR of many parts, written one after the other.
class PartsFile {
 public:
  // Throws std::runtime_error, as the others do: it cannot be written.
  // `attributes` go into every part: some readers look into the first alone.
  PartsFile(const std::filesystem::path& file, int width, int height,
            const std::vector<Part>& parts, const Attributes& attributes);

  void Append(const std::vector<float>& samples);
  void Close();

 private:
  void Require(bool is_good) const;

  const std::string file_;
  const std::unique_ptr<OIIO::ImageOutput> out_;
  std::vector<OIIO::ImageSpec> specs_;
  size_t next_ = 0;
};

}  // namespace insitu
