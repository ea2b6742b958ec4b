// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/sample_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

constexpr int kMargin = 4;  // [px]

const PixelRecord& RecordAt(const RenderedView& view, int x, int y) {
  return view.records[static_cast<size_t>(y) * view.before.width + x];
}

bool SameLight(const PixelRecord& a, const PixelRecord& b) {
  return a.sun == b.sun && std::abs(a.sky_share - b.sky_share) < 0.12f;
}

// Whether all pixels about (x, y) show the same plain surface in the same light, unclipped.
bool IsPure(const RenderedView& view, int x, int y) {
  const PixelRecord& center = RecordAt(view, x, y);
  if (!center.sky && (!center.face || !(center.sun == 0 || center.sun == 1))) return false;
  for (int v = y - kMargin; v <= y + kMargin; ++v) {
    for (int u = x - kMargin; u <= x + kMargin; ++u) {
      const PixelRecord& record = RecordAt(view, u, v);
      if (record.sky != center.sky || record.face != center.face) return false;
      if (!center.sky && (!record.plain || !SameLight(record, center))) return false;
      if (view.before.Rgb(u, v).maxCoeff() > 0.95) return false;
    }
  }
  return true;
}

// Calls `visit(view, x, y, record)` for pure pixels, on a grid of every other pixel.
template <typename Visit>
void ForEachPure(const std::vector<RenderedView>& renderings, const Visit& visit) {
  for (size_t i = 0; i < renderings.size(); ++i) {
    const Raster& image = renderings[i].before;
    for (int y = kMargin; y < image.height - kMargin; y += 2) {
      for (int x = kMargin; x < image.width - kMargin; x += 2) {
        if (IsPure(renderings[i], x, y)) {
          visit(static_cast<int>(i), x, y, RecordAt(renderings[i], x, y));
        }
      }
    }
  }
}

// Keeps one pixel of each group, by lot.
class Lottery {
 public:
  using Group = std::vector<int>;

  void Enter(const Group& group, const ChosenPixel& pixel) {
    const double ticket = CellNoise(pixel.x, pixel.y, 100 + pixel.view);
    const auto [found, added] = winners_.try_emplace(group, ticket, pixel);
    if (!added && ticket < found->second.first) found->second = {ticket, pixel};
  }
  std::vector<ChosenPixel> Winners() const {
    std::vector<ChosenPixel> pixels;
    for (const auto& [group, winner] : winners_) pixels.push_back(winner.second);
    return pixels;
  }

 private:
  std::map<Group, std::pair<double, ChosenPixel>> winners_;
};

// The sky a little above the skyline, where the haze ends.
std::optional<ChosenPixel> HorizonPixel(const RenderedView& view, int index) {
  const int x = view.before.width / 2 + (index % 3 - 1) * view.before.width / 5;
  for (int y = view.before.height - 1 - kMargin; y >= kMargin; --y) {
    if (RecordAt(view, x, y).sky && IsPure(view, x, y)) return ChosenPixel{index, x, y, ""};
  }
  return std::nullopt;
}

std::vector<ChosenPixel> HazePixels(const std::set<std::string>& faces,
                                    const std::vector<RenderedView>& renderings) {
  constexpr double kNearest = 14, kFarthest = 260;  // [m]
  constexpr double kBinsPerOctave = 5;
  Lottery lottery;
  ForEachPure(renderings, [&](int view, int x, int y, const PixelRecord& record) {
    if (!record.face || !faces.count(record.face->name)) return;
    if (record.sun != 1 || record.sky_share < 0.9f) return;
    if (record.distance < kNearest || record.distance > kFarthest) return;
    const int bin = static_cast<int>(kBinsPerOctave * std::log2(record.distance / kNearest));
    lottery.Enter({bin}, {view, x, y, record.face->name});
  });
  return lottery.Winners();
}

// "sup00_w1" -> "w1": faces that look the same way.
std::string SideOf(const std::string& face) { return face.substr(face.rfind('_') + 1); }

// One pixel for each kind of light: by side, in the sun or not, by share of the sky, by photograph.
std::vector<ChosenPixel> DaylightPixels(Material material,
                                        const std::vector<RenderedView>& renderings) {
  constexpr double kFarthest = 100;  // [m]
  constexpr double kSkyBins = 5;
  Lottery lottery;
  std::map<std::string, int> sides;
  ForEachPure(renderings, [&](int view, int x, int y, const PixelRecord& record) {
    if (!record.face || record.face->material != material) return;
    if (record.distance > kFarthest) return;
    const auto side = sides.try_emplace(SideOf(record.face->name), static_cast<int>(sides.size()));
    const int sky = static_cast<int>(record.sky_share * kSkyBins);
    lottery.Enter({record.sun == 1, side.first->second, sky, view},
                  {view, x, y, record.face->name});
  });
  return lottery.Winners();
}

}  // namespace

ChosenSamples ChooseSamples(const SurveyPlan& plan, const std::vector<RenderedView>& renderings) {
  ChosenSamples samples;
  for (size_t i = 0; i < renderings.size(); ++i) {
    const auto pixel = HorizonPixel(renderings[i], static_cast<int>(i));
    if (pixel) samples.horizon.push_back(*pixel);
  }
  if (plan.matt.empty()) {
    samples.haze = HazePixels({plan.level}, renderings);
  } else {
    samples.haze = HazePixels(plan.matt, renderings);
    samples.mirrored = HazePixels({plan.level}, renderings);
  }
  samples.daylight = DaylightPixels(plan.daylight, renderings);
  return samples;
}

std::vector<int> BestViews(const Scene& natural, const std::vector<RenderedView>& renderings) {
  constexpr int kFewest = 100;  // [px]
  std::map<const Face*, std::vector<int>> counts;
  for (size_t i = 0; i < renderings.size(); ++i) {
    for (const PixelRecord& record : renderings[i].records) {
      if (!record.face) continue;
      auto& count = counts.try_emplace(record.face, renderings.size(), 0).first->second;
      ++count[i];
    }
  }
  std::vector<int> best;
  for (const Face& face : natural.faces) {
    const auto found = counts.find(&face);
    best.push_back(-1);
    if (found == counts.end()) continue;
    const auto most = std::max_element(found->second.begin(), found->second.end());
    if (*most >= kFewest) best.back() = static_cast<int>(most - found->second.begin());
  }
  return best;
}

}  // namespace insitu::demo
