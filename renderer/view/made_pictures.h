// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that are made of others: a layer, the difference of two.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "renderer/view/picture.h"

namespace insitu {

// An image of 8-bit codes made of files, anew when those change.
class MadePicture : public Picture {
 public:
  PyramidSize Size() override;
  WebResponse Tile(int level, int x, int y) override;
  Json::Value Value(int x, int y) override;
  void Forget() override;

 protected:
  virtual std::string Name() const = 0;
  virtual cv::Mat Make() = 0;  // CV_8UC3
  // Of a pixel, beside what is shown of it.
  virtual void AddValue(int x, int y, Json::Value* value) = 0;

  std::recursive_mutex mutex_;  // of what is made

 private:
  std::shared_ptr<PhotoPyramid> Made();

  std::string version_;
  std::shared_ptr<PhotoPyramid> pyramid_;
};

// A share of <photo>.layers.exr and the like, 0 black and 1 white. `channel`: 0 to 2, red, green,
// blue.
class LayerPicture : public MadePicture {
 public:
  LayerPicture(const std::filesystem::path& file, int channel)
      : file_(file), picture_({file}), channel_(channel) {}
  PyramidSize Size() override { return picture_.Size(); }  // without making it
  std::string Version() override { return picture_.Version(); }

 protected:
  std::string Name() const override { return file_.string(); }
  cv::Mat Make() override;
  void AddValue(int x, int y, Json::Value* value) override;

 private:
  const std::filesystem::path file_;
  FilePicture picture_;
  const int channel_;
};

// Codes of 8 bits that two files differ by, enlarged; black: the same bit for bit in linear light,
// and wherever they are not, never black.
class DifferencePicture : public MadePicture {
 public:
  // Throws InputError: they are not of one size, or cannot be read.
  DifferencePicture(PictureFile before, PictureFile after);
  std::string Version() override {
    return FileVersion(before_.path) + "/" + FileVersion(after_.path);
  }
  void Forget() override;

  // {differing, of, most}: pixels, and the largest difference in 8-bit codes.
  Json::Value Summary();

 protected:
  std::string Name() const override { return "difference"; }
  cv::Mat Make() override;
  void AddValue(int x, int y, Json::Value* value) override;

 private:
  const PictureFile before_, after_;
  cv::Mat linear_before_, linear_after_;  // Rec. 709, red first
  int64_t differing_ = 0;
  double most_ = 0;
};

}  // namespace insitu
