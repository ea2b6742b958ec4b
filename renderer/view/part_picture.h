// SPDX-License-Identifier: GPL-3.0-or-later
// One of the parts that a montage was taken apart into, to look at.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "renderer/view/made_pictures.h"

namespace insitu {

// Names of the parts of <photo>.parts.exr in its order; of each Cryptomatte the one with the
// largest shares. Empty: there is no such file, or it cannot be read.
std::vector<std::string> PartNames(const std::filesystem::path& file);

// Light as its amount in sRGB, shares as grey, the nearest of a depth white, a normal's axes as
// colours, things in colours of their own.
class PartPicture : public MadePicture {
 public:
  PartPicture(std::filesystem::path file, std::string part)
      : file_(std::move(file)), part_(std::move(part)) {}
  PyramidSize Size() override;
  std::string Version() override { return FileVersion(file_); }
  void Forget() override;

 protected:
  std::string Name() const override { return file_.string() + ", " + part_; }
  cv::Mat Make() override;
  // "linear" is what light has, without bounds; "values" what the others hold; "things": [{name,
  // share}].
  void AddValue(int x, int y, Json::Value* value) override;

 private:
  const std::filesystem::path file_;
  const std::string part_;
  int width_ = 0, height_ = 0;
  std::vector<std::string> channels_;
  std::vector<float> samples_;  // empty: forgotten
  std::map<float, std::string> things_;
};

}  // namespace insitu
