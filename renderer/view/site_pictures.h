// SPDX-License-Identifier: GPL-3.0-or-later
// All that there is to look at in a site, by number: photographs, montages of all variants, layers,
// what is being rendered, differences that were asked for.
#pragma once

#include <json/value.h>

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/view/picture.h"
#include "renderer/view/running_renders.h"

namespace insitu {

// Each from any thread.
class SitePictures {
 public:
  // Throws InputError: no photographs.
  SitePictures(const SitePaths& site, const RunningRenders& renders);

  const std::vector<std::filesystem::path>& photographs() const { return photographs_; }

  // Of every photograph {name, pictures: [{id, kind, name, frame, width, height, levels, version}],
  // render}. kind: "photo", "input" (the photograph without distortion), "montage", "layer",
  // "part" (of what --layers took apart), "unfinished"; name: of the variant with hour and quality,
  // or of the layer or part, which has {of}, that variant. What cannot be read has {fault} and no
  // size. A number stays that picture's.
  Json::Value List();

  // Throws InputError: there is no such picture.
  std::shared_ptr<Picture> Of(int id);

  // The picture of a difference, {id, kind, width, height, levels, version} with its Summary().
  // Throws InputError: one of them is no file, or they are not of one size.
  Json::Value Difference(int before, int after);

  // Another one when a montage came, went or changed.
  std::string Version() const;

 private:
  struct Entry {
    std::shared_ptr<Picture> picture;
    std::optional<PictureFile> file;  // nullopt: made of others
  };
  int Known(const std::string& key, const std::function<Entry()>& make);
  Json::Value Described(int id, const std::string& kind, const std::string& name) const;
  Json::Value PicturesOf(const std::filesystem::path& photograph);
  std::string FrameOf(const std::string& photo, const std::string& variant) const;

  const SitePaths site_;
  const RunningRenders& renders_;
  const std::vector<std::filesystem::path> photographs_;
  std::recursive_mutex mutex_;
  std::vector<Entry> entries_;
  std::map<std::string, int> ids_;
  std::deque<int> used_;  // the last one first
};

}  // namespace insitu
