// SPDX-License-Identifier: GPL-3.0-or-later
// Renders that run or wait, whoever runs them, as their tiles come: pictures of which it can always
// be seen what is not rendered yet.
#pragma once

#include <json/value.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "calibration/program/site.h"
#include "renderer/tiles/partial_render.h"
#include "renderer/view/picture.h"

namespace insitu {

// What is rendered of a photograph over the photograph itself; tiles that are not are hatched.
class UnfinishedPicture : public Picture {
 public:
  // `before`: the photograph, or the input image of the frame "pinhole".
  UnfinishedPicture(PictureFile before, const PartialHeader& header);

  PyramidSize Size() override;
  WebResponse Tile(int level, int x, int y) override;
  // Of a tile that is not rendered: {unfinished: true} alone.
  Json::Value Value(int x, int y) override;
  std::string Version() override;

  void Add(std::vector<FinishedTile> tiles);
  int done() const;   // tiles
  int total() const;  // tiles

 private:
  void Put(const FinishedTile& tile);
  int TileAtUpright(int x, int y) const;

  const PictureFile before_;
  const PartialHeader header_;
  mutable std::mutex mutex_;
  cv::Mat shown_;  // CV_8UC3, upright; empty: nobody has asked
  std::map<int, FinishedTile> tiles_;
  Eigen::Vector2i size_;  // [px], upright
};

class RunningRenders {
 public:
  explicit RunningRenders(const SitePaths& site) : site_(site) {}

  // What is new since the last call: a message {type: "render", photo, state, done, total, anew,
  // tiles} for each photograph that has something new. state: "running", "waiting", "none".
  // `tiles`: [left, top, right, bottom] upright [px] of those that came.
  std::vector<Json::Value> Poll(const std::vector<std::filesystem::path>& photographs);

  // Of a photograph; null: none runs or waits.
  std::shared_ptr<UnfinishedPicture> Of(const std::string& photo) const;
  // {state, done, total, frame}
  Json::Value StateOf(const std::string& photo) const;

 private:
  struct Followed {
    std::unique_ptr<PartialRenderReader> reader;
    std::shared_ptr<UnfinishedPicture> picture;
    std::string state = "none", frame;
  };
  Json::Value Take(const std::filesystem::path& photograph, Followed* followed,
                   PartialRenderReader::News news);

  const SitePaths site_;
  mutable std::mutex mutex_;
  std::map<std::string, Followed> followed_;
};

}  // namespace insitu
